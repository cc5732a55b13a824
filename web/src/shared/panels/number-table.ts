// A table of numbers beside a chart, in a box that scrolls.
import { element } from './element';
import { tableOf } from './table-parts';

export interface NumberTable {
  box: HTMLElement;
  head: HTMLTableRowElement;
  rows: HTMLTableSectionElement;
}

/** `label` names the box, `caption` the table; `kind` is one more class of it. */
export function createNumberTable(label: string, caption: string, kind = ''): NumberTable {
  const head = element('tr');
  const rows = element('tbody');
  const table = tableOf(`rows ${kind}`.trim(), caption, element('thead', {}, head), rows);
  const named = { role: 'region', 'aria-label': label };
  return { box: element('div', { class: 'table-box', tabindex: 0, ...named }, table), head, rows };
}

/** The heads of its columns, each in one line. */
export function fillHead({ head }: NumberTable, titles: readonly string[]): void {
  head.replaceChildren(...titles.map((title) => element('th', { scope: 'col' }, title)));
}
