// Shows a view by the address and the tabs. Each view is made when it is first asked for.
import { keepOfflineCopy } from './shared/page/offline';
import type { View } from './shared/page/view';
import './shared/page/design.css';
import type { FabricsActions } from './fabrics/fabrics-view';
import { createMotionView, type MotionView } from './motion/motion-view';
import { element } from './shared/panels/element';
import { createTabs, VIEWS, type ViewId } from './tabs';

/** A part of the document by its id; a view that the document has no place for gets one. */
const place = (id: string): HTMLElement => {
  const found = document.getElementById(id);
  if (found) return found;
  if (!VIEWS.some((view) => view.id === id)) throw new Error(`the page has no #${id}`);
  const made = element('main', { id, hidden: true });
  document.body.append(made);
  return made;
};

function viewIn(hash: string): ViewId {
  const name = new URLSearchParams(hash.replace(/^#/, '')).get('view');
  return VIEWS.find(({ id }) => id === name)?.id ?? 'motion';
}

let motion: MotionView | null = null;
const views: Partial<Record<ViewId, View>> = {};
let shown: ViewId | null = null;

function motionView(hash: string): MotionView {
  motion ??= createMotionView(place, hash);
  views.motion = motion;
  return motion;
}

/** Hands a fabric or a start shape to the view of motion, which is shown from then on. */
const toMotion: FabricsActions = {
  wear(fabric) {
    motionView('#').wear(fabric);
    void show('motion');
  },
  start(shape, fabric) {
    motionView('#').start(shape, fabric);
    void show('motion');
  },
};

type Create = (root: HTMLElement, hash: string) => View;

/** Parts of the page that only one view needs, fetched when it is first asked for. */
const FETCHED: Record<Exclude<ViewId, 'motion'>, () => Promise<Create>> = {
  refinement: async () => (await import('./refinement/refinement-view')).createRefinementView,
  async fabrics() {
    const { createFabricsView } = await import('./fabrics/fabrics-view');
    return (root, hash) => createFabricsView(root, hash, toMotion);
  },
  modes: async () => (await import('./modes/modes-view')).createModesView,
  failures: async () => (await import('./failures/failures-view')).createFailuresView,
};

async function fetchedView(id: keyof typeof FETCHED, hash: string): Promise<View> {
  const create = await FETCHED[id]();
  views[id] ??= create(place(id), hash);
  return views[id];
}

/** Gives the shown view's state and frame to the console and to tests. */
function expose({ probe }: View): void {
  Object.assign(window, { pleat: probe });
}

/** `hash` is of a view that is not there yet, or empty for how it starts. */
async function show(id: ViewId, hash = ''): Promise<void> {
  shown = id;
  tabs.select(id);
  for (const view of VIEWS) {
    place(view.id).hidden = view.id !== id;
    if (view.id !== id) views[view.id]?.setShown(false);
  }
  try {
    const view = id === 'motion' ? motionView(hash) : await fetchedView(id, hash);
    if (shown !== id) return;
    view.setShown(true);
    expose(view);
  } catch {
    place(id).textContent = 'This view could not be fetched. Check the connection and reload.';
  }
}

const tabs = createTabs(place('tabs'), {
  link: (id) => views[id]?.link() ?? `#view=${id}`,
  open: (id) => void show(id),
});

window.addEventListener('hashchange', () => {
  const { hash } = window.location;
  const id = viewIn(hash);
  views[id]?.open(hash);
  if (id !== shown) void show(id, hash);
});
void show(viewIn(window.location.hash), window.location.hash);

keepOfflineCopy();
