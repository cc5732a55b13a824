// The cloth that many benches hang up.

/** A section "cloth": 1 m by 1 m, n x n vertices. */
export const squareSheet = (n, origin_m, warp_direction, weft_direction) => ({
  sheet: {
    width_m: 1,
    height_m: 1,
    columns: n - 1,
    rows: n - 1,
    origin_m,
    warp_direction,
    weft_direction,
  },
});
