// Numbers that the view of refinement, the program that makes its records and benches agree on.

/** The picture that the view opens on: whose garment, in which motion, at which time [s]. */
export const FIRST_PICTURE = { garment: 'skirt', motion: 'fast_walk', startS: 0 } as const;

/** Level of the mesh that all others are compared with, and the finest level of a plan. */
export const FINE_LEVEL = 2;

/** Time between frames [s]. */
export const FRAME_S = 1 / 30;

/** Frames of an example count from when the cloth has settled into the motion [s]. */
export const SETTLED_S = 2;

/** How long an example that is run on this device is watched: the longest cycle of a motion [s]. */
export const SEEN_S = 3;

/** Frames that such an example takes. */
export const EXAMPLE_FRAMES = Math.round((SETTLED_S + SEEN_S) / FRAME_S);

/** One in so many of an example's frames is kept for a plan's limits. */
export const KEPT_OF = 3;

/** Share of its faces beyond which a mesh is no longer for a motion; docs/methods/multiresolution.md. */
export const LARGEST_SHARE = 0.05;
/** Frames in a row for which it has to be. */
export const FRAMES_TO_FIRE = 10;

/** Patterns of a plan. */
export const PATTERNS = 3;

/** Loss that the plans that come with the page may lose of their example's shapes, root mean square [mm]. */
export const USUAL_DEMANDS_MM = { skirt: 1.4, trousers: 1.5, slim_trousers: 1.3 };
