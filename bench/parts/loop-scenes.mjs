// Scenes of limp, rigid cloth that our steppers and the plain JavaScript loop both compute.
import { squareSheet } from './square-sheet.mjs';

/** Rigid links, no bending: what the loop computes. */
function limpSheet(name, n, cloth, pins, more = {}) {
  return {
    name: `${name} ${n}x${n}`,
    cloth,
    fabric: { name: 'fine cotton' },
    model: { bending: 'none' },
    pins,
    duration_s: 1,
    ...more,
  };
}

const kCorners = [{ part: 'upper_left' }, { part: 'upper_right' }];
const lying = (u, v) => [u, 0, v];
const upright = (u, v) => [u, -v, 0];
/** How far a corner goes, the other one as far back [m]: out of the plane too, for else nothing folds. */
const kMeet = [0.25, 0, 0.05];

/** 0 to 1 in a second as motions of kind "ease" go. */
const ease = (time) => {
  const t = Math.min(time, 1);
  return t * t * (3 - 2 * t);
};

export const kBall = { centre: [0.5, -0.35, 0.5], radius: 0.3, friction: 0.3 };

/** Scenes of both: ours, and what the loop has to know. */
export const kScenes = {
  swing_edge: {
    ours: (n) =>
      limpSheet('swing by an edge', n, squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]), [
        { part: 'upper_edge' },
      ]),
    loop: { pins: 'edge', placeOf: lying },
    hasReference: true,
  },
  swing_corners: {
    ours: (n) =>
      limpSheet(
        'swing by two corners',
        n,
        squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]),
        kCorners,
      ),
    loop: { pins: 'corners', placeOf: lying },
  },
  hang_corners: {
    ours: (n) =>
      limpSheet(
        'hang by two corners',
        n,
        squareSheet(n, [0, 0, 0], [0, -1, 0], [1, 0, 0]),
        kCorners,
      ),
    loop: { pins: 'corners', placeOf: upright },
  },
  ball: {
    ours: (n) =>
      limpSheet('fall on a ball', n, squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]), [], {
        world: {
          colliders: [
            {
              sphere: { centre_m: kBall.centre, radius_m: kBall.radius },
              friction: kBall.friction,
            },
          ],
        },
      }),
    loop: { pins: 'none', placeOf: lying, ball: kBall },
  },
  gathered: {
    ours: (n) => {
      const comes = (sign) => ({
        kind: 'ease',
        offset_m: kMeet.map((offset) => sign * offset),
        begin_s: 0,
        end_s: 1,
      });
      return limpSheet('gather', n, squareSheet(n, [0, 0, 0], [0, -1, 0], [1, 0, 0]), [
        { part: 'upper_left', motion: comes(1) },
        { part: 'upper_right', motion: comes(-1) },
      ]);
    },
    loop: {
      pins: 'corners',
      placeOf: upright,
      pinsMove: (time) => kMeet.map((offset) => offset * ease(time)),
    },
  },
};
