// The row under the stage: what a press does, the view, and what takes this fabric or this shape into motion.
import { button, checkBox, element, setText } from '../../shared/panels/element';
import { createSegments, type Segment } from '../../shared/panels/segments';
import { type Store, watch } from '../../shared/state/store';
import { easedSentence } from '../state/edge-reach';
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

const UNKNOWN = 'The shape is still being found';

/** The sentence why the shape of the chosen pane starts no motion; null where it does. */
export function whyNoStart({ panes, chosen, phase }: FabricsState): string | null {
  const pane = panes[chosen];
  if (!pane || phase !== 'ready') return UNKNOWN;
  if (pane.fabric.kind === 'own') return NO_MOTION;
  return pane.reach ? null : UNKNOWN;
}

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
  const reason = element('p', { class: 'note start-reason', id: 'start-reason' });
  start.setAttribute('aria-describedby', reason.id);
  parent.append(tools.control, view, edges.label, wear, start, reason);
  watch(store, ['tool', 'edges', 'panes', 'chosen', 'phase'], (state) => {
    tools.select(state.tool);
    edges.input.checked = state.edges;
    const isOwn = state.panes[state.chosen]?.fabric.kind === 'own';
    wear.disabled = isOwn || state.phase !== 'ready';
    wear.title = isOwn ? NO_MOTION : 'The scene of the other view in this fabric';
    const why = whyNoStart(state);
    const { reach } = state.panes[state.chosen] ?? {};
    const eased = why === null && reach ? easedSentence(reach) : null;
    start.disabled = why !== null;
    start.title =
      why ?? 'Lets this very cloth go, from the shape it has or from part of the way to it';
    const words = (why === UNKNOWN ? null : why) ?? eased;
    reason.hidden = words === null;
    setText(reason, words ?? '');
  });
}
