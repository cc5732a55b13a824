// Three measurements of a visitor's own fabric, and what the measured ones make of them.

import { fabricNamed, fabrics } from '../../shared/fabric/fabric-data';
import { button, element, field, setText } from '../../shared/panels/element';
import { digits, percent } from '../../shared/panels/quantity';
import { addSection, folded, noteLine } from '../../shared/panels/section';
import { heading, numberCell, rowOf, tableOf } from '../../shared/panels/table-parts';
import { type Store, watch } from '../../shared/state/store';
import type { FitAnswer, TermNumbers } from '../bindings/deform-module';
import { type DeformState, TERMS, type Term } from '../state/deform-state';
import { LARGEST_RATIO } from '../state/fabric-choice';
import { errorOfMean, geometryOf, measuredRange } from '../state/fabric-geometry';
import { TERM_MEASUREMENTS, TERM_TITLES } from './term-words';
import { createWeightBar, termKey } from './weight-bar';

export interface OwnFabricActions {
  /** Fits weights to these; asked for with every change. */
  measure(measures: TermNumbers): void;
  /** Shows the own fabric in the chosen pane. */
  show(measures: TermNumbers): void;
  /** Closes the pane that shows it. */
  hide(): void;
}

/** A ratio with as many digits as the measured ones have. */
function ratio(value: number): string {
  return value.toFixed(4);
}

/** The number, or one sentence about what is wrong with the text. */
export function readMeasure(term: Term, text: string): number | string {
  const title = TERM_TITLES[term];
  if (text.trim() === '') return `${title}: a number is missing.`;
  const value = Number(text.replace(',', '.'));
  if (!Number.isFinite(value)) return `${title}: "${text.slice(0, 20)}" is not a number.`;
  if (value <= 0) return `${title}: a ratio is above 0.`;
  if (value > LARGEST_RATIO) {
    return `${title}: a ratio above ${LARGEST_RATIO} is no ratio of two lengths or areas of one sample.`;
  }
  return value;
}

/** "Your stretch of 1.3000 is outside …"; one sentence for each that was clamped. */
export function clampedWords(
  { clamped, measured_range: ranges }: FitAnswer,
  measures: TermNumbers,
): string[] {
  return clamped.map((term) => {
    const [low, high] = ranges[term];
    const end = measures[term] < low ? low : high;
    return `Your ${TERM_TITLES[term].toLowerCase()} of ${digits(measures[term], 4)} lies outside what was measured (${ratio(low)} to ${ratio(high)}) and counts as ${ratio(end)}.`;
  });
}

/** Errors this close are the same: the mean is the curve. */
const SAME_ERROR = 1e-3;

/** How far each weight is to be trusted. */
export function trustWords({
  leave_one_out_error,
}: Pick<FitAnswer, 'leave_one_out_error'>): string[] {
  return TERMS.map((term) => {
    const title = TERM_TITLES[term];
    const error = digits(leave_one_out_error[term], 2);
    const ofMean = errorOfMean(term);
    if (leave_one_out_error[term] > ofMean - SAME_ERROR) {
      return `${title}: by ${error}, no better than the mean of all, so what you measure does not change it.`;
    }
    return `${title}: by ${error}; the mean of all misses it by ${digits(ofMean, 2)}.`;
  });
}

function measureField(term: Term, onInput: () => void) {
  const [low, high] = measuredRange(term);
  const error = element('p', { class: 'field-error', id: `own-${term}-error`, hidden: true });
  const hint = element(
    'p',
    { class: 'note', id: `own-${term}-hint` },
    `${TERM_MEASUREMENTS[term]} Measured: ${ratio(low)} to ${ratio(high)}.`,
  );
  const input = element('input', {
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    class: 'ratio',
    'aria-describedby': `${error.id} ${hint.id}`,
    input: onInput,
  });
  return {
    term,
    input,
    box: field(TERM_TITLES[term], input, error, hint),
    tell(sentence: string) {
      error.hidden = sentence === '';
      input.setAttribute('aria-invalid', String(sentence !== ''));
      setText(error, sentence);
    },
  };
}

/** Weights that the measured fabrics suggest for the measures, and how far they are to be trusted. */
function createResult(showIt: () => void) {
  const { bar, show: showWeights } = createWeightBar();
  const summary = element('p', { role: 'status' });
  const clamped = element('p', { class: 'field-error' });
  const trust = element('ul', { class: 'plain-list note' });
  const rows = element('tbody');
  const heads = heading('Term', 'Normalised', 'Weight');
  const table = tableOf('quantities', 'Weights of your fabric', heads, rows);
  const note = `A guess from ${fabrics.length} fabrics, whose measurements hardly tell their weights. Leaving each measured fabric out in turn, the curve through the others misses its normalised value (0 to 1):`;
  const trustBox = folded('How far to trust it', {}, noteLine(note), trust);
  const showing = button('Show it', showIt, { class: 'wide' });
  const parts = [summary, bar, table, clamped, trustBox, showing];
  const box = element('div', { class: 'own-result' }, ...parts);

  function row(term: Term, own: FitAnswer): HTMLElement {
    return rowOf(
      [termKey(term), TERM_TITLES[term]],
      numberCell(digits(own.normalised[term], 2)),
      numberCell(percent(own.weights[term])),
    );
  }

  return {
    box,
    show(own: FitAnswer | null, measures: TermNumbers | null): void {
      box.hidden = !own || !measures;
      if (!own || !measures) return;
      showWeights(own.weights);
      setText(summary, `Nearest measured fabric: ${own.nearest}.`);
      rows.replaceChildren(...TERMS.map((term) => row(term, own)));
      setText(clamped, clampedWords(own, measures).join(' '));
      clamped.hidden = own.clamped.length === 0;
      trust.replaceChildren(...trustWords(own).map((words) => element('li', {}, words)));
    },
  };
}

type MeasureField = ReturnType<typeof measureField>;

/** The three measures, or null while one of them is none. */
function readMeasures(fields: readonly MeasureField[]): TermNumbers | null {
  const values = fields.map(({ term, input }) => readMeasure(term, input.value));
  const [recovery, stretch, bending] = values;
  const areNumbers =
    typeof recovery === 'number' && typeof stretch === 'number' && typeof bending === 'number';
  return areNumbers ? { recovery, stretch, bending } : null;
}

/** Says at each field what is wrong with it. */
function tellProblems(fields: readonly MeasureField[], { problem }: DeformState): void {
  for (const { term, input, tell } of fields) {
    const value = readMeasure(term, input.value);
    const isRefused = problem?.where.endsWith(`/${term}`) === true;
    const refusal = isRefused ? `${TERM_TITLES[term]}: ${problem.what}.` : '';
    tell(typeof value === 'string' ? value : refusal);
  }
}

/** The own fabric's measures, or for a start those of the chosen one. */
function firstMeasures({ panes, chosen }: DeformState): { measures: TermNumbers; isOwn: boolean } {
  const own = panes.find(({ fabric }) => fabric.kind === 'own')?.fabric;
  if (own?.kind === 'own') return { measures: own.measures, isOwn: true };
  const { fabric } = panes[chosen] ?? {};
  const name = fabric?.kind === 'named' ? fabric.name : '';
  return { measures: geometryOf(fabricNamed(name)).measures, isOwn: false };
}

export function createOwnFabricForm(
  parent: HTMLElement,
  store: Store<DeformState>,
  actions: OwnFabricActions,
): void {
  let measures: TermNumbers | null = null;

  function changed(): void {
    measures = readMeasures(fields);
    if (measures) actions.measure(measures);
    render();
  }

  const fields = TERMS.map((term) => measureField(term, changed));
  const result = createResult(() => measures && actions.show(measures));
  const hideIt = button('Take it away', actions.hide, { class: 'wide' });
  const box = folded(
    'Your own fabric',
    {
      toggle() {
        if (box.open && !measures) changed();
      },
    },
    noteLine('Three ratios, measured on a sample of 46 × 40 cm.'),
    ...fields.map((one) => one.box),
    result.box,
    hideIt,
  );
  addSection(parent, 'Your own fabric', box);

  function render(): void {
    const state = store.get();
    const { panes, gallery } = state;
    const isBesideOthers = panes.length > 1 && panes.some(({ fabric }) => fabric.kind === 'own');
    hideIt.hidden = gallery || !isBesideOthers;
    tellProblems(fields, state);
    result.show(state.ownFabric, measures);
  }

  const first = firstMeasures(store.get());
  for (const { term, input } of fields) input.value = String(first.measures[term]);
  box.open = first.isOwn;
  let listed = '';
  watch(store, ['ownFabric', 'problem', 'panes', 'gallery'], (state) => {
    const { panes, gallery, problem, ownFabric: own } = state;
    // The numbers of a pane change with every frame, the form does not.
    const text = JSON.stringify([panes.map(({ fabric }) => fabric.kind), gallery, problem, own]);
    if (text === listed) return;
    listed = text;
    render();
  });
}
