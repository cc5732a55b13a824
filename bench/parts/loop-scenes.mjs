// Scenes of limp, rigid cloth that our steppers and the plain JavaScript loop both compute.
import { cornersCome, cotton, kCorners, kEdge, kLimp, lying, upright } from './sheets.mjs';

/** How far a corner goes, the other one as far back [m]: out of the plane too, for else nothing folds. */
const kMeet = [0.25, 0, 0.05];

/** 0 to 1 in a second as motions of kind "ease" go. */
const ease = (time) => {
  const t = Math.min(time, 1);
  return t * t * (3 - 2 * t);
};

export const kBall = { centre: [0.5, -0.35, 0.5], radius: 0.3, friction: 0.3 };
const kSphere = { centre_m: kBall.centre, radius_m: kBall.radius };
const kWorld = { colliders: [{ sphere: kSphere, friction: kBall.friction }] };

const kUpright = (u, v) => [u, -v, 0];

const scene = (name, cloth, pins, loop, more = {}) => ({
  ours: (n) => cotton(name, n, cloth, pins, { ...kLimp, ...more }),
  loop,
});

/** Scenes of both: ours, and what the loop has to know. */
export const kScenes = {
  swing_edge: {
    ...scene('swing by an edge', lying, kEdge, { pins: 'edge' }),
    hasReference: true,
  },
  swing_corners: scene('swing by two corners', lying, kCorners, { pins: 'corners' }),
  hang_corners: scene('hang by two corners', upright, kCorners, {
    pins: 'corners',
    placeOf: kUpright,
  }),
  ball: scene('fall on a ball', lying, [], { pins: 'none', ball: kBall }, { world: kWorld }),
  gathered: scene('gather', upright, cornersCome(kMeet[0], kMeet[2]), {
    pins: 'corners',
    placeOf: kUpright,
    pinsMove: (time) => kMeet.map((offset) => offset * ease(time)),
  }),
};
