// Words on what a run is at, and on what ended it.
import { frameViews } from '../../shared/bindings/frame';
import type { RunReport } from '../../shared/workers/motion-protocol';
import type { Setting } from '../state/setting';

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
