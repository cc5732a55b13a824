// The order of the list of fabrics: as their source numbers them, or by a physical quantity.
import {
  type FabricQuantity,
  type FabricRecord,
  fabrics,
  inRun,
} from '../../shared/fabric/fabric-data';

export const ORDERS = ['source', 'bending', 'weight', 'stretch'] as const;
export type FabricOrder = (typeof ORDERS)[number];

const QUANTITIES: Record<FabricOrder, FabricQuantity | null> = {
  source: null,
  bending: 'bend_warp_n_m',
  weight: 'areal_density_kg_per_m2',
  stretch: 'stretch_warp_n_per_m',
};

/** The number that the list is ordered by; null for the numbers of the source. */
export function quantityOf(order: FabricOrder): FabricQuantity | null {
  return QUANTITIES[order];
}

function amountOf(fabric: FabricRecord, key: FabricQuantity): number {
  return inRun(fabric, key).value;
}

/** The greatest value first. */
export function orderedFabrics(order: FabricOrder): readonly FabricRecord[] {
  const key = quantityOf(order);
  return key === null ? fabrics : [...fabrics].sort((a, b) => amountOf(b, key) - amountOf(a, key));
}

/** 1 for the fabric with the greatest value. */
export function rankOf(fabric: FabricRecord, key: FabricQuantity): number {
  return 1 + fabrics.filter((other) => amountOf(other, key) > amountOf(fabric, key)).length;
}
