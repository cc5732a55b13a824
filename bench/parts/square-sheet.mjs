// The cloth that many benches hang up.

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
