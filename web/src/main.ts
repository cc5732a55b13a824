// Which view is shown, by the address and the tabs. Each view is made when it is first asked for.
import type { View } from './shared/page/view';
import './shared/page/design.css';
import { createMotionView, type MotionView } from './motion/motion-view';
import { createTabs, VIEWS, type ViewId } from './tabs';

const place = (id: string): HTMLElement => {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found;
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

/** Parts of the page that only one view needs, fetched when it is first asked for. */
const FETCHED: Record<Exclude<ViewId, 'motion'>, (hash: string) => Promise<View>> = {
  async refinement(hash) {
    const { createRefinementView } = await import('./refinement/refinement-view');
    views.refinement ??= createRefinementView(place('refinement'), hash);
    return views.refinement;
  },
  async fabrics(hash) {
    const { createFabricsView } = await import('./fabrics/fabrics-view');
    views.fabrics ??= createFabricsView(place('fabrics'), hash, {
      wear(fabric) {
        motionView('#').wear(fabric);
        show('motion');
      },
      start(shape, fabric) {
        motionView('#').start(shape, fabric);
        show('motion');
      },
    });
    return views.fabrics;
  },
};

/** For the console and for tests: the shown view's state and frame. */
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
    const view = id === 'motion' ? motionView(hash) : await FETCHED[id](hash);
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

if (import.meta.env.PROD && 'serviceWorker' in navigator) {
  // Without it (a page opened from an insecure address) the page works, but only while served.
  navigator.serviceWorker.register('./offline.js').catch(() => undefined);
}
