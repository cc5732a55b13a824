// Numbers of a fabric in words, those marked "~" that come of a quantity nobody measured on this very kind of cloth.
import { type FabricQuantity, type FabricRecord, inRun } from '../../shared/fabric/fabric-data';
import { quantityText } from '../../shared/panels/fabric-quantities';
import { bendingLength } from '../state/bending-length';

/** Quantities by which a strip droops. */
const OF_DROOP: readonly FabricQuantity[] = ['bend_warp_n_m', 'areal_density_kg_per_m2'];

function markOf(fabric: FabricRecord, keys: readonly FabricQuantity[]): string {
  return keys.every((key) => inRun(fabric, key).confidence === 'measured') ? '' : '~';
}

/** "~45 µN·m" */
export function markedQuantity(fabric: FabricRecord, key: FabricQuantity): string {
  return markOf(fabric, [key]) + quantityText(fabric, key);
}

/** "~26 mm": two digits are more than is known. */
export function bendingLengthWords(fabric: FabricRecord): string {
  return `${markOf(fabric, OF_DROOP)}${(1000 * bendingLength(fabric)).toFixed(0)} mm`;
}

/** "~41°"; empty for a strip that is not at rest yet. */
export function droopWords(fabric: FabricRecord, droop: number | undefined): string {
  return droop === undefined ? '' : `${markOf(fabric, OF_DROOP)}${droop.toFixed(0)}°`;
}
