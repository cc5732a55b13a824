// The content that each pane of the view of refinement has to load.
import { FINE_LEVEL } from '../state/garment-frames';
import { type GarmentMeshWish, sceneText, usualFabric } from '../state/garments';
import type { PlanFile } from '../state/plan-file';
import type { PaneId, RefinementState } from '../state/refinement-state';
import type { GarmentContent } from './garment-pane';
import { isUsual } from './planner';
import { floorUrl, recordUrl } from './records';

function meshOf(id: PaneId, plan: PlanFile): GarmentMeshWish {
  if (id === 'planned') return { plan };
  if (id === 'even') return 'even';
  return { level: id === 'coarse' ? 0 : FINE_LEVEL };
}

/** Runs of this cloth come with the page. */
function isRecorded({ garment, fabric, method }: RefinementState): boolean {
  return fabric === usualFabric(garment) && method === 'implicit';
}

/** Address of the record that a pane shows; null when it computes. */
function recordOf(id: PaneId, state: RefinementState): string | null {
  const { garment, motion, useRecords, substeps } = state;
  if (!isRecorded(state)) return null;
  // The fine mesh takes longest and is the same whatever is asked of the others.
  if (id !== 'fine' && (!useRecords || substeps !== null)) return null;
  if (id === 'planned' && !isUsual(state)) return null;
  return recordUrl(garment, motion, id);
}

/** Address of how far apart two runs on the fine mesh are; null where that was not measured. */
export function floorOf(state: RefinementState): string | null {
  return isRecorded(state) ? floorUrl(state.garment, state.motion) : null;
}

export function contentOf(id: PaneId, state: RefinementState, plan: PlanFile): GarmentContent {
  const { garment, motion, fabric, substeps, method } = state;
  return {
    garment,
    sceneText: sceneText(garment, motion, fabric, meshOf(id, plan), substeps, method),
    fineText: sceneText(garment, motion, fabric, { level: FINE_LEVEL }),
    isEven: id === 'even',
    recordUrl: recordOf(id, state),
  };
}
