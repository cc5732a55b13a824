// Plans a sweep and runs it to its end, as a function of the module and of where answers go.
// The only file that calls delete() on its object.
import { describe, type Failure, internalFailure, read } from '../../shared/bindings/answers';
import type { Post } from '../../shared/workers/serve';
import type { ExperimentHandle, SweepModule, SweepReport } from '../bindings/sweep-module';
import type { FromSweep, PlanMessage, ToSweep } from './sweep-protocol';

/** Work between two progress reports of a sweep [ms]; short enough that progress looks alive. */
const SWEEP_SLICE_MS = 150;

/** Serves one page. Call `receive` with each message, `close` at the end. */
export class SweepCore {
  private experiment: ExperimentHandle | null = null;

  constructor(
    private readonly module: SweepModule,
    private readonly post: Post<FromSweep>,
  ) {}

  receive(message: ToSweep): void {
    try {
      const failure = this.answer(message);
      if (failure) this.post({ type: 'refused', failure }, []);
    } catch (error) {
      this.post({ type: 'refused', failure: internalFailure(describe(error)) }, []);
    }
  }

  close(): void {
    this.experiment?.delete();
    this.experiment = null;
  }

  private answer(message: ToSweep): Failure | null {
    if (message.type === 'plan') return this.plan(message);
    if (!this.experiment) return internalFailure(`${message.type} before a plan`);
    return message.type === 'keep'
      ? this.keep(this.experiment, message.references)
      : this.measure(this.experiment);
  }

  private plan({ fabricsText, planText }: PlanMessage): Failure | null {
    this.experiment ??= new this.module.Experiment(fabricsText);
    const planned = read<{ references: string[] }>(this.experiment.start(planText));
    if (!planned.ok) return planned;
    this.post({ type: 'planned', references: planned.references }, []);
    return null;
  }

  private keep(experiment: ExperimentHandle, references: readonly ArrayBuffer[]): Failure | null {
    for (const bytes of references) {
      const kept = read<object>(experiment.keepReference(new Uint8Array(bytes)));
      if (!kept.ok) return kept;
    }
    return null;
  }

  /** Reports as it goes. */
  private measure(experiment: ExperimentHandle): Failure | null {
    for (let done = false; !done; ) {
      const report = read<SweepReport>(experiment.advance(SWEEP_SLICE_MS));
      if (!report.ok) return report;
      this.post({ type: 'sweepReport', report }, []);
      done = report.done;
    }
    return null;
  }
}
