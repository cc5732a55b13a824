// The content that each pane of the view of refinement has to load.
import { FINE_LEVEL } from '../state/garment-frames';
import { sceneText, usualFabric } from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import type { PaneId, RefinementState } from '../state/refinement-state';
import type { GarmentContent } from './garment-pane';
import { isUsual } from './planner';
import { recordUrl } from './records';

function refinementOf(id: PaneId, plan: PlanFile): { level: number } | { plan: PlanFile } {
  if (id === 'planned') return { plan };
  return { level: id === 'coarse' ? 0 : FINE_LEVEL };
}

/** Address of the record that a pane shows; null when it computes. */
function recordOf(id: PaneId, state: RefinementState): string | null {
  const { garment, motion, fabric, useRecords, substeps, method } = state;
  if (fabric !== usualFabric(garment) || method !== 'implicit') return null;
  // The fine mesh takes longest and is the same whatever is asked of the others.
  if (id !== 'fine' && (!useRecords || substeps !== null)) return null;
  if (id === 'planned' && !isUsual(state)) return null;
  return recordUrl(garment, motion, id);
}

export function contentOf(id: PaneId, state: RefinementState, plan: PlanFile): GarmentContent {
  const { garment, motion, fabric, substeps, method } = state;
  return {
    garment,
    sceneText: sceneText(garment, motion, fabric, refinementOf(id, plan), substeps, method),
    recordUrl: recordOf(id, state),
  };
}
