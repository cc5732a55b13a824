// Times imex against implicit with cg on the same scene, as a function of the module.
// The only file that calls delete() on its objects.
import { granted } from '../../shared/bindings/answers';
import type {
  PleatModule,
  SceneSummary,
  SimulationHandle,
} from '../../shared/bindings/pleat-module';
import { type Refusal, refusalOf } from '../../shared/bindings/refusals';
import type { RacedMessage, ToRace } from './measuring-protocol';

type Module = Pick<PleatModule, 'Scene' | 'Simulation'>;

/** Shortest batch [ms]: clocks of browsers step by as much as 0.1 ms. */
const BATCH_MS = 50;

const N_ROUNDS = 5;

/** Latest beginning of a round [ms]: there are fewer rounds where they are long. */
const LAST_BEGIN_MS = 3000;

interface ParsedScene {
  scene: { method: { step_s: number; tolerance: number; first_contact_m: number } };
  summary: SceneSummary;
}

function parse(module: Module, { fabricsText, sceneText }: ToRace): ParsedScene {
  const reader = new module.Scene(fabricsText);
  try {
    return granted<ParsedScene>(reader.parse(sceneText));
  } finally {
    reader.delete();
  }
}

/** The scene with as many substeps of implicit, solved to the same tolerance. */
function implicitText(sceneText: string, { scene, summary }: ParsedScene): string {
  const { step_s, tolerance, first_contact_m } = scene.method;
  const { substeps } = summary;
  const own = { step_s, tolerance, first_contact_m };
  const method = { stepper: 'implicit', substeps, solver: 'cg', ...own };
  return JSON.stringify({ ...JSON.parse(sceneText), method });
}

class RunEnded extends Error {}

/** Steps whose time is taken; the first, which sets things up, is not counted. */
class TimedSteps {
  count = 0;
  ms = 0;

  constructor(
    private readonly simulation: SimulationHandle,
    private readonly now: () => number,
  ) {
    this.step();
  }

  private step(): void {
    if (this.simulation.step(1) !== 0) throw new RunEnded();
  }

  /** Steps for at least so long [ms], and to at least so many steps in all. */
  go(leastMs: number, leastCount: number): void {
    const begin = this.now();
    let ms = 0;
    while (ms < leastMs || this.count < leastCount) {
      this.step();
      this.count += 1;
      ms = this.now() - begin;
    }
    this.ms += ms;
  }
}

/** Both take the same steps, at least a batch each; the ratio of their times. */
function round(one: TimedSteps, other: TimedSteps): number {
  const [oneMs, otherMs] = [one.ms, other.ms];
  one.go(BATCH_MS, 0);
  other.go(BATCH_MS, one.count);
  one.go(0, other.count);
  return (one.ms - oneMs) / (other.ms - otherMs);
}

function median(values: number[]): number | null {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? null;
}

/** Rounds of the two in turn, so that what slows the device down slows both. */
function ratioOf(imex: SimulationHandle, implicit: SimulationHandle, now: () => number) {
  const ratios: number[] = [];
  try {
    const [one, other] = [new TimedSteps(imex, now), new TimedSteps(implicit, now)];
    const begin = now();
    do ratios.push(round(one, other));
    while (ratios.length < N_ROUNDS && now() - begin < LAST_BEGIN_MS);
  } catch (error) {
    if (!(error instanceof RunEnded)) throw error;
    return null;
  }
  return median(ratios);
}

export function race(
  module: Module,
  message: ToRace,
  now = () => performance.now(),
): RacedMessage | Refusal {
  const { fabricsText, sceneText } = message;
  const runs: SimulationHandle[] = [];
  const load = (text: string) => {
    const run = new module.Simulation(fabricsText);
    runs.push(run);
    granted(run.load(text));
    return run;
  };
  try {
    const parsed = parse(module, message);
    const imex = load(sceneText);
    const implicit = load(implicitText(sceneText, parsed));
    return { type: 'raced', ratio: ratioOf(imex, implicit, now) };
  } catch (error) {
    return refusalOf(error);
  } finally {
    for (const run of runs) run.delete();
  }
}
