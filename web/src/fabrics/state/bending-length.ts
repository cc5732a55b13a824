// How far a strip of cloth holds itself up.
import { type FabricRecord, inRun } from '../../shared/fabric/fabric-data';

/** A scene's default [m/s²]. */
export const GRAVITY = 9.81;

/**
 * (B/(w g))^(1/3) along the warp [m], of the rigidity and the weight that a run takes: a strip twice as long
 * droops by 41.5 degrees from end to end (docs/methods/closed_forms.md).
 */
export function bendingLength(fabric: FabricRecord): number {
  const rigidity = inRun(fabric, 'bend_warp_n_m').value;
  const weight = GRAVITY * inRun(fabric, 'areal_density_kg_per_m2').value;
  return Math.cbrt(rigidity / weight);
}
