// The demand or the number of vertices, whichever was moved last; and the source of the frames.
import { checkBox, element, field, setText } from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import { DEMANDS, type Doing, type RefinementState } from '../state/refinement-state';
import { sourceSentence, vertices } from './garment-words';
import { createWork } from './work';

/** A slider is not followed more often [ms]: each plan builds a mesh. */
const FOLLOW_AFTER_MS = 180;

const BUDGET_STEP = 10;

function slider(options: { min: number; max: number; step: number }, moved: (at: number) => void) {
  let timer = 0;
  const input = element('input', {
    type: 'range',
    ...options,
    input() {
      window.clearTimeout(timer);
      timer = window.setTimeout(() => {
        timer = 0;
        moved(input.valueAsNumber);
      }, FOLLOW_AFTER_MS);
      told();
    },
  });
  const told = () => input.dispatchEvent(new CustomEvent('told'));
  return {
    input,
    /** Nothing is put over what a visitor has just chosen and nobody has followed yet. */
    show(value: number) {
      if (timer === 0) input.value = String(value);
    },
  };
}

export function createDetailPanel(
  parent: HTMLElement,
  store: Store<RefinementState>,
  actions: { cancel(): void },
): void {
  const { input: demand, show: showDemand } = slider(
    { min: DEMANDS.least, max: DEMANDS.most, step: DEMANDS.step },
    (value) => store.set({ rule: 'demand', demand: value }),
  );
  const { input: budget, show: showBudget } = slider(
    { min: 0, max: 1, step: BUDGET_STEP },
    (value) => store.set({ rule: 'budget', budget: value }),
  );
  const [demandValue, budgetValue] = [element('output'), element('output')];
  const demandField = field('At most so much of the example’s shapes is lost', demand, demandValue);
  const budgetField = field('Or: at most so many vertices', budget, budgetValue);
  for (const made of [demandField, budgetField]) made.classList.add('slider-field');
  const records = checkBox('Show frames that come with the page', (useRecords) =>
    store.set({ useRecords }),
  );
  const fine = checkBox('Fine mesh in step', (computeFine) => store.set({ computeFine }));
  const source = noteLine();
  const work = element('div');
  const isOwn = ({ share, canCancel }: Doing) => share === null && canCancel;
  createWork(work, store, actions, isOwn);
  const sayDemand = () => setText(demandValue, `${demand.valueAsNumber} mm`);
  const sayBudget = () => {
    const text = vertices(budget.valueAsNumber);
    setText(budgetValue, text);
    budget.setAttribute('aria-valuetext', text);
  };
  demand.addEventListener('told', sayDemand);
  budget.addEventListener('told', sayBudget);
  addSection(
    parent,
    'How fine',
    element('h2', {}, 'How fine'),
    demandField,
    budgetField,
    work,
    records.label,
    fine.label,
    source,
  );
  watch(
    store,
    ['rule', 'demand', 'budget', 'budgetRange', 'plan', 'useRecords', 'computeFine', 'panes'],
    (state) => {
      const [least, most] = state.budgetRange ?? [0, 1];
      budget.min = String(BUDGET_STEP * Math.ceil(least / BUDGET_STEP));
      budget.max = String(BUDGET_STEP * Math.floor(most / BUDGET_STEP));
      showDemand(state.demand);
      const known = state.rule === 'budget' ? state.budget : state.plan?.vertices;
      showBudget(known ?? least);
      sayDemand();
      sayBudget();
      demandField.classList.toggle('idle', state.rule !== 'demand');
      budgetField.classList.toggle('idle', state.rule !== 'budget');
      records.input.checked = state.useRecords;
      fine.input.checked = state.computeFine;
      setText(source, sourceSentence(state));
    },
  );
}
