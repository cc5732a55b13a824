// How long a visitor waits for the page's default sweep, in headless Chromium.
import { tell } from './bench-parts.mjs';
import { goal, markdown, short } from './bench-rows.mjs';
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
  const head = ['scene', 'rows', 'errors known', 'first rows s', 'all s', 'status'];
  const lines = rows.map((row) => [
    row.scene,
    row.rows,
    row.known,
    short(row.first_rows_ms / 1000),
    short(row.all_ms / 1000),
    row.status,
  ]);
  const longest = (key) => Math.max(...rows.map((row) => row[key]));
  const goals = [
    goal('truth.page_sweep_ms', longest('all_ms'), 'at-most', kAllMs * scale, rows),
    goal(
      'truth.page_first_rows_ms',
      longest('first_rows_ms'),
      'at-most',
      kFirstRowsMs * scale,
      rows,
    ),
  ];
  return { rows, goals, text: `the page's default sweeps\n\n${markdown(head, lines)}` };
}
