// Runs a sweep in a worker of its own, so that the shown cloth and the page stay responsive.

import { fabricsText } from '../../shared/fabric/fabric-data';
import type { Store } from '../../shared/state/store';
import type { BenchRow } from '../bindings/sweep-module';
import type { MotionState } from '../state/motion-state';
import { type StepCosts, withCost } from '../state/step-cost';
import { hasFinished, type SweepWish, settingOfRow, sweepPlan } from '../state/sweep-plan';
import { type SweepState, sweptScene } from '../state/sweep-state';
import type { FromSweep } from '../worker/sweep-protocol';
import { type SweepClient, startSweepWorker } from './motion-client';

/** Rows tell the time of a sixtieth of a second. */
const FRAMES_PER_S = 60;

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
    if (!done) return;
    keepCosts(rows);
    end('done', text);
  }

  /** What was measured here is what a step costs. */
  function keepCosts(rows: readonly BenchRow[]): void {
    const { sweep, setting, costs } = store.get();
    if (!sweep.scene || sweep.disturbed) return;
    const { mesh: _mesh, ...swept } = sweep.scene;
    const add = (known: StepCosts, row: BenchRow) => {
      const measured = settingOfRow(row, { ...setting, ...swept });
      const ms = row.ms_per_frame === null ? 0 : row.ms_per_frame * measured.stepS * FRAMES_PER_S;
      return hasFinished(row) && ms > 0 ? withCost(known, measured, ms) : known;
    };
    store.set({ costs: rows.reduce(add, costs) });
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
