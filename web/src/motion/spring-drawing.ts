// The springs over the cloth, with their legend.
import type { Overlay } from '../shared/stage/overlay';
import { createSpringLines } from '../shared/stage/spring-lines';
import { type Store, watch } from '../shared/state/store';
import { createSpringLegend } from './panels/spring-legend';
import type { MotionStage } from './stage/motion-stage';
import type { MotionState } from './state/motion-state';

export function drawSprings(box: HTMLElement, store: Store<MotionState>, stage: MotionStage): void {
  const lines = createSpringLines();
  const overlay: Overlay = {
    object: lines.object,
    update: lines.update,
    clear: () => lines.setSplit(null),
    themed(colour) {
      const [explicit, implicit] = [colour('--spring-explicit'), colour('--spring-implicit')];
      lines.setColours({ explicit, implicit });
    },
  };
  stage.addOverlay(overlay);
  createSpringLegend(box, store);
  watch(store, ['springs', 'springSplit'], ({ springs, springSplit }) => {
    lines.setSplit(springs ? springSplit : null);
    stage.redraw();
  });
}
