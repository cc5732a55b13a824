// One fabric: its use, what to expect of it, its weights and measurements, its physical numbers.

import {
  type FabricRecord,
  fabricNamed,
  fabrics,
  inRun,
  sources,
} from '../../shared/fabric/fabric-data';
import { lookOf } from '../../shared/fabric/fabric-look';
import { checkBox, element, setText } from '../../shared/panels/element';
import { quantityMeanings, quantityRows, sourceList } from '../../shared/panels/fabric-quantities';
import { digits, percent } from '../../shared/panels/quantity';
import { folded, noteLine } from '../../shared/panels/section';
import { heading, numberCell, rowOf, tableOf } from '../../shared/panels/table-parts';
import { type Store, watch } from '../../shared/state/store';
import type { FitAnswer, TermNumbers } from '../bindings/deform-module';
import { type DeformState, TERMS } from '../state/deform-state';
import { titleOf } from '../state/fabric-choice';
import { EXPECTATIONS } from '../state/fabric-expectations';
import { geometryOf } from '../state/fabric-geometry';
import { rankOf } from '../state/fabric-order';
import { bendingLengthWords, markedQuantity } from './marked-words';
import { TERM_COSTS, TERM_MEASUREMENTS, TERM_TITLES } from './term-words';
import { createWeightBar, termKey, weightWords } from './weight-bar';

/** The printed weights have two digits after the point [%], some cut and not rounded. */
const PRINTED_EXACTLY = 0.006e-2;

/** The printed weight where it does not follow from the printed measures, else null. */
export function misprint(recomputed: number, published: number): string | null {
  if (Math.abs(recomputed - published) <= PRINTED_EXACTLY) return null;
  return `${Number((100 * published).toFixed(6))} %`;
}

interface Shown {
  weights: TermNumbers;
  measures: TermNumbers;
  normalised: TermNumbers;
  /** Null when nobody printed any. */
  published: TermNumbers | null;
}

function shownOf(fabric: FabricRecord): Shown {
  const { measures, normalised, recomputed, published } = geometryOf(fabric);
  return { weights: recomputed, measures, normalised, published };
}

/** How stiff it is beside the others, which its weights do not say, and how far it holds itself up. */
export function stiffnessSentence(fabric: FabricRecord): string {
  const key = 'bend_warp_n_m';
  const rigidity = `${markedQuantity(fabric, key)} (${inRun(fabric, key).confidence})`;
  const rank = `number ${rankOf(fabric, key)} of ${fabrics.length} from the stiffest`;
  const weight = markedQuantity(fabric, 'areal_density_kg_per_m2');
  const length = bendingLengthWords(fabric);
  return `In forces, its bending rigidity at rest is ${rigidity}: ${rank}. With its weight of ${weight} that is a bending length of ${length}.`;
}

function weightRows({ weights, published }: Shown): HTMLElement[] {
  return TERMS.map((term) => {
    const printed = published ? misprint(weights[term], published[term]) : null;
    const exact =
      printed === null ? percent(weights[term]) : `${(100 * weights[term]).toFixed(3)} %`;
    return rowOf(
      [termKey(term), TERM_TITLES[term], element('small', {}, `avoids ${TERM_COSTS[term]}`)],
      numberCell(exact),
      numberCell(published ? (printed ?? 'same') : '–'),
    );
  });
}

function measureRows({ measures, normalised }: Shown): HTMLElement[] {
  return TERMS.map((term) =>
    rowOf(
      [TERM_TITLES[term], element('small', {}, TERM_MEASUREMENTS[term])],
      numberCell(measures[term].toFixed(4)),
      numberCell(digits(normalised[term], 2)),
    ),
  );
}

function termTable(caption: string, titles: string[], rows: HTMLElement[]): HTMLElement {
  const body = element('tbody', {}, ...rows);
  return tableOf('quantities term-table', caption, heading(...titles), body);
}

function weightTable(shown: Shown): HTMLElement {
  return termTable('Weights', ['Term', 'Weight', 'As printed'], weightRows(shown));
}

const WEIGHTS_NOTE =
  'Weights are shares: they tell what this fabric trades for what, and not how stiff it is beside another.';

function measurementBox(shown: Shown): HTMLElement {
  return folded(
    'What was measured',
    {},
    termTable('Geometric measurements', ['Test', 'Ratio', 'Normalised'], measureRows(shown)),
    noteLine(
      'The weights are the shares of the normalised values. How these follow from the ratios is not printed: presumably from the spread of the twenty tests of each fabric.',
    ),
    noteLine(`Source: ${sources.SEED ?? ''}.`),
  );
}

function physicalBox(fabric: FabricRecord): HTMLElement {
  const body = element('tbody', {}, ...quantityRows(fabric));
  return folded(
    'Physical numbers',
    {},
    noteLine(
      `For the fabric in motion; the shape here does not use them. Taken as: ${fabric.assumed_construction}.`,
    ),
    tableOf('quantities', 'Physical numbers of the fabric', body),
    folded('Where the numbers come from', {}, sourceList(fabric)),
    folded('What the words mean', {}, quantityMeanings()),
  );
}

function ownShown({ weights, normalised }: FitAnswer, measures: TermNumbers): Shown {
  return { weights, measures, normalised, published: null };
}

export interface CardActions {
  setWeightsFrom(from: DeformState['weightsFrom']): void;
}

/** The card of the chosen pane's fabric. */
export function createFabricCard(
  parent: HTMLElement,
  store: Store<DeformState>,
  { setWeightsFrom }: CardActions,
): void {
  const swatch = element('span', { class: 'swatch', 'aria-hidden': 'true' });
  const name = element('h2', {});
  const use = element('span', { class: 'note' });
  const expectation = element('p', { class: 'caption' });
  const stiffness = noteLine();
  const { bar, show } = createWeightBar();
  const { input: printed, label: printedLine } = checkBox(
    'Use the weights as they are printed',
    (isOn) => setWeightsFrom(isOn ? 'published' : 'recomputed'),
  );
  const body = element('div');
  parent.append(
    element(
      'section',
      { 'aria-label': 'Fabric', class: 'fabric-card' },
      element('div', { class: 'fabric-title' }, swatch, name, use),
      expectation,
      stiffness,
      bar,
      body,
      printedLine,
    ),
  );

  function showNamed(fabric: FabricRecord, from: DeformState['weightsFrom']): void {
    const { front, back } = lookOf(fabric.id);
    swatch.style.background = `linear-gradient(135deg, ${front} 50%, ${back} 50%)`;
    setText(use, fabric.use_en);
    setText(expectation, EXPECTATIONS[fabric.name_en] ?? '');
    setText(stiffness, stiffnessSentence(fabric));
    show(geometryOf(fabric)[from]);
    const shown = shownOf(fabric);
    const parts = [
      weightTable(shown),
      noteLine(WEIGHTS_NOTE),
      measurementBox(shown),
      physicalBox(fabric),
    ];
    body.replaceChildren(...parts);
  }

  function showOwn(own: FitAnswer, measures: TermNumbers): void {
    setText(use, 'measured by you');
    setText(
      expectation,
      `Its weights are a guess: ${weightWords(own.weights)}. Nearest measured fabric: ${own.nearest}.`,
    );
    show(own.weights);
    const shown = ownShown(own, measures);
    body.replaceChildren(weightTable(shown), noteLine(WEIGHTS_NOTE), measurementBox(shown));
  }

  let drawn = '';
  watch(store, ['panes', 'chosen', 'weightsFrom', 'ownFabric'], (state) => {
    const { panes, chosen, weightsFrom, ownFabric } = state;
    const fabric = panes[chosen]?.fabric;
    if (!fabric) return;
    const isOwn = fabric.kind === 'own';
    // The numbers of a pane change with every frame, its card does not.
    const text = JSON.stringify([fabric, weightsFrom, isOwn && ownFabric]);
    if (text === drawn) return;
    drawn = text;
    setText(name, titleOf(fabric));
    printed.checked = weightsFrom === 'published';
    printedLine.hidden = isOwn;
    swatch.hidden = isOwn;
    stiffness.hidden = isOwn;
    if (fabric.kind === 'named') showNamed(fabricNamed(fabric.name), weightsFrom);
    else if (ownFabric) showOwn(ownFabric, fabric.measures);
    else body.replaceChildren();
  });
}
