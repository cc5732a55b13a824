// Runs a sweep to its end, as a function of the module and of where reports go.
// The only file that calls delete() on its object.
import { describe, type Failure, internalFailure, read } from '../../shared/bindings/answers';
import type { Post } from '../../shared/workers/serve';
import type { SweepModule, SweepReport } from '../bindings/sweep-module';
import type { FromSweep, ToSweep } from './sweep-protocol';

/** Work between two progress reports of a sweep [ms]; short enough that progress looks alive. */
const SWEEP_SLICE_MS = 150;

/** Runs a sweep to its end, and reports as it goes. */
export function runSweep(module: SweepModule, message: ToSweep, post: Post<FromSweep>): void {
  const refuse = (failure: Failure) => post({ type: 'refused', failure }, []);
  const experiment = new module.Experiment(message.fabricsText);
  try {
    const started = read<object>(experiment.start(message.planText));
    if (!started.ok) return refuse(started);
    for (let done = false; !done; ) {
      const report = read<SweepReport>(experiment.advance(SWEEP_SLICE_MS));
      if (!report.ok) return refuse(report);
      post({ type: 'sweepReport', report }, []);
      done = report.done;
    }
  } catch (error) {
    refuse(internalFailure(describe(error)));
  } finally {
    experiment.delete();
  }
}
