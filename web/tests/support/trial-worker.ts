// Workers in this thread whose runs are warned of, and take as long a step, as a test says of their method.
import type { PleatModule, RunNumbers } from '../../src/shared/bindings/pleat-module';
import type { RunWarning } from '../../src/shared/bindings/run-warning';
import { createAsked } from '../../src/shared/workers/asked';
import type { StartMotion } from '../../src/shared/workers/motion-client';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { createFakeModule } from './fake-module';
import { workerPort } from './worker-port';

export interface Method {
  stepper: string;
  step_s: number;
  substeps?: number;
  iterations?: number;
}

export interface Behaviour {
  stepMs: number;
  /** Time from which on the run is warned of [s]. */
  warnedS?: number;
  /** It is warned of whenever it took another run's motion over. */
  isBadOnTheWay?: boolean;
  /** Stretch of the cloth at any time [1]. */
  stretch?: number;
}

export const aWarning: RunWarning = {
  kind: 'stretch',
  time_s: 0.4,
  vertex: 2,
  value: 0.98,
  bound: 0.35,
  sentence: 'as the command says it',
  is_nonsense: true,
  hints: {},
};

/** The stand-in's module, whose simulations behave by their method. */
function moduleOf(behaviourOf: (method: Method) => Behaviour, tried: Method[]): PleatModule {
  const { module } = createFakeModule();
  class Simulation extends module.Simulation {
    private behaviour: Behaviour = { stepMs: 0 };
    private isCarried = false;

    override load(text: string): string {
      const { method } = JSON.parse(text) as { method: Method };
      tried.push(method);
      this.behaviour = behaviourOf(method);
      this.isCarried = false;
      return super.load(text);
    }

    override carryOver(text: string): string {
      const answer = super.carryOver(text);
      this.isCarried = true;
      return answer;
    }

    override numbers(): string {
      const numbers = JSON.parse(super.numbers()) as RunNumbers;
      const { stepMs, warnedS = Number.POSITIVE_INFINITY, isBadOnTheWay, stretch } = this.behaviour;
      const isBad = numbers.time_s >= warnedS - 1e-9 || (isBadOnTheWay && this.isCarried);
      const steps_ms = stepMs * numbers.steps_timed;
      const largest_stretch = stretch ?? numbers.largest_stretch;
      return JSON.stringify({
        ...numbers,
        warnings: isBad ? [aWarning] : [],
        steps_ms,
        largest_stretch,
      });
    }
  }
  return { ...module, Simulation };
}

/** Starts such workers, and tells the methods they were given and how many live and were started. */
export function trialWorkers(behaviourOf: (method: Method) => Behaviour) {
  const tried: Method[] = [];
  let nAlive = 0;
  let nStarted = 0;
  const start: StartMotion = (listener) => {
    nAlive += 1;
    nStarted += 1;
    const port = workerPort<ToMotion, FromMotion>((post) => {
      const core = new MotionCore(moduleOf(behaviourOf, tried), post);
      return { receive: (message) => core.receive(message), close: () => core.close() };
    });
    const { terminate } = port;
    let isAlive = true;
    port.terminate = () => {
      if (isAlive) nAlive -= 1;
      isAlive = false;
      terminate();
    };
    return createAsked(port, listener);
  };
  return { start, tried, alive: () => nAlive, nStarted: () => nStarted };
}
