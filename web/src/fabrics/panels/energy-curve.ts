// The energy after each step towards the shape, in whole and term by term, drawn and as a table.

import { linearScale } from '../../shared/chart/linear-scale';
import { logScale } from '../../shared/chart/log-scale';
import { pathThrough } from '../../shared/chart/path-through';
import { element, setText, svg } from '../../shared/panels/element';
import { lineKey } from '../../shared/panels/line-key';
import { createNumberTable, fillHead } from '../../shared/panels/number-table';
import { createPlot, levelMarks, plotText, uprightTitle } from '../../shared/panels/plot-parts';
import { digits } from '../../shared/panels/quantity';
import { addSection, folded, noteLine } from '../../shared/panels/section';
import { numberCell, rowOf } from '../../shared/panels/table-parts';
import { type Store, watch } from '../../shared/state/store';
import { type DeformState, type PaneState, TERMS, type Term } from '../state/deform-state';
import { titleOf } from '../state/fabric-choice';
import { perTerm } from '../state/fabric-geometry';
import { TERM_TITLES } from './term-words';

const WIDTH = 360;
const HEIGHT = 220;
const LEFT = 58;
const RIGHT = 10;
const TOP = 10;
const BOTTOM = 40;

/** Energies below this part of the largest are not worth the room that they take on a scale. */
const LEAST_PART = 1e-4;

/** Energies whose largest is at least so many times the least are drawn on a logarithmic scale. */
const WIDE_RATIO = 30;

/** More steps than this have no number of their own on the axis. */
const MOST_LABELS = 8;

type Steps = PaneState['steps'];

/** Energy that each step left: the weighted terms add up to the energy. */
export function weightedSteps(
  { steps, weights }: Pick<PaneState, 'steps' | 'weights'>,
  counts: Record<Term, boolean>,
): Steps {
  return steps.map((step) => ({
    ...step,
    terms: perTerm((term) => (counts[term] ? weights[term] * step.terms[term] : 0)),
  }));
}

/** True where a linear axis would draw what matters as zero. */
export function isWide(energies: readonly number[]): boolean {
  const most = Math.max(...energies);
  const drawn = energies.filter((energy) => energy > LEAST_PART * most);
  return drawn.length > 0 && most / Math.min(...drawn) >= WIDE_RATIO;
}

/** "After 12 steps, 3 of them linearised anew, the energy is 1.2, of 3.4 after the first." */
export function curveWords(name: string, steps: Steps, pane: PaneState): string {
  const [first] = steps;
  const last = steps.at(-1);
  if (!first || !last) return 'No step yet: pull a handle.';
  const anew = steps.filter((step) => step.linearised).length;
  const count = steps.length === 1 ? 'one step' : `${steps.length} steps`;
  const from = steps.length > 1 ? `, from ${digits(first.energy)} after the first` : '';
  const end = {
    dragging: 'It follows the hand and is not the least yet.',
    settling: 'It is still falling.',
    converged: 'Nothing around this shape costs less.',
    not_converged: 'It stopped before the least energy was reached.',
  }[pane.status];
  return `${name}: energy ${digits(last.energy)} after ${count}${from}. Rings mark the steps that made a new matrix (${anew}). ${end}`;
}

interface VerticalAxis {
  ticks: number[];
  /** Null for what lies below the axis. */
  y(energy: number): number | null;
}

function verticalAxis(energies: readonly number[]): VerticalAxis {
  const height = HEIGHT - TOP - BOTTOM;
  const most = Math.max(...energies);
  if (!isWide(energies)) {
    const scale = linearScale(energies);
    return { ticks: scale.ticks, y: (energy) => HEIGHT - BOTTOM - scale.part(energy) * height };
  }
  const scale = logScale(energies.filter((energy) => energy > LEAST_PART * most));
  return {
    ticks: scale.ticks,
    y: (energy) => (energy < scale.low ? null : HEIGHT - BOTTOM - scale.part(energy) * height),
  };
}

function draw(root: SVGElement, steps: Steps): void {
  const energies = steps.flatMap(({ energy, terms }) => [energy, ...TERMS.map((t) => terms[t])]);
  const { ticks, y } = verticalAxis(energies);
  const width = WIDTH - LEFT - RIGHT;
  const xOf = (index: number) =>
    LEFT + (steps.length === 1 ? 0.5 : index / (steps.length - 1)) * width;
  const parts: SVGElement[] = [];
  for (const tick of ticks) {
    const at = y(tick) ?? HEIGHT - BOTTOM;
    parts.push(...levelMarks([LEFT, WIDTH - RIGHT], at, digits(tick, 2), 6));
  }
  const stride = Math.max(1, Math.ceil(steps.length / MOST_LABELS));
  for (let index = 0; index < steps.length; index += stride) {
    parts.push(plotText('tick tick-x', xOf(index), HEIGHT - BOTTOM + 16, String(index + 1)));
  }
  parts.push(
    plotText('axis', LEFT + width / 2, HEIGHT - 6, 'step'),
    uprightTitle(12, HEIGHT / 2, 'energy'),
  );
  function curve(kind: string, energyOf: (step: Steps[number]) => number): void {
    const points = steps.map((step, index): [number, number] | null => {
      const at = y(energyOf(step));
      return at === null ? null : [xOf(index), at];
    });
    parts.push(svg('path', { d: pathThrough(points), class: `curve ${kind}` }));
    // One step is no line.
    const [only] = points;
    if (points.length === 1 && only) {
      parts.push(svg('circle', { cx: only[0], cy: only[1], r: 2.5, class: `curve-dot ${kind}` }));
    }
  }
  for (const term of TERMS.filter((one) => steps.some(({ terms }) => terms[one] > 0))) {
    curve(`term-${term}`, ({ terms }) => terms[term]);
  }
  curve('whole', ({ energy }) => energy);
  steps.forEach(({ energy, linearised }, index) => {
    const at = y(energy);
    if (!linearised || at === null) return;
    parts.push(svg('circle', { cx: xOf(index), cy: at, r: 4, class: 'curve-ring' }));
  });
  root.replaceChildren(...parts);
}

function tableRow(step: Steps[number], index: number): HTMLElement {
  const numbers = [step.energy, ...TERMS.map((term) => step.terms[term]), step.relative_step];
  return rowOf(
    String(index + 1),
    ...numbers.map((value) => numberCell(digits(value))),
    element('td', {}, step.linearised ? 'new' : ''),
  );
}

/** The curve of the chosen pane. */
export function createEnergyCurve(parent: HTMLElement, store: Store<DeformState>): void {
  const root = createPlot(WIDTH, HEIGHT, 'energy-plot');
  const words = element('figcaption');
  const legend = element(
    'ul',
    { class: 'marks line-keys' },
    lineKey('curve whole', 'Whole'),
    ...TERMS.map((term) => lineKey(`curve term-${term}`, TERM_TITLES[term])),
  );
  const table = createNumberTable('Steps', 'Energy after each step', 'step-rows');
  fillHead(table, ['Step', 'Energy', ...TERMS.map((term) => TERM_TITLES[term]), 'Move', 'Matrix']);
  const numbers = folded(
    'The same as a table',
    { toggle: () => fill() },
    noteLine(
      'Energies have no unit. Each term is weighted; the three add up to the energy. Move: how far the points went, as a part of the size of the cloth (RMS).',
    ),
    table.box,
  );
  const figure = element('figure', { class: 'chart' });
  figure.append(legend, root, words);
  addSection(
    parent,
    'Energy of each step',
    element('h2', {}, 'Energy of each step'),
    figure,
    numbers,
  );

  let steps: Steps = [];

  function fill(): void {
    if (numbers.open) table.rows.replaceChildren(...steps.map(tableRow));
  }

  let drawn: PaneState | undefined;
  let counted: Record<Term, boolean> | undefined;
  watch(store, ['panes', 'chosen', 'terms'], ({ panes, chosen, terms }) => {
    const pane = panes[chosen];
    if (!pane || (pane === drawn && terms === counted)) return;
    drawn = pane;
    counted = terms;
    steps = weightedSteps(pane, terms);
    const isEmpty = steps.length === 0;
    root.toggleAttribute('hidden', isEmpty);
    legend.hidden = isEmpty;
    numbers.hidden = isEmpty;
    if (!isEmpty) draw(root, steps);
    setText(words, curveWords(titleOf(pane.fabric), steps, pane));
    fill();
  });
}
