// Sentences on the numbers of a shape.

import { element } from '../../shared/panels/element';
import { digits, percent } from '../../shared/panels/quantity';
import { addSection, folded } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import type { TermNumbers } from '../bindings/deform-module';
import { type DeformState, type PaneState, TERMS, type Term } from '../state/deform-state';
import { isSame, titleOf } from '../state/fabric-choice';
import { perTerm } from '../state/fabric-geometry';
import { TERM_TITLES } from './term-words';

type Counts = Record<Term, boolean>;

/** Bounds of the share that a term has in the three unweighted terms together. */
const LITTLE = 0.1;
const MUCH = 0.6;

/** A pull below both of these weights is met by recovery alone: bending would round it. */
const SPIKY_STRETCH = 0.01;
const SPIKY_BENDING = 0.05;

/** Least ratio at which two fabrics are called different. */
const CLEARLY_LESS = 0.8;

const DOES: Record<Term, { little: string; some: string; much: string }> = {
  recovery: {
    little: 'Stays near where it lay',
    some: 'Moves away from where it lay',
    much: 'Moves far from where it lay',
  },
  stretch: { little: 'Stretches little', some: 'Stretches', much: 'Stretches much' },
  bending: { little: 'Bends little', some: 'Bends', much: 'Bends much' },
};

const NOUNS: Record<Term, string> = {
  recovery: 'moves least from where it lay',
  stretch: 'stretches least',
  bending: 'bends least',
};

export const SPIKE =
  'With almost no weight on stretch, and little on bending, a pulled handle makes a spike: those are the measured weights, not a fault.';

function sum(values: TermNumbers): number {
  return TERMS.reduce((total, term) => total + values[term], 0);
}

function amount(part: number): 'little' | 'some' | 'much' {
  if (part < LITTLE) return 'little';
  return part > MUCH ? 'much' : 'some';
}

const KEEPS: Record<Term, string> = {
  recovery: 'stay where it lay',
  stretch: 'keep its lengths',
  bending: 'keep from bending',
};

const GIVES_WAY: Record<Term, string> = {
  recovery: 'move away',
  stretch: 'stretch',
  bending: 'bend',
};

/** A weight that is this many times another is felt as more. */
const CLEARLY_MORE = 1.5;

/** "Silk would rather stay where it lay, and will stretch or bend for it." */
export function preferenceSentence({ fabric, weights }: PaneState, counts: Counts): string {
  const title = titleOf(fabric);
  const name = title.charAt(0).toUpperCase() + title.slice(1);
  const counted = TERMS.filter((term) => counts[term]).sort((a, b) => weights[b] - weights[a]);
  const most = counted[0];
  if (most === undefined) return '';
  const less = TERMS.filter(
    (term) => !counts[term] || CLEARLY_MORE * weights[term] <= weights[most],
  );
  if (less.length === 0) return `${name} gives way in all three ways alike.`;
  const ways = less.map((term) => GIVES_WAY[term]).join(' or ');
  const alike = counted.filter((term) => !less.includes(term)).map((term) => KEEPS[term]);
  return `${name} would rather ${alike.join(' and ')}, and will ${ways} for it.`;
}

/** "Bends little: weight 73 %, and 5.0 % of the three before weighting." */
function termSentence(term: Term, { terms, weights }: PaneState, counts: Counts): string {
  const part = terms[term] / sum(terms);
  const does = DOES[term][amount(part)];
  const title = TERM_TITLES[term].toLowerCase();
  if (!counts[term]) return `${does}: ${title} is off and costs nothing.`;
  return `${does}: ${percent(part)} of the three terms before weighting, ${title} has a weight of ${percent(weights[term])}.`;
}

/** Names the term that most of the energy is. */
function energySentence(pane: PaneState, counts: Counts): string {
  const paid = perTerm((term) => (counts[term] ? pane.weights[term] * pane.terms[term] : 0));
  const total = sum(paid);
  const [most] = [...TERMS].sort((a, b) => paid[b] - paid[a]);
  if (!most || total <= 0) return '';
  return `Energy ${digits(pane.energy)}, a number without unit, ${percent(paid[most] / total)} of it ${TERM_TITLES[most].toLowerCase()}.`;
}

/** True of silk alone: spandex and nylon hardly resist stretch either, but bend round. */
export function isSpiky({ stretch, bending }: TermNumbers): boolean {
  return stretch < SPIKY_STRETCH && bending < SPIKY_BENDING;
}

/** Sentences on the chosen pane; one if it lies at rest. */
export function paneReading(pane: PaneState, counts: Counts): string[] {
  if (sum(pane.terms) <= 0) return ['At rest: no term costs anything. Pull a handle.'];
  const sentences = [preferenceSentence(pane, counts)];
  if (counts.stretch && isSpiky(pane.weights)) sentences.push(SPIKE);
  return sentences;
}

/** The numbers behind them. */
export function paneNumbers(pane: PaneState, counts: Counts): string[] {
  if (sum(pane.terms) <= 0) return [];
  const sentences = TERMS.map((term) => termSentence(term, pane, counts));
  return [...sentences, energySentence(pane, counts)].filter((sentence) => sentence !== '');
}

/** "Of these, canvas bends least: 0.50 against 5.0 of silk."; none where they are alike. */
export function comparedReading(panes: readonly PaneState[]): string[] {
  if (panes.length < 2) return [];
  return TERMS.flatMap((term) => {
    const ranked = [...panes].sort((a, b) => a.terms[term] - b.terms[term]);
    const [least] = ranked;
    const most = ranked.at(-1);
    if (!least || !most || least.terms[term] >= CLEARLY_LESS * most.terms[term]) return [];
    const numbers = `${digits(least.terms[term], 2)} against ${digits(most.terms[term], 2)} of ${titleOf(most.fabric)}`;
    return isSame(least.fabric, most.fabric)
      ? []
      : [`Of these, ${titleOf(least.fabric)} ${NOUNS[term]}: ${numbers}.`];
  });
}

/** A list of sentences that is made anew only when they are others. */
function createSentences() {
  const list = element('ul', { class: 'plain-list' });
  let shown = '';
  return {
    list,
    show(sentences: readonly string[]) {
      const text = sentences.join('\n');
      if (text === shown) return;
      shown = text;
      list.replaceChildren(...sentences.map((sentence) => element('li', {}, sentence)));
    },
  };
}

/** The sentences for the chosen pane, and for how those side by side differ. */
export function createTermReading(parent: HTMLElement, store: Store<DeformState>): void {
  const [words, numbers] = [createSentences(), createSentences()];
  const box = folded('In numbers', {}, numbers.list);
  addSection(
    parent,
    'What the shape says',
    element('h2', {}, 'What the shape says'),
    words.list,
    box,
  );
  watch(store, ['panes', 'chosen', 'terms'], ({ panes, chosen, terms }) => {
    const pane = panes[chosen];
    words.show(pane ? [...paneReading(pane, terms), ...comparedReading(panes)] : []);
    const lines = pane ? paneNumbers(pane, terms) : [];
    numbers.show(lines);
    box.hidden = lines.length === 0;
  });
}
