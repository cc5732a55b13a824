// Marks the vertex at which a run is at its worst, for as long as that is told.
import './place-drawing.css';
import { type Store, watch } from '../shared/state/store';
import type { MotionStage } from './stage/motion-stage';
import { createPlaceRing } from './stage/place-ring';
import type { MotionState } from './state/motion-state';

export function drawPlace(box: HTMLElement, store: Store<MotionState>, stage: MotionStage): void {
  const ring = createPlaceRing(box, stage.project);
  stage.addOverlay(ring);
  watch(store, ['problem'], ({ problem }) => {
    ring.show(problem?.vertex ?? null);
    stage.redraw();
  });
}
