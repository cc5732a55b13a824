// The page's scenes with each stepper as it starts there, touched by nobody: none shows nonsense.
import { tell } from './bench-options.mjs';
import { atMost, table } from './bench-rows.mjs';
import { askPage } from './command.mjs';

export function untouched() {
  tell('scenes of the page with each stepper');
  const rows = askPage('untouched');
  const kinds = ({ told }) => told.map(({ kind }) => kind).join(', ') || '-';
  const alarmed = rows.filter(({ told }) => told.some(({ is_nonsense }) => is_nonsense));
  const columns = {
    scene: 'scene',
    stepper: 'stepper',
    level: 'level',
    counts: ({ substeps, iterations }) => `${substeps} x ${iterations}`,
    's seen': 'seconds',
    'ms/step': 'step_ms',
    'largest stretch %': ({ largest_stretch }) => 100 * largest_stretch,
    told: kinds,
  };
  return {
    rows,
    goals: [atMost('untouched_alarms', alarmed.length, 0, rows)],
    text: `${rows.length} runs as they start, 2 s each, or 6 s of computing\n\n${table(rows, columns)}`,
  };
}
