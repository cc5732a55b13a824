// Pieces of which scenes of contact are made.

export const kFloor = { plane: { point_m: [0, 0, 0], normal: [0, 1, 0] } };
export const kAir = { air: {} };

/** A rectangle of `columns` x `rows` cells, each of `cell` [m]. */
export const sheet = (
  columns,
  rows,
  cell,
  origin_m,
  warp_direction,
  weft_direction = [1, 0, 0],
) => ({
  sheet: {
    width_m: columns * cell,
    height_m: rows * cell,
    columns,
    rows,
    origin_m,
    warp_direction,
    weft_direction,
  },
});
