// The view of failures shows failures: each naive side its sign within two seconds, the other side none, and both keep
// pace with the picture.
import { tell } from './bench-options.mjs';
import { atLeast, atMost, largest, table } from './bench-rows.mjs';
import { askPage } from './command.mjs';

const kCases = 10;
const kSeconds = 2;
const kBothMs = 6; // a picture has 16.7, of which drawing takes most of the rest

export async function failures({ scale }) {
  tell('the cases of the view of failures');
  const rows = askPage('failure-rows');
  const shown = rows.filter(({ sign_s }) => sign_s !== null && sign_s <= kSeconds);
  const warned = rows.filter(({ ours }) => ours.length > 0);
  const bothMs = ({ naive_ms, ours_ms }) => naive_ms + ours_ms;
  const columns = {
    case: 'case',
    vertices: 'n_vertices',
    sign: 'sign',
    s: 'sign_s',
    ours: ({ ours }) => ours.join(', ') || '-',
    'naive ms': 'naive_ms',
    'ours ms': 'ours_ms',
  };
  return {
    rows,
    goals: [
      atLeast('failures_shown', shown.length, kCases, rows),
      atMost('failures_remedies_warned', warned.length, 0, rows),
      atMost('failures_step_ms', largest(rows.map(bothMs)), kBothMs * scale, rows),
    ],
    text: `ten failures and what holds\n\n${table(rows, columns)}`,
  };
}
