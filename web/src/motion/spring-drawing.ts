// The springs over the cloth, with their legend.
import type { Store } from '../shared/state/store';
import { watch } from '../shared/state/store';
import { createSpringLegend } from './panels/spring-legend';
import type { MotionStage } from './stage/motion-stage';
import { createSpringOverlay } from './stage/spring-overlay';
import type { MotionState } from './state/motion-state';

export function drawSprings(box: HTMLElement, store: Store<MotionState>, stage: MotionStage): void {
  const overlay = createSpringOverlay();
  stage.addOverlay(overlay);
  createSpringLegend(box, store);
  watch(store, ['springs', 'springSplit'], ({ springs, springSplit }) => {
    overlay.show(springs ? springSplit : null);
    stage.redraw();
  });
}
