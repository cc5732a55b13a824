// Each naive side shows within two seconds the sign that its case promises, and ours none; and what is said of both holds.
import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import {
  CASES,
  caseNamed,
  type FailureCase,
  type Side,
  type Sign,
  STEP_S,
  sceneTextOf,
} from '../../src/failures/state/failure-cases';
import { MIDDLE } from '../../src/failures/state/failure-scenes';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import type { RunWarning } from '../../src/shared/bindings/run-warning';
import { type FabricQuantity, fabricNamed, fabricsText } from '../../src/shared/fabric/fabric-data';
import { CASE_OF } from '../../src/shared/panels/why-link';
import { loadFirst } from '../support/built-module';

/** A failure is seen by then [s]. */
const LATEST_S = 2;

/** Quads of cloth that looks like cloth, at least. */
const LEAST_QUADS = 24 * 24;

interface Run {
  /** When each sign was first seen [s]. */
  signs: Map<Sign, number>;
  warnings: readonly RunWarning[];
  /** Three vertices each. */
  triangles: Uint32Array;
  /** Largest |edge strain| ever and at the end, as ratios. */
  mostStretch: number;
  lastStretch: number;
  /** Worst value of the case's own measure. */
  measured: number;
  /** Positions at the end, three numbers a vertex [m]. */
  positions: Float64Array;
}

/** A side of a case, played to its end. */
async function played(one: FailureCase, side: Side): Promise<Run> {
  const module = await loadFirst();
  const simulation = new module.Simulation(fabricsText);
  expect(JSON.parse(simulation.load(sceneTextOf(one, side)))).toMatchObject({ ok: true });
  const signs = new Map<Sign, number>();
  const nSteps = Math.round(one.endS / STEP_S);
  let hasEnded = false;
  let mostStretch = 0;
  let measured = Number.NEGATIVE_INFINITY;
  let numbers = JSON.parse(simulation.numbers()) as RunNumbers;
  for (let step = 1; step <= nSteps && !hasEnded; ++step) {
    hasEnded = simulation.step(1) !== 0;
    numbers = JSON.parse(simulation.numbers()) as RunNumbers;
    mostStretch = Math.max(mostStretch, numbers.largest_stretch);
    const { measure } = one;
    const value = measure?.of(simulation.positions(), step * STEP_S) ?? Number.NEGATIVE_INFINITY;
    measured = Math.max(measured, value);
    const isMeasured = measure && value > measure.bound;
    const seen: Sign[] = numbers.warnings.map(({ kind }) => kind);
    if (isMeasured) seen.push('measured');
    if (hasEnded) seen.push('ended');
    for (const sign of seen) if (!signs.has(sign)) signs.set(sign, step * STEP_S);
  }
  const run = {
    signs,
    warnings: numbers.warnings,
    triangles: simulation.triangles().slice(),
    mostStretch,
    lastStretch: numbers.largest_stretch,
    measured,
    positions: simulation.exactPositions().slice(),
  };
  simulation.delete();
  return run;
}

const runs = new Map<string, Promise<Run>>();

function runOf(id: string, side: Side): Promise<Run> {
  const key = `${id} ${side}`;
  const run = runs.get(key) ?? played(caseNamed(id), side);
  runs.set(key, run);
  return run;
}

describe('ten cases', () => {
  it('differ', () => {
    expect(CASES).toHaveLength(10);
    expect(new Set(CASES.map(({ id }) => id)).size).toBe(10);
    expect(new Set(CASES.map(({ title }) => title)).size).toBe(10);
  });
});

describe('a case', () => {
  for (const one of CASES) {
    it(`${one.id}: the naive side shows "${one.sign}" within 2 s, ours nothing`, {
      timeout: 60000,
    }, async () => {
      const [naive, ours] = [await runOf(one.id, 'naive'), await runOf(one.id, 'ours')];
      expect(naive.signs.get(one.sign)).toBeLessThanOrEqual(LATEST_S);
      expect([...ours.signs.keys()]).toEqual([]);
      expect(naive.triangles.length / 3).toBeGreaterThanOrEqual(2 * LEAST_QUADS);
      expect(naive.positions.every(Number.isFinite)).toBe(true);
    });
  }
});

/** Height of a vertex at the end [m]. */
const heightOf = ({ positions }: Run, vertex: number) => positions[3 * vertex + 1] ?? Number.NaN;

/** Farthest that a vertex is towards the eye at the end [m]. */
const foremost = ({ positions }: Run) =>
  positions.reduce((most, place, index) => (index % 3 === 2 ? Math.max(most, place) : most), -1e9);

/** Pairs of faces with a common edge whose front sides look in opposite directions at the end. */
function foldedPairs({ positions, triangles }: Run): number {
  const normals: Vector3[] = [];
  const faceAt = new Map<string, number>();
  let nFolded = 0;
  for (let face = 0; face < triangles.length / 3; ++face) {
    const corners = [0, 1, 2].map((k) => triangles[3 * face + k] ?? 0);
    const [a, b, c] = corners.map((vertex) => new Vector3().fromArray(positions, 3 * vertex));
    if (!a || !b || !c) continue;
    const normal = b.sub(a).cross(c.sub(a));
    normals[face] = normal;
    corners.forEach((corner, k) => {
      const ends = [corner, corners[(k + 1) % 3] ?? 0].sort((one, other) => one - other);
      const other = normals[faceAt.get(ends.join()) ?? -1];
      if (other && other.dot(normal) < 0) ++nFolded;
      faceAt.set(ends.join(), face);
    });
  }
  return nFolded;
}

/** The words of each case, in numbers. */
const CLAIMS: Record<string, (naive: Run, ours: Run) => void> = {
  gathered_curtain(naive, ours) {
    expect(naive.mostStretch).toBeGreaterThan(0.8);
    expect(ours.mostStretch).toBeLessThan(0.015);
  },
  long_step(naive) {
    const speed = naive.warnings.find(({ kind }) => kind === 'speed');
    expect(speed?.time_s).toBeCloseTo(0.1, 2);
    expect(speed?.value).toBeGreaterThan(100);
    expect(naive.signs.get('ended')).toBeLessThan(0.2);
  },
  tumbling(naive) {
    expect(naive.lastStretch).toBeGreaterThan(1);
  },
  hundredfold_stiffness(naive, ours) {
    const { measure } = caseNamed('hundredfold_stiffness');
    expect(measure?.sentence(naive.measured)).toMatch(/is 3 cm down/);
    expect(naive.warnings).toEqual([]);
    expect(ours.measured).toBeLessThan(-0.9);
  },
  stiff_in_one_substep(naive, ours) {
    expect(naive.mostStretch).toBeGreaterThan(9);
    expect(foldedPairs(naive)).toBeGreaterThan(20);
    expect(foldedPairs(ours)).toBe(0);
  },
  rest_on_a_ball(naive, ours) {
    expect(naive.mostStretch).toBeGreaterThan(1);
    expect(ours.mostStretch).toBeLessThan(0.05);
  },
  rushing_ball(naive, ours) {
    expect(naive.mostStretch).toBeGreaterThan(5);
    const [middle, radius] = [0.4, 0.15]; // the ball at the end, towards the eye
    expect(foremost(naive)).toBeLessThan(middle);
    expect(foremost(ours)).toBeGreaterThan(middle + 0.9 * radius);
  },
  fast_groove(naive, ours) {
    expect(naive.mostStretch).toBeGreaterThan(3);
    expect(ours.mostStretch).toBeLessThan(1 / 3);
  },
  heavy_bead(naive, ours) {
    const free = (9.81 / 2) * caseNamed('heavy_bead').endS ** 2;
    expect(1.5 - heightOf(naive, MIDDLE)).toBeGreaterThan(0.9 * free);
    expect(1.5 - heightOf(ours, MIDDLE)).toBeLessThan(0.3 * free);
  },
  flag_in_a_gale(naive, ours) {
    expect(naive.mostStretch).toBeGreaterThan(3);
    expect(ours.mostStretch).toBeLessThan(0.1);
  },
};

describe('words of a case', () => {
  for (const { id } of CASES) {
    it(`${id}: hold`, { timeout: 60000 }, async () => {
      CLAIMS[id]?.(await runOf(id, 'naive'), await runOf(id, 'ours'));
    });
  }

  it('have all been looked at', () => {
    expect(Object.keys(CLAIMS).sort()).toEqual(CASES.map(({ id }) => id).sort());
  });

  it('say how many explicit substeps are stable', async () => {
    const module = await loadFirst();
    const scene = JSON.parse(sceneTextOf(caseNamed('long_step'), 'naive'));
    const simulation = new module.Simulation(fabricsText);
    const method = { ...scene.method, beyond_bound: 'refuse' };
    const { what } = JSON.parse(simulation.load(JSON.stringify({ ...scene, method })));
    simulation.delete();
    const enough = /\((\d+) substeps would do\)/.exec(what)?.[1];
    expect(caseNamed('long_step').naive.words).toBe(
      `Explicit, 10 substeps where ${enough} are stable`,
    );
  });

  it('say how stiff the cloth is beside canvas, in every way', () => {
    const { lesson, scene } = caseNamed('hundredfold_stiffness');
    expect(lesson).toContain('a hundred times the stiffness of canvas');
    const { overrides } = scene.fabric as { overrides: Record<FabricQuantity, number> };
    const canvas = fabricNamed('canvas');
    for (const key of Object.keys(overrides) as FabricQuantity[])
      expect(overrides[key] / canvas[key].value, key).toBeCloseTo(100, 9);
    expect(Object.keys(overrides)).toHaveLength(5);
    expect(caseNamed('stiff_in_one_substep').scene).toBe(scene);
  });

  it('say how far the cloth flies in a step, and how fast the wind blows', () => {
    const { cloth } = caseNamed('fast_groove').scene as {
      cloth: { sheet: { initial_velocity_m_per_s: number[] } };
    };
    const speed = Math.hypot(...cloth.sheet.initial_velocity_m_per_s);
    expect(speed).toBe(30);
    expect(STEP_S * speed).toBe(0.5);
    const { world } = caseNamed('flag_in_a_gale').scene as {
      world: { air: { wind: { velocity_m_per_s: number[] } } };
    };
    expect(Math.hypot(...world.air.wind.velocity_m_per_s)).toBeCloseTo(14, 0);
  });

  it('say that the gale pulls at silk with many times its weight', async () => {
    // Let go, its threads and the flag as a whole move each other nowhere: air and weight are what moves its middle.
    const module = await loadFirst();
    const { scene } = caseNamed('flag_in_a_gale');
    expect(scene.fabric).toEqual({ name: 'silk' });
    const step_s = 1 / 6000;
    const method = { stepper: 'implicit', step_s };
    const simulation = new module.Simulation(fabricsText);
    const text = JSON.stringify({ ...scene, pins: [], method });
    expect(JSON.parse(simulation.load(text))).toMatchObject({ ok: true });
    const rest = simulation.exactPositions().slice();
    expect(simulation.step(1)).toBe(0);
    const places = simulation.exactPositions().slice();
    const masses = simulation.masses().slice();
    simulation.delete();
    const whole = masses.reduce((sum, mass) => sum + mass, 0);
    const [x = 0, y = 0, z = 0] = [0, 1, 2].map((axis) => {
      const wayOf = (vertex: number) =>
        (places[3 * vertex + axis] ?? 0) - (rest[3 * vertex + axis] ?? 0);
      const moment = masses.reduce((sum, mass, vertex) => sum + mass * wayOf(vertex), 0);
      return moment / whole / step_s ** 2;
    });
    expect(Math.hypot(x, y + 9.81, z) / 9.81).toBeGreaterThan(10);
  });

  it('say what a bead weighs beside its neighbours', () => {
    const { cloth } = caseNamed('heavy_bead').scene as {
      cloth: { particles: { masses_kg: number[] } };
    };
    const { masses_kg } = cloth.particles;
    expect((masses_kg[MIDDLE] ?? 0) / (masses_kg[0] ?? 1)).toBeCloseTo(40000, 6);
  });
});

describe('a warning that leads to a case', () => {
  for (const [kind, id] of Object.entries(CASE_OF)) {
    it(`"${kind}" leads to one whose naive side shows it`, async () => {
      const { signs } = await runOf(id, 'naive');
      expect([...signs.keys()]).toContain(kind);
    });
  }
});
