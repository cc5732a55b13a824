// Has methods compared on one step, and shows what comes of it.

import { button, choice, element, field, setText } from '../../../shared/panels/element';
import { createNumberTable, fillHead } from '../../../shared/panels/number-table';
import { digits, milliseconds } from '../../../shared/panels/quantity';
import { folded, noteLine } from '../../../shared/panels/section';
import { numberCell, rowOf } from '../../../shared/panels/table-parts';
import { createStore, type Store, watch } from '../../../shared/state/store';
import type { Constraints } from '../../bindings/convergence-module';
import { ConvergenceRun } from '../../run/convergence-run';
import type { MotionRun } from '../../run/motion-run';
import {
  type ConvergenceState,
  type ConvergenceStory,
  constraintsOf,
  MOST_COMPLIANT_VERTICES,
  NO_CONVERGENCE,
  type StepBegin,
} from '../../state/convergence';
import type { MotionState } from '../../state/motion-state';
import { createConvergencePlot } from './convergence-plot';
import { MEASURES, readingOf, type Way, waysOf } from './convergence-words';

const WHAT =
  'One step of this scene, without air and solids, solved by each position-based method from the same predicted places, with ever more rounds.';

const MEASURE_WORDS: Record<Constraints, string> = {
  rigid:
    'Rigid springs do not give: what is left is how far they are from their lengths, 1 before the first round.',
  compliant:
    'Compliant springs give as the fabric does: what is left is the distance to where the method’s own equations would end, 1 before the first round. Methods that solve a step as a whole take part.',
};

/** Words on what times and "never" mean. */
const HOW =
  'Measured on this device, each time the better of two batches of 50 ms. A method that never gets there had up to 513 rounds, fewer where one solve takes longer than 30 ms.';

const NEWTON =
  'Methods that solve a step as a whole are held against where Newton’s iterations end.';

const DISTURBED = 'The cloth was playing meanwhile: the times are too long.';

/** Times as choices have them: no number stands for now. */
const NOW = -1;
const BEGINS = [
  { value: NOW, title: 'Shown now' },
  ...[0, 0.25, 0.5, 1, 2].map((value) => ({
    value,
    title: value === 0 ? 'The first one' : `At ${value} s`,
  })),
];

const CONSTRAINTS: readonly { value: Constraints; title: string }[] = [
  { value: 'rigid', title: 'Rigid' },
  { value: 'compliant', title: 'Compliant' },
];

export function storyWords(story: ConvergenceStory): string {
  if (story === 'unasked') return '';
  if ('done' in story) return 'Comparing beside the shown cloth, which waits.';
  if ('refused' in story) return story.refused;
  return readingOf(waysOf(story));
}

function createTable() {
  const table = createNumberTable('Rounds of each method', 'What methods leave of the step');
  return {
    box: table.box,
    fill(ways: readonly Way[], valueTitle: string) {
      fillHead(table, ['Method, rounds', 'Time', valueTitle]);
      const rows = ways.flatMap(({ title, points }) =>
        points.map(({ rounds, ms, left }) =>
          rowOf(`${title}, ${rounds}`, numberCell(milliseconds(ms)), numberCell(digits(left, 2))),
        ),
      );
      table.rows.replaceChildren(...rows);
    },
  };
}

/** The step and what springs do in it. */
function createWish(motion: Store<MotionState>, store: Store<ConvergenceState>): HTMLElement {
  const begins = choice(BEGINS, (value) => {
    const begin: StepBegin = value === NOW ? null : value;
    store.set({ begin });
  });
  const constraints = choice(CONSTRAINTS, (value) => store.set({ constraints: value }));
  const words = noteLine();
  const render = () => {
    const { setting, summary } = motion.get();
    const isLarge = (summary?.n_vertices ?? 0) > MOST_COMPLIANT_VERTICES;
    const shown = store.get().constraints ?? constraintsOf(setting);
    constraints.limit((value) =>
      value === 'compliant' && isLarge ? `up to ${MOST_COMPLIANT_VERTICES} vertices` : null,
    );
    constraints.select(shown);
    begins.select(store.get().begin ?? NOW);
    setText(words, MEASURE_WORDS[shown]);
  };
  watch(motion, ['setting', 'summary'], render);
  watch(store, ['begin', 'constraints'], render);
  const pair = element(
    'div',
    { class: 'pair' },
    field('Which step', begins.control),
    field('Springs', constraints.control),
  );
  return element('div', {}, pair, words);
}

export function createConvergenceChart(
  parent: HTMLElement,
  motion: Store<MotionState>,
  shown: Pick<MotionRun, 'rest'>,
): void {
  const store = createStore(NO_CONVERGENCE);
  const run = new ConvergenceRun(motion, store, () => shown.rest());
  const wide = { class: 'wide' };
  const start = button('Compare methods on this step', () => void run.start(), wide);
  const cancel = button('Cancel', () => run.cancel(), wide);
  const progress = element('progress', { max: 1, 'aria-label': 'Progress of the comparison' });
  const of = noteLine();
  const figure = element('figure', { class: 'chart' });
  const plot = createConvergencePlot(figure);
  const reading = element('p', { class: 'reading', 'aria-live': 'polite' });
  const table = createTable();
  const asTable = folded('The same as a table', {}, table.box);
  const note = noteLine();
  parent.append(
    noteLine(WHAT),
    createWish(motion, store),
    start,
    cancel,
    progress,
    of,
    figure,
    reading,
    asTable,
    note,
  );
  watch(motion, ['phase'], ({ phase }) => {
    start.disabled = phase !== 'ready';
  });
  watch(store, ['story', 'of'], ({ story, of: subject, disturbed }) => {
    const isRunning = typeof story === 'object' && 'done' in story;
    const isDrawn = typeof story === 'object' && 'study' in story;
    start.hidden = isRunning;
    cancel.hidden = !isRunning;
    progress.hidden = !isRunning;
    if (isRunning) progress.value = story.done;
    of.hidden = story === 'unasked';
    setText(of, subject);
    setText(reading, storyWords(story));
    for (const part of [figure, asTable, note]) part.hidden = !isDrawn;
    if (!isDrawn) return;
    const { title } = MEASURES[story.constraints];
    const ways = waysOf(story);
    plot.draw(ways, title);
    table.fill(ways, title);
    const also = story.constraints === 'rigid' ? '' : ` ${NEWTON}`;
    setText(note, `${HOW}${also}${disturbed ? ` ${DISTURBED}` : ''}`);
  });
}
