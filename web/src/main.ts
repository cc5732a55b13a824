// Which view is shown, by the address and the tabs. Each view is made when it is first asked for.
import './design.css';
import type { FabricsView } from './views/fabrics-view';
import { createMotionView, type MotionView } from './views/motion-view';
import { createTabs, type ViewId } from './views/tabs';
import type { View } from './views/view';

const place = (id: string): HTMLElement => {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found;
};

function viewIn(hash: string): ViewId {
  const name = new URLSearchParams(hash.replace(/^#/, '')).get('view');
  return name === 'fabrics' ? 'fabrics' : 'motion';
}

let motion: MotionView | null = null;
let fabrics: FabricsView | null = null;
let shown: ViewId | null = null;

function motionView(hash: string): MotionView {
  motion ??= createMotionView(place, hash);
  return motion;
}

/** A part of the page that only this view needs, fetched when it is first asked for. */
async function fabricsView(hash: string): Promise<FabricsView> {
  const { createFabricsView } = await import('./views/fabrics-view');
  fabrics ??= createFabricsView(place('fabrics'), hash, {
    wear(fabric) {
      motionView('#').wear(fabric);
      show('motion');
    },
    start(shape, fabric) {
      motionView('#').start(shape, fabric);
      show('motion');
    },
  });
  return fabrics;
}

/** For the console and for tests: the shown view's state and frame. */
function expose({ probe }: View): void {
  Object.assign(window, { pleat: probe });
}

/** `hash` is of a view that is not there yet, or empty for how it starts. */
async function show(id: ViewId, hash = ''): Promise<void> {
  shown = id;
  tabs.select(id);
  place('motion').hidden = id !== 'motion';
  place('fabrics').hidden = id !== 'fabrics';
  if (id === 'motion') {
    fabrics?.setShown(false);
    const view = motionView(hash);
    view.setShown(true);
    return expose(view);
  }
  motion?.setShown(false);
  try {
    const view = await fabricsView(hash);
    if (shown !== 'fabrics') return;
    view.setShown(true);
    expose(view);
  } catch {
    place('fabrics').textContent =
      'This view could not be fetched. Check the connection and reload.';
  }
}

const tabs = createTabs(place('tabs'), {
  link: (id) => (id === 'motion' ? motion?.link() : fabrics?.link()) ?? `#view=${id}`,
  open: (id) => void show(id),
});

window.addEventListener('hashchange', () => {
  const { hash } = window.location;
  const id = viewIn(hash);
  const known = id === 'motion' ? motion : fabrics;
  known?.open(hash);
  if (id !== shown) void show(id, hash);
});
void show(viewIn(window.location.hash), window.location.hash);

if (import.meta.env.PROD && 'serviceWorker' in navigator) {
  // Without it (a page opened from an insecure address) the page works, but only while served.
  navigator.serviceWorker.register('./offline.js').catch(() => undefined);
}
