// The frames of a completed motion as a table, beside their curves.

import { createNumberTable, fillHead } from '../../shared/panels/number-table';
import { percent } from '../../shared/panels/quantity';
import { folded, noteLine } from '../../shared/panels/section';
import { numberCell, rowOf } from '../../shared/panels/table-parts';
import type { FilledFrame } from '../bindings/modal-module';

const HEADS = ['Key', 'Volume', 'straight', 'Strain', 'straight'];

function tableRow(frame: FilledFrame, rest_m3: number): HTMLElement {
  const { time, volume_m3, straight_volume_m3, strain, straight_strain } = frame;
  const ratios = [volume_m3 / rest_m3, straight_volume_m3 / rest_m3, strain, straight_strain];
  return rowOf(
    String(Number((time + 1).toFixed(3))),
    ...ratios.map((ratio) => numberCell(percent(ratio, 3))),
  );
}

/** Rows are made once it is opened. */
export function createCompletionTable() {
  const table = createNumberTable('Frames', 'Volume and strain of each frame');
  fillHead(table, HEADS);
  let frames: readonly FilledFrame[] = [];
  const fill = () => {
    const rest = frames[0]?.volume_m3 ?? 1;
    if (box.open) table.rows.replaceChildren(...frames.map((frame) => tableRow(frame, rest)));
  };
  const box = folded(
    'The same as a table',
    { toggle: fill },
    noteLine(
      'Volumes over that of the first key. Strain: how far each piece is from a turned copy of itself, as a root of the mean square; the energy goes with its square.',
    ),
    table.box,
  );
  return {
    box,
    show(newFrames: readonly FilledFrame[]) {
      frames = newFrames;
      fill();
    },
  };
}
