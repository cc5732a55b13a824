// Measures what a step of many substeps takes before one is through: on a few of them, in a worker of their own.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { type Store, watch } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { type StartMotion, startMotionWorker } from '../../shared/workers/motion-client';
import type { MotionState } from '../state/motion-state';
import { sceneOf, wantedShare } from '../state/setting';
import { MANY_SUBSTEPS, stepCostAt, withCost } from '../state/step-cost';
import { type Content, loadOf } from './run-content';

/** A setting that stands for so long is measured [ms]. */
const REST_MS = 300;

/** Substeps that are made at once. */
const SUBSTEPS = 16;

/** A browser takes some time to make WebAssembly fast: work before that does not count [ms]. */
const WARM_MS = 400;
/** Browsers round their clocks to as much as 0.1 ms: over this much work that is below 1 % [ms]. */
const ENOUGH_MS = 50;

/** A hair shorter than it may be, as a step goes through text. */
const SHORTER = 1 - 1e-9;

/** The scene in steps of a few substeps, each as long as one of so many a step. */
function shortSteps(content: Content, nSubsteps: number) {
  const { setting, mesh } = content;
  const scene = sceneOf(setting, mesh);
  const step_s = (SHORTER * setting.stepS * SUBSTEPS) / nSubsteps;
  const method = { ...(scene.method as object), step_s, substeps: SUBSTEPS };
  return { ...loadOf(content), sceneText: JSON.stringify({ ...scene, method }) };
}

/** Time of a step of so many substeps [ms]; null where the worker was ended, or the cloth cannot be run. */
export async function probeStep(
  client: ReturnType<StartMotion>,
  content: Content,
  nSubsteps: number,
): Promise<number | null> {
  const none = () => undefined;
  await answerOf(client.ask({ type: 'open', fabricsText }), none);
  const question = { type: 'load', ...shortSteps(content, nSubsteps), keepMotion: false } as const;
  const loaded = await answerOf(client.ask(question), none);
  let buffer = loaded?.buffers[0];
  let warm: RunNumbers | null = null;
  while (buffer) {
    const steps = { type: 'step', count: 2, buffer, wantsNumbers: true } as const;
    const frame = await answerOf(client.ask(steps, [buffer]), none);
    if (frame?.type !== 'frame' || !frame.report || frame.hasEnded) return null;
    const { numbers } = frame.report;
    if (numbers.steps_ms >= WARM_MS) warm ??= numbers;
    const ms = numbers.steps_ms - (warm?.steps_ms ?? numbers.steps_ms);
    const nSteps = numbers.steps_timed - (warm?.steps_timed ?? 0);
    if (ms >= ENOUGH_MS) return ((ms / nSteps) * nSubsteps) / SUBSTEPS;
    buffer = frame.buffer;
  }
  return null;
}

/** Has the state know what a step of a loaded setting takes, where it has many substeps and none is through. */
export function foretellSteps(
  store: Store<MotionState>,
  start: StartMotion = startMotionWorker,
): void {
  let cancel = (): void => undefined;
  watch(store, ['summary', 'setting'], ({ summary, setting, mesh, costs, phase }) => {
    cancel();
    const isShare = wantedShare(setting) > 0; // it depends on the substeps as a whole
    if (phase !== 'ready' || !summary || summary.substeps < MANY_SUBSTEPS || isShare) return;
    if (stepCostAt(costs, setting, setting.level)?.isMeasured) return;
    const rest = setTimeout(async () => {
      const client = start({});
      cancel = () => client.terminate();
      const ms = await probeStep(client, { setting, mesh }, summary.substeps);
      client.terminate();
      const known = stepCostAt(store.get().costs, setting, setting.level);
      if (ms === null || known?.isMeasured) return;
      store.set({ costs: withCost(store.get().costs, setting, ms, { isMeasured: false }) });
    }, REST_MS);
    cancel = () => clearTimeout(rest);
  });
}
