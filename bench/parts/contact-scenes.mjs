// Scenes in which cloth comes to lie on itself, hangs in folds beside itself, or is twisted.
import { changed, garmentScene } from './assets.mjs';
import {
  funnel,
  pouredRibbon,
  ribbonPile,
  tenFolds,
  tenLayers,
  threeFolds,
  threeSheets,
} from './contact-stacks.mjs';
import { closedTube, rolledTube, spunSheet, tightKnot } from './contact-turned.mjs';
import { kAir, kFloor, sheet } from './contact-world.mjs';
import { explicitOnes } from './same-cloth-runs.mjs';
import { kStep } from './sheets.mjs';

/** Pins move so within these times [s]. */
const eased = (offset_m, begin_s, end_s) => ({ kind: 'ease', offset_m, begin_s, end_s });

/** Falls on a ball and hangs down around it in folds. */
function tablecloth(n = 20) {
  const cell = 0.7 / n;
  return {
    name: 'tablecloth on a ball',
    cloth: sheet(n, n, cell, [-0.35, 0.41, -0.35], [0, 0, 1]),
    fabric: { name: 'fine cotton' },
    world: { ...kAir, colliders: [{ sphere: { centre_m: [0, 0.3, 0], radius_m: 0.1 } }, kFloor] },
    duration_s: 1.6,
  };
}

/**
 * Places of a sheet along which its rows go up to half of them, round an arc of `radius` [m], and
 * back above the lower half: as long as it is at rest but for the chords of the arc.
 */
function foldedPlaces(columns, rows, cell, radius, height) {
  const arc = Math.PI * radius;
  const straight = (rows * cell - arc) / 2;
  const profile = (s) => {
    if (s <= straight) return [0, s];
    const angle = (s - straight) / radius;
    if (angle < Math.PI)
      return [radius * (1 - Math.cos(angle)), straight + radius * Math.sin(angle)];
    return [2 * radius, straight - (s - straight - arc)];
  };
  const places = [];
  for (let row = 0; row <= rows; ++row)
    for (let column = 0; column <= columns; ++column) {
      const [up, along] = profile(row * cell);
      places.push([(column - columns / 2) * cell, height + up, along - straight / 2]);
    }
  return places;
}

/** Folded in half in the air, and let fall on a small ball on the floor. */
function napkin(n = 20) {
  const cell = 0.4 / n;
  return {
    name: 'napkin dropped folded',
    cloth: sheet(n, n, cell, [-0.2, 0.2, -0.2], [0, 0, 1]),
    fabric: { name: 'linen' },
    start: { positions_m: foldedPlaces(n, n, cell, 0.5 * cell, 0.12) },
    world: {
      ...kAir,
      colliders: [kFloor, { sphere: { centre_m: [0.02, 0.05, 0.03], radius_m: 0.05 } }],
    },
    duration_s: 0.8,
  };
}

/** Falls on its edge and comes down in a pile; a weight that is aslant says which way it bends. */
function edge(n = 16) {
  return {
    name: 'sheet on its edge',
    cloth: sheet(n, n, 0.4 / n, [0, 0.42, 0], [0, -1, 0]),
    fabric: { name: 'linen' },
    world: { ...kAir, gravity_m_per_s2: [0.3, -9.8, 0.5], colliders: [kFloor] },
    duration_s: 1.4,
  };
}

/**
 * Nine hooks along the upper edge draw near in a zigzag, to a seventh of the width.
 *
 * n: cells along a side, a multiple of 8
 */
export function curtain(n = 24, end_s = 0.8) {
  const width = 0.6;
  const hooks = Array.from({ length: 9 }, (_, k) => ({
    vertices: [(k * n) / 8],
    motion: eased([0.86 * width * (0.5 - k / 8), 0, k % 2 ? 0.03 : -0.03], 0, end_s),
  }));
  return {
    name: 'gathered curtain',
    cloth: sheet(n, n, width / n, [-width / 2, 0.7, 0], [0, -1, 0]),
    fabric: { name: 'fine cotton' },
    pins: hooks,
    world: { ...kAir },
    duration_s: 1.2,
  };
}

/**
 * The two corners of either end go past each other, upper ones the other way round than lower
 * ones: a turn in all, as pins go straight. Of a ribbon that is long enough for it: an edge is
 * sqrt(0.52^2 + (0.12 pi)^2) = 0.64 m long then.
 */
function twist(columns = 10) {
  const rows = 6 * columns;
  const cell = 0.12 / columns;
  const passing = (part, across, up, out) => ({ part, motion: eased([across, up, out], 0, 1) });
  return {
    name: 'twisted sheet',
    cloth: sheet(columns, rows, cell, [-0.06, 0.7, 0], [0, -1, 0]),
    fabric: { name: 'fine cotton' },
    pins: [
      passing('upper_left', 0.11, 0, 0.03),
      passing('upper_right', -0.11, 0, -0.03),
      passing('lower_left', 0.11, 0.2, -0.03),
      passing('lower_right', -0.11, 0.2, 0.03),
    ],
    world: { ...kAir },
    duration_s: 1.2,
  };
}

/**
 * A garment on a figure that begins to walk, to squat or to turn, by the model that all steppers
 * take. Trousers start with crossings, which the guard keeps.
 */
function worn(garment, motion, doing) {
  const scene = garmentScene(garment, motion);
  const { caption, method, model, ...rest } = changed(scene, { '/refinement/level': 0 });
  return { ...rest, name: `${garment} ${doing}`, duration_s: 2 };
}

const kGarments = Object.fromEntries(
  ['skirt', 'trousers'].flatMap((garment) =>
    Object.entries({ walk: 'walking', squat: 'squatting', turn: 'turning' }).map(
      ([motion, doing]) => [`${garment}_${motion}`, () => worn(garment, motion, doing)],
    ),
  ),
);

export const kTakeMeshes = ['implicit', 'newton'];
export const kNeedThreads = ['projective', 'xpbd', 'multigrid'];

/** Scenes for every stepper, and those for the steppers that most runs are made with. */
export const kForAll = { tablecloth, napkin, edge, funnel, threeFolds };
export const kForSome = {
  curtain,
  twist,
  spunSheet,
  rolledTube,
  tightKnot,
  tenFolds,
  pouredRibbon,
  ...kGarments,
};

/** Scenes of a mesh, which threads do not follow. */
export const kOfMeshes = { closedTube, tenLayers, threeSheets, ribbonPile };

/** A sheet let go from the horizontal, held along an edge: it meets itself nowhere. */
export const swinging = (n) => ({
  name: 'swinging sheet',
  cloth: sheet(n, n, 1 / n, [0, 0, 0], [0, 0, 1]),
  fabric: { name: 'fine cotton' },
  pins: [{ part: 'upper_edge' }],
  world: { ...kAir },
  duration_s: 1,
});

/**
 * The scene by this method, with self-contact or without; looked at after every step. Dampers ask
 * of `explicit` and `rk4` for substeps of 1e-8 s: they run without.
 */
export function withContact(scene, method, self_contact) {
  const result = changed(scene, {
    '/method': { step_s: kStep, ...method },
    '/record': { format: 'none', every_s: kStep },
    '/world/self_contact': self_contact,
  });
  if (!explicitOnes.includes(method.stepper)) return result;
  return changed(result, { '/fabric/overrides/damping_ratio': 0 });
}
