// How long a visitor waits for the page's default sweep, in headless Chromium.
import { tell } from './bench-options.mjs';
import { atMost, table } from './bench-rows.mjs';
import { askPage } from './command.mjs';

const kAllMs = 20000;
const kFirstRowsMs = 5000;

export async function page({ scale }) {
  tell('the page is built');
  askPage('build');
  tell("the page's sweeps");
  const rows = askPage('sweep-times').map((row) => ({
    ...row,
    status: row.phase === 'done' ? 'ok' : row.phase,
  }));
  const columns = {
    scene: 'scene',
    rows: 'rows',
    'errors known': 'known',
    'first rows s': (row) => row.first_rows_ms / 1000,
    'all s': (row) => row.all_ms / 1000,
    status: 'status',
  };
  const longest = (key) => Math.max(...rows.map((row) => row[key]));
  const goals = [
    atMost('page_sweep_ms', longest('all_ms'), kAllMs * scale, rows),
    atMost('page_first_rows_ms', longest('first_rows_ms'), kFirstRowsMs * scale, rows),
  ];
  return { rows, goals, text: `the page's default sweeps\n\n${table(rows, columns)}` };
}
