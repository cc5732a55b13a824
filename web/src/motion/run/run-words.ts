// Words on what a run is at, on what ended it, and on how it starts again.
import { frameViews } from '../../shared/bindings/frame';
import { stepTitle } from '../../shared/panels/quantity';
import { stepperRow } from '../../shared/steppers/steppers';
import type { RunReport } from '../../shared/workers/motion-protocol';
import { COUNTS, MODEL_TRAITS, type Setting } from '../state/setting';

/** Last place of the vertex that a message names, in words; nothing when it names none. */
function placeOf(message: string, frame: ArrayBuffer): string {
  const vertex = Number(/^vertex (\d+)/.exec(message)?.[1] ?? Number.NaN);
  const place = frameViews(frame).positions.subarray(3 * vertex, 3 * vertex + 3);
  if (place.length < 3) return '';
  return ` It was last at (${Array.from(place, (metres) => metres.toFixed(2)).join(', ')}) m.`;
}

/** Says what ended a run, in which step and where. `frame` is the last finite one. */
export function endOf(report: RunReport | null, frame: ArrayBuffer): string {
  const next = 'The last good frame stays; reset to start again.';
  if (!report) return `The run stopped without a report. ${next}`;
  const { numbers, status, message } = report;
  const reason = `${status.replaceAll('_', ' ')}: ${message.replace(/[.]$/, '')}`;
  return `The run stopped in step ${numbers.step + 1}, ${reason}.${placeOf(message, frame)} ${next}`;
}

/** Words on what the worker is at, for a question of this type. */
export function workWords(type: string, { level }: Setting): string {
  if (type === 'step') return `One step at level ${level}`;
  if (type === 'load' || type === 'reset') return `Building level ${level}`;
  if (type === 'open') return 'Fetching the program';
  if (type === 'readLevels') return `Making coarser levels of level ${level}`;
  return 'The work at hand';
}

/** Parts of a setting by their names on the page. */
function partsOf(setting: Setting): [string, string][] {
  const { stepper, level, fabric, model, stepS, meetsItself, ...counts } = setting;
  const { title, settings } = stepperRow(stepper);
  const read = COUNTS.filter((count) => settings[count]);
  return [
    ['method', title],
    ['level', `${level}`],
    ['fabric', fabric],
    ['model', MODEL_TRAITS[model].title],
    ['step', stepTitle(stepS)],
    ['contact of the cloth with itself', meetsItself ? 'on' : 'off'],
    ...read.map((count): [string, string] => [
      `number of ${count}`,
      `${counts[count] || 'stable'}`,
    ]),
  ];
}

/** Words on cloth that starts again in another setting than it was to have: one that ran before, or the scene's. */
export function backWords(from: Setting, to: Setting, hasRun: boolean): string {
  const old = new Map(partsOf(from));
  const changed = partsOf(to).filter(([part, value]) => old.get(part) !== value);
  // Counts go with their method.
  const told =
    from.stepper === to.stepper ? changed : changed.filter(([part]) => !/^number/.test(part));
  if (told.length === 0) return 'The cloth is back at its start.';
  const why = hasRun ? 'again, as before' : 'again, as this scene has it';
  const words = told.map(([part, value]) => `the ${part} is ${value}`).join(' and ');
  return `T${words.slice(1)} ${why}, and the cloth is back at its start.`;
}
