// The account of energy as a plot, in words, and as a table.

import type { EnergyNumbers } from '../../../shared/bindings/pleat-module';
import { element, setText } from '../../../shared/panels/element';
import { lineKey } from '../../../shared/panels/line-key';
import { createNumberTable, fillHead, type NumberTable } from '../../../shared/panels/number-table';
import { energyText, energyUnit } from '../../../shared/panels/quantity';
import { folded, noteLine } from '../../../shared/panels/section';
import { numberCell, rowOf } from '../../../shared/panels/table-parts';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';
import { createTimePlot, type TimeChart } from '../chart/time-plot';
import { type EnergyLine, linesOf } from './energy-lines';
import { energyWords } from './energy-words';

/** So many times of a run are in the table. */
const TABLE_ROWS = 9;

/** Samples evenly spread over all of them, with the first and the last. */
export function spread(samples: readonly EnergyNumbers[]): EnergyNumbers[] {
  const n = Math.min(TABLE_ROWS, samples.length);
  return Array.from({ length: n }, (_, row) =>
    samples.at(Math.round((row * (samples.length - 1)) / Math.max(1, n - 1))),
  ).filter((sample) => sample !== undefined);
}

function fillTable(
  table: NumberTable,
  samples: readonly EnergyNumbers[],
  lines: readonly EnergyLine[],
): void {
  fillHead(table, ['Time', ...lines.map(({ title }) => title)]);
  const row = (sample: EnergyNumbers) =>
    rowOf(
      `${sample.time_s.toFixed(2)}\u00a0s`,
      ...lines.map((line) => numberCell(energyText(line.joules(sample)))),
    );
  table.rows.replaceChildren(...spread(samples).map(row));
}

/** Look of a line, in the chart and in its legend. */
function lineClass(kind: EnergyLine['kind']): string {
  return `time-line energy-${kind}`;
}

function energyChart(samples: readonly EnergyNumbers[], lines: readonly EnergyLine[]): TimeChart {
  const heights = lines.map(({ joules }) => samples.map(joules));
  const { unit, perJoule } = energyUnit(Math.max(0, ...heights.flat().map(Math.abs)));
  return {
    timeTitle: 'time [s]',
    valueTitle: `energy [${unit}]`,
    times: samples.map(({ time_s }) => time_s),
    lines: lines.map(({ kind }, index) => ({
      class: lineClass(kind),
      values: (heights[index] ?? []).map((joules) => perJoule * joules),
    })),
  };
}

export function createEnergyChart(parent: HTMLElement, store: Store<MotionState>): void {
  const plot = createTimePlot('energy-over-time');
  const legend = element('ul', { class: 'marks line-keys' });
  const words = element('figcaption');
  const table = createNumberTable('Energies over time', 'Energies over time', 'energy-rows');
  const asTable = folded('The same as a table', { toggle: () => render(store.get()) }, table.box);
  const figure = element('figure', { class: 'chart' }, legend);
  figure.append(plot.root, words);
  parent.append(
    figure,
    asTable,
    noteLine(
      'Height and losses count from where the account begins, so that all lines add up to the same at any time. Keeping the account takes time while this is open.',
    ),
  );

  function render({ energies }: MotionState): void {
    const isDrawn = energies.length > 1;
    plot.root.toggleAttribute('hidden', !isDrawn);
    legend.hidden = !isDrawn;
    asTable.hidden = !isDrawn;
    setText(words, energyWords(energies));
    if (!isDrawn) return;
    const lines = linesOf(energies);
    legend.replaceChildren(...lines.map(({ kind, title }) => lineKey(lineClass(kind), title)));
    plot.draw(energyChart(energies, lines));
    if (asTable.open) fillTable(table, energies, lines);
  }
  // Energies change with each frame, and are drawn as often as numbers can be read.
  watch(store, ['energy', 'numbers'], render);
}
