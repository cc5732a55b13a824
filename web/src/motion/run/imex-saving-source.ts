// Follows the substeps of imex, also while their slider is dragged: the share of implicit springs comes at
// once from the cloth that is loaded, what a step saves is measured beside it once the slider rests.

import type { ImexShare } from '../../shared/bindings/pleat-module';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { type Store, watch } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import type { ImexSaving } from '../state/imex-saving';
import type { MotionState } from '../state/motion-state';
import { type Setting, sceneOf } from '../state/setting';
import { Beside } from './beside';
import { type StartMeasuring, startMeasuringWorker } from './measuring-client';

/** A slider that stands for so long rests [ms]. */
const REST_MS = 400;

/** The setting as the slider shows it. */
function shownSetting({ setting, draggedSubsteps }: MotionState): Setting {
  return { ...setting, substeps: draggedSubsteps ?? setting.substeps };
}

export class ImexSavingSource {
  private sceneText: string | null = null; // the scene that is told of, or asked about
  private isAsking = false;
  private isFirst = true; // nobody has moved anything yet: nothing is measured unasked
  private readonly race: Beside;

  constructor(
    private readonly store: Store<MotionState>,
    private readonly readShare: (setting: Setting) => Promise<ImexShare | null>,
    start: StartMeasuring = startMeasuringWorker,
  ) {
    this.race = new Beside(start, REST_MS);
    watch(store, ['setting', 'draggedSubsteps', 'phase'], () => void this.follow());
  }

  private async follow(): Promise<void> {
    const state = this.store.get();
    const setting = shownSetting(state);
    if (setting.stepper !== 'imex') return this.forget();
    const sceneText = JSON.stringify(sceneOf(setting));
    if (sceneText === this.sceneText) return;
    this.race.cancel();
    if (this.isAsking || state.phase !== 'ready' || !state.summary) return;
    this.sceneText = sceneText;
    this.isAsking = true;
    const answer = await this.readShare(setting);
    this.isAsking = false;
    if (answer === null) this.sceneText = null;
    else {
      const { substeps, share } = answer;
      const nSprings = state.summary.n_springs;
      this.tell({ nSprings, substepS: setting.stepS / substeps, share }, sceneText);
    }
    void this.follow();
  }

  private tell(known: Omit<ImexSaving, 'time'>, sceneText: string): void {
    const time = this.isFirst ? 'unasked' : 'measuring';
    this.isFirst = false;
    this.store.set({ imexSaving: { ...known, time } });
    if (time !== 'measuring') return;
    this.race.later(
      (client) => answerOf(client.ask({ type: 'race', fabricsText, sceneText }), () => undefined),
      (answer) => {
        const { imexSaving } = this.store.get();
        if (!imexSaving) return;
        this.store.set({ imexSaving: { ...imexSaving, time: answer?.ratio ?? null } });
      },
    );
  }

  private forget(): void {
    this.race.cancel();
    this.sceneText = null;
    this.isFirst = true;
    this.store.set({ imexSaving: null });
  }
}
