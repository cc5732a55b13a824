// Sheets of fine cotton that many benches hang up.

export const kStep = 1 / 60; // [s], a picture's

/** A section "cloth": a square with sides of `size` [m], n x n vertices. */
export const squareSheet = (n, origin_m, warp_direction, weft_direction, size = 1) => ({
  sheet: {
    width_m: size,
    height_m: size,
    columns: n - 1,
    rows: n - 1,
    origin_m,
    warp_direction,
    weft_direction,
  },
});

export const lying = (n) => squareSheet(n, [0, 0, 0], [0, 0, 1], [1, 0, 0]);
export const upright = (n) => squareSheet(n, [0, 0, 0], [0, -1, 0], [1, 0, 0]);

export const kEdge = [{ part: 'upper_edge' }];
export const kCorners = [{ part: 'upper_left' }, { part: 'upper_right' }];

/** Two corners that come so far towards each other in a second, out of the sheet's plane too [m]. */
export const cornersCome = (across, out = 0) =>
  kCorners.map(({ part }, k) => {
    const offset_m = [across, 0, out].map((way) => (k === 0 ? way : -way));
    return { part, motion: { kind: 'ease', offset_m, begin_s: 0, end_s: 1 } };
  });

/** A scene of n x n vertices: cloth(n), held by `pins`, for a second. */
export const cotton = (name, n, cloth, pins, more = {}) => ({
  name: `${name} ${n}x${n}`,
  cloth: cloth(n),
  fabric: { name: 'fine cotton' },
  pins,
  duration_s: 1,
  ...more,
});

/** Cloth without bending, which the chain of rigid links is the limit of. */
export const kLimp = { model: { bending: 'none' } };

/** The scene by another method, in steps of a picture. */
export const by = (scene, method) => ({ ...scene, method: { step_s: kStep, ...method } });
