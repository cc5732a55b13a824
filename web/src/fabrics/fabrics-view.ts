// The view of fabrics: strips over an edge, shapes pulled by hand, and two fabrics in motion. Each is made
// when it is first asked for, and rests while another one is shown.
import type { View } from '../shared/page/view';
import '../shared/page/panes.css';
import './fabrics.css';
import './panel.css';
import { createDropTarget } from '../shared/panels/drop-target';
import { element } from '../shared/panels/element';
import { createSegments, type Segment } from '../shared/panels/segments';
import { createPairView, type PairWay } from './pair-view';
import { createShapesView, type ShapesActions, type ShapesWay } from './shapes-view';
import { type WayId, wayIn } from './state/ways';
import { createStripsView } from './strips-view';
import type { Way } from './way';

export type FabricsActions = ShapesActions;

const TITLES: readonly Segment<WayId>[] = [
  { value: 'strips', title: 'All fifteen over an edge', meaning: 'Which fabric is stiff?' },
  { value: 'shapes', title: 'Pulled by hand', meaning: 'Shapes by the weights measured in 2015' },
  { value: 'pair', title: 'Two in motion', meaning: 'Two fabrics side by side, in step' },
];

const PANELS: Record<WayId, string> = {
  strips: 'Strips',
  shapes: 'Fabrics and experiment',
  pair: 'Two fabrics',
};

export function createFabricsView(root: HTMLElement, hash: string, actions: FabricsActions): View {
  let isShown = false;
  let shown: WayId = wayIn(hash);
  let pair: PairWay | null = null;
  let shapes: ShapesWay | null = null;
  const ways = new Map<WayId, { way: Way; boxes: HTMLElement[] }>();
  const choice = createSegments(
    'way',
    { class: 'segments ways', 'aria-label': 'Ways to look at fabrics' },
    (way: WayId) => show(way),
    TITLES,
  );
  const left = element('div', { class: 'left' }, choice.control);
  root.replaceChildren(left);

  const makers: Record<WayId, (box: HTMLElement, panel: HTMLElement, at: string) => Way> = {
    strips: (box, panel, at) => createStripsView(box, panel, at, { move: showInMotion }),
    shapes(box, panel, at) {
      shapes = createShapesView(box, panel, at, actions);
      return shapes;
    },
    pair(box, panel, at) {
      pair = createPairView(box, panel, at);
      return pair;
    },
  };

  function create(id: WayId, at: string): void {
    const box = element('div', { class: 'way' });
    const panel = element('aside', { class: 'panel', 'aria-label': PANELS[id] });
    left.append(box);
    root.append(panel);
    ways.set(id, { way: makers[id](box, panel, at), boxes: [box, panel] });
  }

  /** Shows a way as it was left, or as a link has it. */
  function show(id: WayId, at?: string): void {
    const known = ways.get(id);
    shown = id;
    if (known && at !== undefined) known.way.open(at);
    if (!known) create(id, at ?? `#view=fabrics&show=${id}`);
    choice.select(id);
    for (const [other, { way, boxes }] of ways) {
      for (const box of boxes) box.hidden = other !== id;
      way.setShown(isShown && other === id);
    }
  }

  function showInMotion(fabric: string): void {
    show('pair');
    pair?.wear(fabric);
  }

  createDropTarget(
    () => isShown,
    (file) => {
      show('shapes');
      shapes?.take(file);
    },
  );
  show(shown, hash);
  const now = () => ways.get(shown)?.way;
  return {
    link: () => now()?.link() ?? '#view=fabrics',
    open: (newHash) => show(wayIn(newHash), newHash),
    setShown(value) {
      isShown = value;
      now()?.setShown(value);
    },
    probe: {
      state: () => ({ show: shown, ...now()?.probe.state() }),
      positions: (pane?: number) => now()?.probe.positions(pane) ?? [],
      project: (vertex: number, pane?: number) => now()?.probe.project?.(vertex, pane),
      inviting: () => now()?.probe.inviting?.() ?? 0,
    },
  };
}
