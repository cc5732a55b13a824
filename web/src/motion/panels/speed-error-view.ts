// The sweep's chart with its table beside it; a chosen point is run to the time that its error is of.
import { element, setText, svg } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { STEPPERS } from '../../shared/steppers/steppers';
import type { BenchRow } from '../bindings/sweep-module';
import type { MotionRun } from '../run/motion-run';
import type { MotionState } from '../state/motion-state';
import { PRESETS } from '../state/setting';
import { durationS, hasFinished, settingOfRow } from '../state/sweep-plan';
import { rowOfSetting } from '../state/sweep-state';
import { errorSentence, refinementSentence } from './mesh-words';
import { createSpeedErrorPlot, markOf } from './speed-error-plot';
import { createSpeedErrorTable } from './speed-error-table';

/** The marks of the steppers that have a row. */
function createLegend() {
  const list = element('ul', { class: 'marks' });
  const items = STEPPERS.map(({ name, title }) => {
    const { path, style } = markOf(name);
    const picture = svg('svg', { viewBox: '-7 -7 14 14', 'aria-hidden': 'true' });
    picture.append(svg('path', { class: 'point-mark', d: path }));
    return element('li', { style }, picture, title);
  });
  list.append(...items);
  return {
    list,
    update(rows: BenchRow[]) {
      STEPPERS.forEach(({ name }, index) => {
        const item = items[index];
        if (item) item.hidden = !rows.some((row) => row.method.stepper === name);
      });
    },
  };
}

/** Says what the numbers are, and how far to trust them. */
function footnote({ sweep }: MotionState): string {
  const { rows, disturbed, meshError } = sweep;
  const last = rows.at(-1);
  if (!last || !sweep.scene) return 'Waiting for the first row.';
  const nRuns = Math.min(...rows.filter(hasFinished).map((row) => row.n_runs));
  const runs = Number.isFinite(nRuns) && nRuns > 0 ? `${nRuns} runs, ` : '';
  const isTold = (row: BenchRow) => row.position_error_m !== null;
  const isConverged = rows.filter(isTold).every((row) => row.reference.converged);
  const parts = [
    `Measured on this device, ${runs}median.`,
    errorSentence(meshError, durationS(sweep.scene)),
    rows.some((row) => hasFinished(row) && !isTold(row))
      ? 'An empty mark is below what its reference tells.'
      : '',
    ...(meshError === 'known' ? [refinementSentence(rows)] : []),
    `Reference${isConverged ? '' : ' (not converged)'}: ${last.reference.description.replace(/[.]$/, '')}.`,
  ];
  if (disturbed) parts.push('The cloth was playing meanwhile: the times are too long.');
  return parts.filter((part) => part !== '').join(' ');
}

export function createSpeedErrorView(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: Pick<MotionRun, 'showAnew'>,
): () => void {
  function use(index: number): void {
    const { sweep, setting } = store.get();
    const row = sweep.rows[index];
    if (!row || !sweep.scene) return;
    const { mesh, ...swept } = sweep.scene;
    const measured = settingOfRow(row, { ...setting, ...swept });
    const startSteps = Math.round(durationS(measured) / measured.stepS);
    const content = { setting: measured, startSteps, invited: false };
    actions.showAnew(mesh ? { ...content, mesh } : content);
  }

  const heading = element('h2', {}, 'Speed and error');
  const close = element(
    'button',
    { type: 'button', click: () => store.set({ sweepOpen: false }) },
    'Close',
  );
  const figure = element('figure', { class: 'chart' });
  const plot = createSpeedErrorPlot(figure, use);
  const note = element('figcaption');
  const legend = createLegend();
  figure.append(legend.list, note);
  const tableBox = element('div', {
    class: 'table-box',
    tabindex: 0,
    role: 'region',
    'aria-label': 'Rows of the sweep',
  });
  const table = createSpeedErrorTable(tableBox, use);
  parent.append(
    element('div', { class: 'tray-head' }, heading, close),
    element('div', { class: 'tray-body' }, figure, tableBox),
  );
  let drawn = '';
  return watch(store, ['sweep', 'sweepOpen', 'setting'], (state) => {
    parent.hidden = !state.sweepOpen;
    if (!state.sweepOpen) return;
    const { sweep } = state;
    const { scene: swept } = sweep;
    const scene = swept
      ? `: ${swept.mesh?.name ?? PRESETS[swept.preset].title}, ${swept.fabric}`
      : '';
    setText(heading, `Speed and error${scene}`);
    const row = rowOfSetting(state);
    const content = {
      rows: sweep.rows,
      front: sweep.front,
      meshError: sweep.meshError,
      current: row ? sweep.rows.indexOf(row) : -1,
    };
    setText(note, footnote(state));
    // Progress without a new row must not replace a point that is just being clicked.
    const text = JSON.stringify(content);
    if (text === drawn) return;
    drawn = text;
    legend.update(sweep.rows);
    plot.update(content);
    table.update(content);
  });
}
