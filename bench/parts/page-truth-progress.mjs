// Progress of the page's first sweep, as the page shows it, against the time that passed in truth.
import { tell } from './bench-options.mjs';
import { atLeast, atMost, table } from './bench-rows.mjs';
import { askPage } from './command.mjs';

const kMostOff = 0.1;
const kLeastTold = 0.8; // share of the time

export function progress() {
  tell("the page's first sweep, and its progress");
  const all = askPage('sweep-progress');
  const rows = all.slice(0, -1); // the last one is done
  const told = rows.filter(({ shown }) => shown !== null);
  const off = Math.max(...told.map(({ shown, passed }) => Math.abs(shown - passed)));
  const columns = {
    s: 'passed_s',
    'of the time': 'passed',
    shown: 'shown',
    'of the work': 'work',
    'left s': 'left_s',
    settings: 'n_rows',
    at: 'message',
  };
  return {
    rows: all,
    goals: [
      atMost('sweep_progress_off', off, kMostOff, rows),
      atLeast('sweep_progress_told', 1 - (told[0]?.passed ?? 1), kLeastTold, rows),
    ],
    text: `swinging sheet, levels 0 and 1, ${all.at(-1).passed_s.toFixed(1)} s\n\n${table(rows, columns)}`,
  };
}
