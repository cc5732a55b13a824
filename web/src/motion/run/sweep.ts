// Runs a sweep in a worker of its own, so that the shown cloth and the page stay responsive.

import { fabricsText } from '../../shared/fabric/fabric-data';
import type { Store } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';
import { type SweepWish, sweepPlan } from '../state/sweep-plan';
import { type SweepState, sweptScene } from '../state/sweep-state';
import type { FromSweep } from '../worker/sweep-protocol';
import { type SweepClient, startSweepWorker } from './motion-client';

/** Less than this of a sweep tells nothing of the rest. */
const LEAST_PROGRESS = 0.02;

export interface Sweep {
  /** Measures the shown scene. */
  start(wish: SweepWish): void;
  /** Ends at once; the rows so far stay. */
  cancel(): void;
}

export function createSweep(store: Store<MotionState>): Sweep {
  let worker: SweepClient | null = null;

  function patch(change: Partial<SweepState>): void {
    store.set({ sweep: { ...store.get().sweep, ...change } });
  }

  function end(phase: SweepState['phase'], message: string): void {
    worker?.terminate();
    worker = null;
    patch({ phase, message });
  }

  function news(message: FromSweep): void {
    if (message.type === 'refused') return end('failed', message.failure.what);
    const { rows, front, progress, done, message: text, estimated_s: toldS } = message.report;
    const { beganMs } = store.get().sweep;
    const soFarS = (performance.now() - beganMs) / 1000;
    const estimatedS = toldS ?? (progress < LEAST_PROGRESS ? null : soFarS / progress);
    patch({ rows, front, progress, message: text, estimatedS });
    if (done) end('done', text);
  }

  store.subscribe((state, previous) => {
    const isMoving = state.playing || state.ahead !== null;
    const { phase, disturbed } = state.sweep;
    const wasSo =
      (previous.playing || previous.ahead !== null) && previous.sweep.phase === 'running';
    if (isMoving && phase === 'running' && !disturbed && !wasSo) patch({ disturbed: true });
  });

  return {
    start(wish) {
      worker?.terminate();
      const { setting, mesh } = store.get();
      store.set({
        playing: false, // a second busy worker would make every time too long
        sweepOpen: true,
        sweep: {
          phase: 'running',
          progress: 0,
          message: 'Computing the reference',
          beganMs: performance.now(),
          estimatedS: null,
          rows: [],
          front: [],
          scene: sweptScene(setting, mesh),
          disturbed: false,
        },
      });
      worker = startSweepWorker({ news, broken: (reason) => end('failed', reason) });
      const planText = JSON.stringify(sweepPlan(setting, wish, mesh));
      worker.tell({ type: 'sweep', fabricsText, planText });
    },
    cancel() {
      if (worker) end('cancelled', 'Cancelled; the rows so far stay.');
    },
  };
}
