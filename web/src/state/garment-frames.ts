// What the view of refinement and the program that makes its records agree on.

/** Of the mesh that all others are held against, and that plans go up to. */
export const FINE_LEVEL = 2;

/** Time between frames [s]. */
export const FRAME_S = 1 / 30;

/** Patterns of a plan. */
export const PATTERNS = 3;

/** The detail demand of the plan that comes with the page. */
export const USUAL_DEMAND = 3;
