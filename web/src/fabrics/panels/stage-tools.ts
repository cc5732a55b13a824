// The row under the stage: what a press does, the view, and what takes this fabric or this shape into motion.
import { button, checkBox } from '../../shared/panels/element';
import { createSegments, type Segment } from '../../shared/panels/segments';
import { type Store, watch } from '../../shared/state/store';
import type { FabricsState, Tool } from '../state/fabrics-state';

export interface StageToolActions {
  homeView(): void;
  wear(): void;
  start(): void;
}

const TOOLS: readonly Segment<Tool>[] = [
  { value: 'pull', title: 'Pull', meaning: 'A press takes the cloth at any point' },
  { value: 'pin', title: 'Pin', meaning: 'A press puts a pin into the cloth, or takes it out (P)' },
];

const NO_MOTION = 'Three ratios say neither weight nor stiffness: choose a fabric of the list';

export function createStageTools(
  parent: HTMLElement,
  store: Store<FabricsState>,
  actions: StageToolActions,
): void {
  const tools = createSegments(
    'tool',
    { class: 'segments tool-switch', 'aria-label': 'A press on the cloth' },
    (tool: Tool) => store.set({ tool }),
    TOOLS,
  );
  const edges = checkBox('Edges', (isOn) => store.set({ edges: isOn }));
  const view = button('View', actions.homeView, {
    title: 'Look from the first direction again (Home)',
  });
  const wear = button('Carry this fabric over to motion', actions.wear);
  const start = button('Start moving from this shape', actions.start);
  parent.append(tools.control, view, edges.label, wear, start);
  watch(store, ['tool', 'edges', 'panes', 'chosen', 'phase'], (state) => {
    tools.select(state.tool);
    edges.input.checked = state.edges;
    const isOwn = state.panes[state.chosen]?.fabric.kind === 'own';
    for (const to of [wear, start]) to.disabled = isOwn || state.phase !== 'ready';
    wear.title = isOwn ? NO_MOTION : 'The scene of the other view in this fabric';
    start.title = isOwn ? NO_MOTION : 'Lets this very cloth go, from the shape it has';
  });
}
