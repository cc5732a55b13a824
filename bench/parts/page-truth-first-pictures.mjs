// The picture that the view of refinement opens on: whether finer is better there, and cloth is cloth.
import { atMost, largest, table } from './bench-rows.mjs';
import { askPage } from './command.mjs';

const kMostOfCoarse = 0.5;

export async function firstPictures() {
  const rows = askPage('first-pictures');
  const [coarse, planned] = rows;
  const columns = {
    mesh: 'mesh',
    vertices: 'n_vertices',
    'off the fine cloth mm': ({ off_m }) => 1e3 * off_m,
    'lost by its faces mm': ({ lost_m }) => 1e3 * lost_m,
    'edges through itself': 'n_crossings',
  };
  const crossings = largest(rows.map(({ n_crossings }) => n_crossings));
  return {
    rows,
    goals: [
      atMost('shape_lost_multi_over_coarse', planned.lost_m / coarse.lost_m, kMostOfCoarse, rows),
      atMost('off_fine_multi_over_coarse', planned.off_m / coarse.off_m, kMostOfCoarse, rows),
      atMost('first_picture_crossings', crossings, 0, rows),
    ],
    text: `the first picture of refinement\n\n${table(rows, columns)}`,
  };
}
