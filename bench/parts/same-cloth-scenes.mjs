// Pieces of scenes of known cloth, and measures of their ends.
import { changed, fabricsText } from './assets.mjs';
import { explicitOnes } from './same-cloth-runs.mjs';

export const kGravity = 9.81; // [m/s^2], a scene's default
export const kAirDensity = 1.2; // [kg/m^3], likewise

/** A number of the library's fabric of that name. */
export function fabricNumber(name, key) {
  const found = JSON.parse(fabricsText()).fabrics.find(({ name_en }) => name_en === name);
  return found[key].value;
}

export const fabricNames = () => JSON.parse(fabricsText()).fabrics.map(({ name_en }) => name_en);

/**
 * The scene with that stepper at its defaults. Dampers ask of `explicit` and `rk4` for substeps of
 * 1e-8 s: they run without, where the outcome does not depend on them.
 */
export function withStepper(scene, stepper, method = {}) {
  const result = { ...scene, method: { ...method, stepper } };
  if (!explicitOnes.includes(stepper)) return result;
  return changed(result, { '/fabric/overrides/damping_ratio': 0 });
}

/** A square that lies: warp along z, weft along x, its first corner at `origin`. */
export const lyingSheet = (n, size, origin_m) => ({
  sheet: {
    width_m: size,
    height_m: size,
    columns: n,
    rows: n,
    origin_m,
    warp_direction: [0, 0, 1],
    weft_direction: [1, 0, 0],
  },
});

/** The mean of places or velocities. */
export const meanOf = (places) =>
  [0, 1, 2].map((k) => places.reduce((sum, place) => sum + place[k], 0) / places.length);

/** The largest stretch of an edge in the whole run, in shares of its length. */
export function stretchMeasure(most) {
  return {
    of: 'largest stretch',
    unit: '',
    right: 0,
    tolerance: most,
    value: ({ metrics }) => metrics.largest_stretch,
  };
}
