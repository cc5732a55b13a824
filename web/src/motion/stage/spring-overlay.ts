// The springs over the cloth of the view of motion.
import type { SpringSplit } from '../../shared/bindings/pleat-module';
import type { Overlay } from '../../shared/stage/overlay';
import { createSpringLines } from '../../shared/stage/spring-lines';

export interface SpringOverlay extends Overlay {
  /** Null draws none. */
  show(split: SpringSplit | null): void;
}

export function createSpringOverlay(): SpringOverlay {
  const lines = createSpringLines();
  return {
    object: lines.object,
    update: lines.update,
    clear: () => lines.setSplit(null),
    show: lines.setSplit,
    themed(colour) {
      const [explicit, implicit] = [colour('--spring-explicit'), colour('--spring-implicit')];
      lines.setColours({ explicit, implicit });
    },
  };
}
