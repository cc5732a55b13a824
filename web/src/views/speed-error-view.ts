// The sweep's chart with its table beside it; a chosen point becomes the shown setting.
import { createSpeedErrorPlot, markOf } from '../plot/speed-error-plot';
import { createSpeedErrorTable } from '../plot/speed-error-table';
import type { AppState } from '../state/app-state';
import { PRESET_IDS, PRESETS, STEPPER_TRAITS, STEPPERS } from '../state/setting';
import { type Store, watch } from '../state/store';
import { hasFinished, rowOfSetting, settingOfRow } from '../state/sweep-plan';
import { element, setText } from './element';

function legend(): HTMLElement {
  const list = element('ul', { class: 'marks' });
  for (const stepper of STEPPERS) {
    const item = element('li', { class: `point-${stepper}` });
    item.innerHTML = `<svg viewBox="-7 -7 14 14" aria-hidden="true"><path class="point-mark" d="${markOf(stepper)}"/></svg>`;
    item.append(STEPPER_TRAITS[stepper].title);
    list.append(item);
  }
  return list;
}

/** What the numbers are, and how far to trust them. */
function footnote({ sweep }: AppState): string {
  const { rows, disturbed } = sweep;
  const [first] = rows;
  if (!first) return 'Waiting for the first row.';
  const { converged, description } = first.reference;
  const nRuns = Math.min(...rows.filter(hasFinished).map((row) => row.n_runs));
  const runs = Number.isFinite(nRuns) && nRuns > 0 ? `${nRuns} runs, ` : '';
  const parts = [
    `Measured on this device, ${runs}median.`,
    `Reference${converged ? '' : ' (not converged)'}: ${description.replace(/[.]$/, '')}.`,
  ];
  if (disturbed) parts.push('The cloth was playing meanwhile: the times are too long.');
  return parts.join(' ');
}

export function createSpeedErrorView(parent: HTMLElement, store: Store<AppState>): () => void {
  function use(index: number): void {
    const { sweep, setting } = store.get();
    const row = sweep.rows[index];
    if (!row || !sweep.scene) return;
    const { fabric } = sweep.scene;
    const preset = PRESET_IDS.find((id) => id === sweep.scene?.preset) ?? setting.preset;
    store.set({ setting: settingOfRow(row, { ...setting, preset, fabric }) });
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
  figure.append(legend(), note);
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
    const preset = PRESET_IDS.find((id) => id === sweep.scene?.preset);
    const scene = preset ? `: ${PRESETS[preset].title}, ${sweep.scene?.fabric}` : '';
    setText(heading, `Speed and error${scene}`);
    const row = rowOfSetting(state);
    const content = {
      rows: sweep.rows,
      front: sweep.front,
      current: row ? sweep.rows.indexOf(row) : -1,
    };
    setText(note, footnote(state));
    // Progress without a new row must not replace a point that is just being clicked.
    const text = JSON.stringify(content);
    if (text === drawn) return;
    drawn = text;
    plot.update(content);
    table.update(content);
  });
}
