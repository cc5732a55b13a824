// The chart's data as a table; every row can be applied, failed rows say why they failed.
import { element } from '../../shared/panels/element';
import { digits, milliseconds, percent, smallLength } from '../../shared/panels/quantity';
import type { BenchRow } from '../bindings/sweep-module';
import { hasFinished } from '../state/sweep-plan';
import { type PlotContent, titleOf } from './speed-error-plot';

/** Each column's title, and what its second line is. */
const HEADS: readonly [string, string][] = [
  ['Setting', ''],
  ['A frame', 'spread'],
  ['Error', 'of diagonal'],
  ['RMS stretch', 'largest'],
];

/** Both lines of each column after the first. */
function cells(row: BenchRow): [string, string][] {
  return [
    [milliseconds(row.ms_per_frame), milliseconds(row.spread_ms)],
    [smallLength(row.position_error_m), `${digits(row.position_error_percent, 2)} %`],
    [percent(row.rms_stretch), percent(row.largest_stretch)],
  ];
}

export function createSpeedErrorTable(
  parent: HTMLElement,
  onChoice: (index: number) => void,
): { update(content: PlotContent): void } {
  const body = element('tbody');
  parent.append(
    element(
      'table',
      { class: 'rows' },
      element('caption', { class: 'unseen' }, 'Speed and error of each setting'),
      element(
        'thead',
        {},
        element(
          'tr',
          {},
          ...HEADS.map(([title, detail]) =>
            element('th', { scope: 'col' }, title, ' ', element('small', {}, detail)),
          ),
        ),
      ),
      body,
    ),
  );

  function line(row: BenchRow, index: number, isFront: boolean, isCurrent: boolean): HTMLElement {
    const title = titleOf(row);
    const use = element(
      'button',
      {
        type: 'button',
        title: 'Show this setting',
        'data-row': index,
        click: () => onChoice(index),
      },
      title,
    );
    const heading = element('th', { scope: 'row' }, use);
    if (row.n_vertices > 0) heading.append(element('small', {}, `${row.n_vertices} vertices`));
    if (row.status === 'not_converged') heading.append(' (solve cut short)');
    if (isFront) heading.append(' ', element('span', { class: 'badge' }, 'front'));
    const data = hasFinished(row)
      ? cells(row).map(([value, detail]) =>
          element('td', { class: 'number' }, value, element('small', {}, detail)),
        )
      : [element('td', { colspan: 3, class: 'failed' }, `${row.status}: ${row.message}`)];
    const kind = isCurrent ? 'current' : '';
    return element('tr', { class: kind }, heading, ...data);
  }

  return {
    update({ rows, front, current }) {
      const focused = body.contains(document.activeElement)
        ? document.activeElement?.getAttribute('data-row')
        : null;
      body.replaceChildren(
        ...rows.map((row, index) => line(row, index, front.includes(index), index === current)),
      );
      if (focused) body.querySelector<HTMLElement>(`[data-row="${focused}"]`)?.focus();
    },
  };
}
