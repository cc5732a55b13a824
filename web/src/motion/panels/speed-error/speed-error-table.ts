// The chart's data as a table; every row can be applied, failed rows say why they failed.

import { button, element } from '../../../shared/panels/element';
import { createNumberTable } from '../../../shared/panels/number-table';
import {
  digits,
  milliseconds,
  percent,
  shortTime,
  smallLength,
} from '../../../shared/panels/quantity';
import { warningSentence } from '../../../shared/panels/warning-words';
import type { BenchRow } from '../../bindings/sweep-module';
import { hasFinished } from '../../state/sweep-plan';
import type { MeshError } from '../../state/sweep-state';
import { boundOf } from './mesh-floors';
import { errorName, meshText } from './mesh-words';
import { type PlotContent, titleOf } from './speed-error-plot';

/** The two lines of a cell. */
type Cell = [string, string];

/** Least time that milliseconds have too many digits for [ms]. */
const LONG_MS = 10000;

/** Wall time of a frame; seconds and minutes where it is long. */
function frameTime(ms: number | null): string {
  return ms !== null && ms >= LONG_MS ? shortTime(ms) : milliseconds(ms);
}

/** Each column's title, and what its second line is. */
function heads(meshError: MeshError): Cell[] {
  const shares: Cell[] = meshError === 'known' ? [['Method', 'mesh']] : [];
  return [
    ['Setting', ''],
    ['A frame', 'spread'],
    [errorName(meshError), 'of diagonal'],
    ...shares,
    ['RMS stretch', 'largest'],
  ];
}

/** An error, or the bound below which the reference tells none. */
function errorCell(row: BenchRow): Cell {
  const { position_error_m, position_error_percent } = row;
  if (position_error_m !== null)
    return [smallLength(position_error_m), `${digits(position_error_percent, 2)} %`];
  const bound = boundOf(row);
  return bound === null ? ['–', 'no reference'] : [`< ${smallLength(bound)}`, 'not told'];
}

/** Both lines of each column after the first. */
function cells(row: BenchRow, meshError: MeshError): Cell[] {
  const shares: Cell[] =
    meshError === 'known' ? [[smallLength(row.method_error_m), meshText(row, meshError)]] : [];
  return [
    [frameTime(row.ms_per_frame), frameTime(row.spread_ms)],
    errorCell(row),
    ...shares,
    [percent(row.rms_stretch), percent(row.largest_stretch)],
  ];
}

export function createSpeedErrorTable(onChoice: (index: number) => void): {
  box: HTMLElement;
  update(content: PlotContent): void;
} {
  const { box, head, rows } = createNumberTable(
    'Rows of the sweep',
    'Speed and error of each setting',
  );

  function line(row: BenchRow, index: number, { front, current, meshError }: PlotContent) {
    const title = titleOf(row);
    const use = button(title, () => onChoice(index), {
      title: 'Show this setting',
      'data-row': index,
    });
    const heading = element('th', { scope: 'row' }, use);
    if (row.n_vertices > 0) heading.append(element('small', {}, `${row.n_vertices} vertices`));
    if (row.status === 'not_converged') heading.append(' (solve cut short)');
    for (const warning of row.warnings?.slice(0, 1) ?? [])
      heading.append(element('small', {}, warningSentence(warning)));
    if (front.includes(index)) heading.append(' ', element('span', { class: 'badge' }, 'front'));
    const data = hasFinished(row)
      ? cells(row, meshError).map(([value, detail]) =>
          element('td', { class: 'number' }, value, element('small', {}, detail)),
        )
      : [
          element(
            'td',
            { colspan: head.children.length - 1, class: 'failed' },
            `${row.status}: ${row.message}`,
          ),
        ];
    const kind = index === current ? 'current' : '';
    return element('tr', { class: kind }, heading, ...data);
  }

  return {
    box,
    update(content) {
      const focused = rows.contains(document.activeElement)
        ? document.activeElement?.getAttribute('data-row')
        : null;
      head.replaceChildren(
        ...heads(content.meshError).map(([title, detail]) =>
          element('th', { scope: 'col' }, title, ' ', element('small', {}, detail)),
        ),
      );
      rows.replaceChildren(...content.rows.map((row, index) => line(row, index, content)));
      if (focused) rows.querySelector<HTMLElement>(`[data-row="${focused}"]`)?.focus();
    },
  };
}
