// Line on what imex saves at the substeps that the slider shows.
import { choice, element, field, setText } from '../../../shared/panels/element';
import { digits, milliseconds, percent } from '../../../shared/panels/quantity';
import { type Store, watch } from '../../../shared/state/store';
import { stepperRow } from '../../../shared/steppers/steppers';
import { ImexSavingSource } from '../../run/imex-saving-source';
import type { MotionRun } from '../../run/motion-run';
import type { ImexSaving } from '../../state/imex-saving';
import type { MotionState } from '../../state/motion-state';
import { EXPLICIT_SHARES } from '../../state/setting';

const SHARES = EXPLICIT_SHARES.map((share) => ({
  value: share,
  title: share === 0 ? 'As many as are stable' : `At least ${percent(share)}`,
}));

function timeWords(time: ImexSaving['time']): string {
  if (time === 'measuring') return 'measuring what a step takes …';
  if (time === 'unasked') return 'drag to measure what a step takes.';
  if (time === null) return 'what a step takes could not be measured.';
  return `a step takes ${digits(time, 2)} of ${stepperRow('implicit').title}’s time.`;
}

/** "Of 261 springs 45 % are implicit in substeps of 2.4 ms; a step takes 0.61 of Implicit’s time." */
export function savingWords({ nSprings, substepS, share, time }: ImexSaving): string {
  const substep = milliseconds(1000 * substepS);
  const springs = `Of ${nSprings} springs ${percent(share)} are implicit in substeps of ${substep}`;
  return `${springs}; ${timeWords(time)}`;
}

export function createImexPanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  run: Pick<MotionRun, 'implicitShare'>,
): void {
  const least = choice(SHARES, (explicitShare) =>
    store.set({ setting: { ...store.get().setting, explicitShare } }),
  );
  const leastField = field('Springs that shall be explicit', least.control);
  leastField.title = 'As many substeps more are taken as that asks for.';
  const words = element('p', { class: 'note imex-saving' });
  parent.append(leastField, words);
  new ImexSavingSource(store, (setting) => run.implicitShare(setting));
  watch(store, ['imexSaving'], ({ imexSaving }) => {
    words.hidden = imexSaving === null;
    setText(words, imexSaving ? savingWords(imexSaving) : '');
  });
  watch(store, ['setting'], ({ setting }) => {
    leastField.hidden = setting.stepper !== 'imex';
    least.select(setting.explicitShare);
  });
}
