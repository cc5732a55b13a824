// Runs a sweep in a worker of its own, so that the shown cloth and the page stay responsive.

import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import type { BenchRow, SweepReport } from '../bindings/sweep-module';
import type { MotionState } from '../state/motion-state';
import { type StepCosts, withCost } from '../state/step-cost';
import {
  hasFinished,
  type ReferenceKind,
  type SweepPlan,
  type SweepWish,
  sweepPlan,
  sweptSetting,
} from '../state/sweep-plan';
import { progressOf } from '../state/sweep-progress';
import { type SweepState, settingIn, sweptScene } from '../state/sweep-state';
import type { FromSweep } from '../worker/sweep-protocol';
import { type StartSweep, type SweepClient, startSweepWorker } from './measuring-client';
import { planSweep } from './sweep-references';

/** Rows tell the time of a sixtieth of a second. */
const FRAMES_PER_S = 60;

export interface Sweep {
  /** Measures the scene that is wished for. */
  start(wish: SweepWish): void;
  /** Ends at once; the rows so far stay. */
  cancel(): void;
}

/** How far a sweep is, as far as that is known. */
function toldOf(
  report: SweepReport,
  plan: SweepPlan,
  { meshError, progress }: SweepState,
  passedS: number,
): Pick<SweepState, 'progress' | 'leftS'> {
  if (report.done) return { progress: 1, leftS: 0 };
  const makes = meshError !== 'known'; // references that no file had
  const told = progressOf(report, plan, makes, passedS, progress ?? 0);
  return { progress: told?.share ?? null, leftS: told?.leftS ?? null };
}

export function createSweep(
  store: Store<MotionState>,
  startWorker: StartSweep = startSweepWorker,
): Sweep {
  let worker: SweepClient | null = null;
  let measuringMs = 0; // when its work began, on the page's clock
  let plan: SweepPlan | null = null;

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
    if (message.type !== 'sweepReport') return;
    const { rows, front, done, message: text } = message.report;
    const passedS = (performance.now() - measuringMs) / 1000;
    const told = plan && toldOf(message.report, plan, store.get().sweep, passedS);
    patch({ rows, front, message: text, ...told });
    if (!done) return;
    keepCosts(rows);
    end('done', text);
  }

  /** Keeps what was measured here as the cost of a step. */
  function keepCosts(rows: readonly BenchRow[]): void {
    const { sweep, setting, costs } = store.get();
    if (!sweep.scene || sweep.disturbed) return;
    const { scene } = sweep;
    const add = (known: StepCosts, row: BenchRow) => {
      const measured = settingIn(scene, row, setting);
      const ms = row.ms_per_frame === null ? 0 : row.ms_per_frame * measured.stepS * FRAMES_PER_S;
      return hasFinished(row) && ms > 0 ? withCost(known, measured, ms) : known;
    };
    store.set({ costs: rows.reduce(add, costs) });
  }

  async function measure(own: SweepClient, wish: SweepWish): Promise<void> {
    const { setting: shown, mesh } = store.get();
    const setting = sweptSetting(shown, wish);
    const planOf = (reference: ReferenceKind) => sweepPlan(setting, wish, mesh, reference);
    const planned = planSweep(own, planOf);
    const meshError = await answerOf(planned, (failure) => end('failed', failure.what));
    if (meshError === null || worker !== own) return;
    patch({ meshError });
    plan = planOf('same_mesh');
    measuringMs = performance.now();
    own.tell({ type: 'measure' });
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
          progress: null,
          message: 'Fetching the references',
          leftS: null,
          meshError: 'unshipped',
          rows: [],
          front: [],
          scene: sweptScene(sweptSetting(setting, wish), mesh),
          disturbed: false,
        },
      });
      worker = startWorker({ news, broken: (reason) => end('failed', reason) });
      void measure(worker, wish);
    },
    cancel() {
      if (worker) end('cancelled', 'Cancelled; the rows so far stay.');
    },
  };
}
