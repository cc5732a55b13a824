// A coarser level over the cloth, with its legend.
import { type Store, watch } from '../shared/state/store';
import { createLevelLegend } from './panels/levels/level-legend';
import { followLevels } from './run/level-source';
import type { MotionRun } from './run/motion-run';
import { createLevelOverlay } from './stage/level-overlay';
import type { MotionStage } from './stage/motion-stage';
import type { MotionState } from './state/motion-state';

export function drawLevels(
  box: HTMLElement,
  store: Store<MotionState>,
  stage: MotionStage,
  run: Pick<MotionRun, 'levels'>,
): void {
  const overlay = createLevelOverlay();
  stage.addOverlay(overlay);
  createLevelLegend(box, store);
  watch(store, ['coarse', 'coarseLevels'], ({ coarse, coarseLevels }) => {
    const levels = coarse > 0 ? (coarseLevels?.levels ?? []) : [];
    const shown = Math.min(coarse, levels.length) - 1;
    overlay.show(levels[shown] ?? null, levels[shown - 1], stage.positions().length / 3);
    stage.redraw();
  });
  followLevels(store, (wish) => run.levels(wish));
}
