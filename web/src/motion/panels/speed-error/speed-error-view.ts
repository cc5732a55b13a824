// The sweep's chart with its table beside it; a chosen point is run to the time that its error is of.
import './speed-error.css';
import { button, element, setText } from '../../../shared/panels/element';
import { noteLine } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { STEPPERS } from '../../../shared/steppers/steppers';
import type { BenchRow } from '../../bindings/sweep-module';
import type { MotionRun } from '../../run/motion-run';
import type { MotionState } from '../../state/motion-state';
import { PRESETS } from '../../state/setting';
import { durationS, hasFinished } from '../../state/sweep-plan';
import { rowOfSetting, type SweepState, settingIn } from '../../state/sweep-state';
import { legendItem, markOf } from '../chart/stepper-mark';
import { errorSentence, headline, methodSentence } from './mesh-words';
import { CROSS, createSpeedErrorPlot, isNonsense, type PlotContent } from './speed-error-plot';
import { createSpeedErrorTable } from './speed-error-table';

const NONSENSE = 'crossed out: not how cloth moves';

/**
 * Words on the front: rows of different references have one each. What is crossed out is on none, and neither is what
 * is below what its reference tells, which may be nearer.
 */
export function frontWords({ rows, meshError }: Pick<PlotContent, 'rows' | 'meshError'>): string {
  const isOfLevel = meshError !== 'known' && new Set(rows.map(({ level }) => level)).size > 1;
  const others = `no other${isOfLevel ? ' mark of its level' : ' mark'} is both faster and nearer`;
  const isUntold = (row: BenchRow) => hasFinished(row) && row.position_error_m === null;
  const leftOut = [
    ...(rows.some(isNonsense) ? ['those crossed out'] : []),
    ...(rows.some(isUntold) ? ['empty ones'] : []),
  ];
  return `front: ${others}${leftOut.length > 0 ? `; ${leftOut.join(' and ')} do not count` : ''}`;
}

/** The marks of the steppers that have a row, and what else is drawn. */
function createLegend() {
  const list = element('ul', { class: 'marks' });
  const items = STEPPERS.map(({ name, title }) => {
    const { path, style } = markOf(name);
    return legendItem({ 'point-mark': path }, title, style);
  });
  const nonsense = legendItem({ 'point-cross': CROSS }, NONSENSE);
  const front = legendItem({ front: 'M-8 0H8' }, '');
  const frontTitle = element('span');
  front.append(frontTitle);
  list.append(...items, nonsense, front);
  return {
    list,
    update(content: PlotContent) {
      const { rows } = content;
      nonsense.hidden = !rows.some(isNonsense);
      front.hidden = content.front.length === 0;
      setText(frontTitle, frontWords(content));
      STEPPERS.forEach(({ name }, index) => {
        const item = items[index];
        if (item) item.hidden = !rows.some((row) => row.method.stepper === name);
      });
    },
  };
}

/** Words on how far a sweep is: its share of the time, and until that is known what it has measured. */
export function soFarWords({
  phase,
  progress,
  rows,
}: Pick<SweepState, 'phase' | 'progress' | 'rows'>): string {
  if (phase !== 'running') return '';
  if (progress !== null) return `So far: ${Math.floor(100 * progress)} % of the time it takes.`;
  return `Settings measured so far: ${rows.length}.`;
}

/** Caption: what was measured, how far that is, and whose errors no mesh mends. */
function besideHeadline(sweep: SweepState): string {
  const { scene, rows, meshError } = sweep;
  const cloth = scene ? `${scene.mesh?.name ?? PRESETS[scene.preset].title}, ${scene.fabric}.` : '';
  const parts = [cloth, soFarWords(sweep), methodSentence(rows, meshError)];
  return parts.filter((part) => part !== '').join(' ');
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
    `Reference${isConverged ? '' : ' (not converged)'}: ${last.reference.description.replace(/[.]$/, '')}.`,
  ];
  if (disturbed) parts.push('The cloth was playing meanwhile: the times are too long.');
  return parts.filter((part) => part !== '').join(' ');
}

export function createSpeedErrorView(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: Pick<MotionRun, 'showAnew'>,
): void {
  function use(index: number): void {
    const { sweep, setting } = store.get();
    const row = sweep.rows[index];
    if (!row || !sweep.scene) return;
    const { mesh } = sweep.scene;
    const measured = settingIn(sweep.scene, row, setting);
    const startSteps = Math.round(durationS(measured) / measured.stepS);
    const content = { setting: measured, startSteps, invited: false };
    actions.showAnew(mesh ? { ...content, mesh } : content);
    parent.parentElement?.querySelector('.stage')?.scrollIntoView({ block: 'nearest' });
  }

  const heading = element('h2');
  const beside = noteLine();
  const close = button('Close', () => store.set({ sweepOpen: false }));
  const figure = element('figure', { class: 'chart' });
  const plot = createSpeedErrorPlot(figure, use);
  const note = noteLine();
  const legend = createLegend();
  figure.append(legend.list);
  const table = createSpeedErrorTable(use);
  parent.append(
    element('div', { class: 'tray-head' }, heading, close),
    beside,
    element('div', { class: 'tray-body' }, figure, table.box),
    note,
  );
  let drawn = '';
  watch(store, ['sweep', 'sweepOpen', 'setting'], (state) => {
    parent.hidden = !state.sweepOpen;
    if (!state.sweepOpen) return;
    const { sweep } = state;
    setText(heading, headline(sweep.rows, sweep.meshError) || 'Measuring the first setting.');
    setText(beside, besideHeadline(sweep));
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
    legend.update(content);
    plot.update(content);
    table.update(content);
  });
}
