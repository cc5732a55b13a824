// How wrong the shown cloth is, as far as that is known, in words.

import type { ReferenceNumbers, RunNumbers } from '../../../shared/bindings/pleat-module';
import { digits, percent, smallLength } from '../../../shared/panels/quantity';
import { stepperRow } from '../../../shared/steppers/steppers';
import { referenceUrl } from '../../run/references';
import { type MotionState, wantsReference } from '../../state/motion-state';
import { presetSetting, type Setting } from '../../state/setting';
import { comparableS, SURER } from '../../state/sweep-plan';
import { rowOfSetting } from '../../state/sweep-state';

export interface ErrorWords {
  value: string;
  detail: string;
  sentence: string;
  /** The way to bring the number, where there is one. */
  action?: string;
}

type ErrorState = Pick<
  MotionState,
  'numbers' | 'setting' | 'sweep' | 'mesh' | 'reference' | 'compare' | 'heat'
>;

/** Less than this is left of the equations: nothing but rounding. */
const EXACT_RESIDUAL = 1e-8;

/** Words on a cloth that has not the mesh of its reference, from when on their folds differ by chance. */
function fromOtherMesh({ preset }: Pick<Setting, 'preset'>): ErrorWords {
  const { level } = presetSetting(preset);
  const sentence = `Folds differ from mesh to mesh. Choose level ${level} to compare.`;
  return { value: '–', detail: `known at level ${level}`, sentence };
}

/** `isOwnMesh`: the cloth has the mesh of the reference. */
function fromReference(reference: ReferenceNumbers, isOwnMesh: boolean): ErrorWords {
  const { distance_m: distance, uncertainty_m: uncertainty, end_s, disturbed } = reference;
  if (disturbed) {
    const sentence =
      'The cloth was pulled or changed on its way: reset to compare it with its reference.';
    return { value: '–', detail: 'reset to compare', sentence };
  }
  if (distance === null) {
    const end = `${digits(end_s, 2)} s`;
    const sentence = `No error from here on: the reference ends at ${end}.`;
    return { value: '–', detail: `known up to ${end}`, sentence };
  }
  if (uncertainty === null) {
    const sentence = 'The reference of this scene did not converge: no error can be told from it.';
    return { value: 'unknown', detail: 'no converged one', sentence };
  }
  const known = `known to ${smallLength(uncertainty)}`;
  if (distance < SURER * uncertainty) {
    const sentence = `Too close to the reference to tell how far: it is ${known}.`;
    return { value: 'too close to tell', detail: known, sentence };
  }
  const value = smallLength(distance);
  if (!isOwnMesh) {
    const sentence = `${value} from the reference, in which the other mesh has its share.`;
    return { value, detail: 'of another mesh', sentence };
  }
  return { value, detail: known, sentence: `${value} from the reference (${known}).` };
}

/** The error as far as it is known without a reference: the equations' residual and the stretch. */
function fromItself(numbers: RunNumbers, solves: boolean): string {
  const parts = ['How wrong this is, nobody has measured.'];
  const { step, iterations, residual, largest_stretch } = numbers;
  const isReported = !solves || iterations > 0 || residual > 0;
  if (step === 0 || !isReported) return parts.join(' ');
  const within = residual < EXACT_RESIDUAL ? 'exactly' : `to ${percent(residual)}`;
  parts.push(solves ? `The sums are right ${within};` : 'The method has no sums to check;');
  parts.push(`threads are stretched by ${percent(largest_stretch)} at most.`);
  return parts.join(' ');
}

/** Words until the reference of the scene is there; null when it is, or when there is none. */
function beforeReference(state: ErrorState): ErrorWords | null {
  const { reference, setting } = state;
  if (referenceUrl(setting) === null || reference === 'here') return null;
  if (reference === 'failed') {
    const sentence = 'The reference of this scene could not be fetched. Check the connection.';
    return { value: 'unknown', detail: 'no reference yet', sentence, action: 'Try again' };
  }
  if (wantsReference(state))
    return { value: '–', detail: 'comes in a moment', sentence: 'Fetching the reference.' };
  const sentence = 'How wrong is it? This scene has a reference to compare with.';
  return { value: '–', detail: 'compare to see', sentence, action: 'Compare' };
}

/** Error that the last sweep found for the very same setting; null when it did not. */
function fromSweep(state: ErrorState): ErrorWords | null {
  const row = rowOfSetting(state);
  if (!row || row.position_error_m === null) return null;
  const value = smallLength(row.position_error_m);
  const { converged } = row.reference;
  const exact = converged ? 'the exact motion' : 'a fine run that is no converged reference';
  const than = `${exact} on ${state.sweep.meshError === 'known' ? 'a finer mesh' : 'its own mesh'}`;
  const detail = converged ? 'in the sweep' : 'by a rough reference';
  return { value, detail, sentence: `In the sweep it was ${value} from ${than}.` };
}

export function errorWords(state: ErrorState): ErrorWords {
  const { numbers, setting } = state;
  if (!numbers) return { value: '–', detail: '', sentence: '' };
  const inSweep = fromSweep(state);
  const before = beforeReference(state);
  if (before) return { ...before, ...(wantsReference(state) ? null : inSweep) };
  if (numbers.reference && numbers.step === 0) {
    const sentence = 'This scene has a reference: play to see how far from it the cloth gets.';
    return { value: '–', detail: 'play to see', sentence };
  }
  const isOwnMesh = setting.level === presetSetting(setting.preset).level;
  if (numbers.reference && !isOwnMesh && numbers.time_s > comparableS(setting))
    return fromOtherMesh(setting);
  if (numbers.reference) return fromReference(numbers.reference, isOwnMesh);
  const sentence = fromItself(numbers, stepperRow(setting.stepper).solves);
  return inSweep ?? { value: 'unknown', detail: 'run a sweep', sentence };
}
