// Plans a sweep and runs it to its end, as a function of the module and of where answers go.
// The only file that calls delete() on its object.
import { granted } from '../../shared/bindings/answers';
import { ModuleCore } from '../../shared/workers/serve';
import type { ExperimentHandle, SweepModule, SweepReport } from '../bindings/sweep-module';
import type { FromSweep, PlanMessage, ToSweep } from './sweep-protocol';

/** Work between two progress reports of a sweep [ms]; short enough that progress looks alive. */
const SWEEP_SLICE_MS = 150;

/** Serves one page. Call `receive` with each message, `close` at the end. */
export class SweepCore extends ModuleCore<SweepModule, ToSweep, FromSweep> {
  private experiment: ExperimentHandle | null = null;

  close(): void {
    this.experiment?.delete();
    this.experiment = null;
  }

  protected handle(message: ToSweep): void {
    if (message.type === 'plan') return this.plan(message);
    if (!this.experiment) throw new Error(`${message.type} before a plan`);
    if (message.type === 'measure') return this.measure(this.experiment);
    for (const bytes of message.references)
      granted(this.experiment.keepReference(new Uint8Array(bytes)));
  }

  private plan({ fabricsText, planText }: PlanMessage): void {
    this.experiment ??= new this.module.Experiment(fabricsText);
    const { references } = granted<{ references: string[] }>(this.experiment.start(planText));
    this.post({ type: 'planned', references }, []);
  }

  /** Reports as it goes. */
  private measure(experiment: ExperimentHandle): void {
    for (let done = false; !done; ) {
      const report = granted<SweepReport>(experiment.advance(SWEEP_SLICE_MS));
      this.post({ type: 'sweepReport', report }, []);
      done = report.done;
    }
  }
}
