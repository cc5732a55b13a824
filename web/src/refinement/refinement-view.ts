// The view of refinement: one garment on a walking body, on a coarse, a planned and a fine mesh. Its
// store, its workers, its stage and its panels, wired together.
import firstBody from 'virtual:pleat-body';
import type { View } from '../shared/page/view';
import '../shared/page/panes.css';
import './refinement.css';
import { fabricNamed } from '../shared/fabric/fabric-data';
import { createAnnouncer } from '../shared/panels/announcer';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createKeyList, type Keys } from '../shared/panels/keys-panel';
import { openStage } from '../shared/panels/open-stage';
import { objText, save } from '../shared/panels/saving';
import { createStageCanvas } from '../shared/panels/stage-canvas';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store, watch } from '../shared/state/store';
import type { SolidsAnswer } from './bindings/refinement-module';
import { createAnswer } from './panels/answer';
import { createDetailPanel } from './panels/detail-panel';
import { createFitLight } from './panels/fit-light';
import { createFitPanel } from './panels/fit-panel';
import { createGarmentBadges } from './panels/garment-badges';
import { createGarmentLegend } from './panels/garment-legend';
import { createGarmentPanel } from './panels/garment-panel';
import { garmentSentence } from './panels/garment-sentence';
import { createGarmentToolbar } from './panels/garment-toolbar';
import { createNumbersPanel } from './panels/numbers-panel';
import { paintOf, upperEnd } from './panels/paints';
import { createStoryPanel } from './panels/story-panel';
import { createWork } from './panels/work';
import type { ShownFrame } from './run/pane-set';
import { Trio } from './run/trio';
import { GarmentStage } from './stage/garment-stage';
import { createFaceDistances, type FaceDistances } from './state/face-distances';
import { decodeRefinementLink, encodeRefinementLink } from './state/refinement-link';
import {
  comparedPanes,
  initialRefinementState,
  isComputedHere,
  PANES,
  type PaneId,
  type RefinementState,
  shownPanes,
  showsFineCloth,
} from './state/refinement-state';
import type { GarmentMesh } from './worker/garment-protocol';

const KEYS: Keys = [
  ['Space', 'play or pause'],
  ['.', 'one frame'],
  ['R', 'reset'],
  ['E and H', 'edges of the faces, hanging vertices'],
  ['Arrows', 'turn the view'],
  ['+ and -', 'closer, farther'],
  ['M', 'the hem, closely'],
  ['Home', 'first view'],
];

/** Least width of a pane: in a narrower one a person is too small to compare folds [CSS pixels]. */
const LEAST_PANE_WIDTH = 180;

/** Digits of a scale's end. */
const SCALE_DIGITS = 2;

/** Distances of a mesh's faces [m], `none` where there is nothing to tell, null where only vertices have some. */
type Distances = Float32Array | 'none' | null;

/** The picture of the three panes, all of one store. */
class Picture {
  stage: GarmentStage | null = null;
  readonly meshes: Partial<Record<PaneId, GarmentMesh>> = {};
  /** Functions of the faces' distances from fine; null for a mesh that fine does not refine. */
  private readonly measures = new Map<PaneId, FaceDistances | null>();
  /** The faces' distances in the frames that are shown. */
  private readonly distances = new Map<PaneId, Distances>();

  constructor(private readonly store: Store<RefinementState>) {}

  showMesh(id: PaneId, mesh: GarmentMesh): void {
    this.meshes[id] = mesh;
    if (id === 'fine') this.measures.clear();
    else this.measures.delete(id);
    this.distances.clear();
    this.stage?.setMesh(PANES.indexOf(id), mesh);
    this.repaint(this.store.get(), id);
  }

  showFrames(frames: ShownFrame[], solids: SolidsAnswer | null): void {
    for (const { pane, buffer } of frames) this.stage?.showFrame(PANES.indexOf(pane), buffer);
    if (solids) this.stage?.setSolids(solids);
    this.distances.clear();
    this.fitScale();
    const state = this.store.get();
    if (state.colour === 'distance') for (const { pane } of frames) this.repaint(state, pane);
  }

  /** Opens the stage where the browser can draw it. */
  open(box: HTMLElement, canvas: HTMLCanvasElement, key: (name: string) => boolean): void {
    const { store } = this;
    this.stage = openStage(
      canvas,
      store,
      (pictureLost) =>
        new GarmentStage(box, canvas, {
          press(pane, face) {
            if (PANES[pane] === 'planned') store.set({ face });
          },
          key,
          pictureLost,
        }),
    );
    // Somebody stands there until the clothes have come.
    this.stage?.setSolids(firstBody as SolidsAnswer);
  }

  /** Follows the store from now on. */
  follow(): void {
    const { store } = this;
    watch(store, ['colour', 'ranges', 'plan', 'phase'], (state) => {
      for (const id of PANES) this.repaint(state, id);
    });
    let shown = '';
    watch(store, ['panes', 'computeFine', 'isNarrow', 'beside', 'rival'], (state) => {
      const ids = shownPanes(state);
      if (ids.join() === shown) return;
      shown = ids.join();
      this.stage?.setPanes(ids.map((id) => PANES.indexOf(id)));
    });
    watch(store, ['edges'], ({ edges }) => this.stage?.setEdges(edges));
    watch(store, ['hanging'], ({ hanging }) => this.stage?.setHanging(hanging));
    watch(store, ['fabric'], ({ fabric }) => this.stage?.setFabric(fabricNamed(fabric).id));
    const planned = PANES.indexOf('planned');
    watch(store, ['face', 'phase'], ({ face }) => this.stage?.setChosen(planned, face));
  }

  hemView(): void {
    this.stage?.hemView(PANES.indexOf('planned'));
  }

  async savePicture(): Promise<void> {
    const picture = await this.stage?.picture();
    if (picture) save('pleat-refinement.png', picture);
  }

  saveObj(): void {
    const pane = PANES.indexOf('planned');
    if (!this.stage) return;
    const text = objText(this.stage.positions(pane), this.stage.triangles(pane));
    save('pleat-garment.obj', new Blob([text], { type: 'model/obj' }));
  }

  private repaint(state: RefinementState, id: PaneId): void {
    const mesh = this.meshes[id];
    const paint = mesh && paintOf(state, mesh, state.plan, this.distancesOf(id));
    if (paint) this.stage?.setPaint(PANES.indexOf(id), paint);
  }

  /** Distances of a pane's faces from the fine cloth as both are shown. */
  private distancesOf(id: PaneId): Distances {
    const known = this.distances.get(id);
    if (known !== undefined) return known;
    const measured = this.measured(id);
    this.distances.set(id, measured);
    return measured;
  }

  private measured(id: PaneId): Distances {
    const [mesh, { fine }, state] = [this.meshes[id], this.meshes, this.store.get()];
    const [own, places] = [this.placesOf(id), this.placesOf('fine')];
    const isInStep = state.panes.fine.source !== 'resting';
    if (id === 'fine' || !mesh || !fine || !isInStep || own.length * places.length === 0)
      return 'none';
    if (!this.measures.has(id)) this.measures.set(id, createFaceDistances(mesh, fine));
    const measure = this.measures.get(id);
    if (measure) return measure(own, places);
    // Vertices of a sample are on the fine cloth: they tell nothing of the faces.
    return showsFineCloth(state) || state.panes[id].source === 'sampled' ? 'none' : null;
  }

  private placesOf(id: PaneId): Float32Array {
    return this.stage?.positions(PANES.indexOf(id)) ?? new Float32Array(0);
  }

  /** Values of each face or vertex that the colours of a pane show. */
  private valuesOf(id: PaneId, colour: 'curvature' | 'distance'): Float32Array {
    const ofFaces = colour === 'distance' ? this.distancesOf(id) : null;
    if (ofFaces === 'none') return new Float32Array(0);
    return ofFaces ?? this.stage?.scalars(PANES.indexOf(id)) ?? new Float32Array(0);
  }

  /** The scale of a quantity reaches as far as any pane's values do. It does not shrink while it plays. */
  private fitScale(): void {
    const state = this.store.get();
    const { colour, ranges, playing } = state;
    if (colour !== 'curvature' && colour !== 'distance') return;
    const ends = comparedPanes(state).map((id) => upperEnd(this.valuesOf(id, colour)));
    const most = Number(Math.max(...ends).toPrecision(SCALE_DIGITS));
    const fits = playing ? most <= ranges[colour] : most === 0 || most === ranges[colour];
    if (!fits) this.store.set({ ranges: { ...ranges, [colour]: most } });
  }
}

/** The boxes of the view, and its canvas. */
function createBoxes(root: HTMLElement) {
  const messages = element('div');
  const badgeBox = element('div');
  const pictureBox = element('div', { class: 'garment-picture' });
  const stageBox = element(
    'section',
    { class: 'stage garment-stage', 'aria-label': 'Garment on three meshes' },
    badgeBox,
    pictureBox,
  );
  const legendBox = element('div');
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Run' });
  const panel = element('aside', { class: 'panel', 'aria-label': 'Refinement' });
  const canvas = createStageCanvas(
    pictureBox,
    'A walking figure in a garment, once on each mesh. Space plays, arrows turn the view, a press on a face tells why it is so fine.',
  );
  const left = element('div', { class: 'left' }, messages, stageBox, legendBox, toolBox);
  root.replaceChildren(left, panel);
  return { messages, badgeBox, pictureBox, legendBox, toolBox, panel, canvas };
}

function createPanels(
  { messages, badgeBox, pictureBox, legendBox, toolBox, panel }: ReturnType<typeof createBoxes>,
  store: Store<RefinementState>,
  trio: Trio,
  picture: Picture,
): void {
  createAnswer(badgeBox, store);
  createGarmentBadges(badgeBox, store);
  createFitLight(badgeBox, store);
  const stageWork = element('div', { class: 'stage-work' });
  pictureBox.append(stageWork);
  createWork(stageWork, store, trio, ({ canCancel }) => !canCancel);
  new ResizeObserver(() => {
    const { clientWidth: width } = pictureBox;
    const nPanes = comparedPanes(store.get()).length;
    if (width > 0) store.set({ isNarrow: width < nPanes * LEAST_PANE_WIDTH });
  }).observe(pictureBox);
  createGarmentLegend(legendBox, store);
  picture.follow();
  createFailureBanner(messages, store);
  createAnnouncer(messages, store, garmentSentence);
  createGarmentToolbar(toolBox, store, trio, {
    homeView: () => picture.stage?.homeView(),
    hemView: () => picture.hemView(),
    savePicture: () => picture.savePicture(),
    saveObj: () => picture.saveObj(),
  });
  createGarmentPanel(panel, store);
  createNumbersPanel(panel, store);
  createFitPanel(panel, store, trio);
  createDetailPanel(panel, store, trio);
  createStoryPanel(panel, store, () => picture.meshes.planned ?? null);
  createKeyList(panel, KEYS);
}

export function createRefinementView(root: HTMLElement, hash: string): View {
  const first = decodeRefinementLink(hash);
  const store = createStore<RefinementState>(initialRefinementState(first.link, first.problems));
  let isShown = false;
  const boxes = createBoxes(root);
  const picture = new Picture(store);
  const trio = new Trio(store, {
    showMesh: (id, mesh) => picture.showMesh(id, mesh),
    showFrames: (frames, solids) => picture.showFrames(frames, solids),
  });
  picture.open(boxes.pictureBox, boxes.canvas, (name) => {
    const { playing, edges, hanging } = store.get();
    const actions: Record<string, () => void> = {
      ' ': () => (playing ? trio.pause() : trio.play()),
      '.': () => trio.step(),
      r: () => trio.reset(),
      e: () => store.set({ edges: !edges }),
      h: () => store.set({ hanging: !hanging }),
      m: () => picture.hemView(),
    };
    actions[name]?.();
    return name in actions;
  });
  createPanels(boxes, store, trio, picture);

  /** The link starts at the shown time, while that rests; a run that is computed here always at its beginning. */
  const link = () => {
    const state = store.get();
    const isAtTime = state.phase === 'ready' && !state.playing;
    const timeS = isComputedHere(state) ? 0 : state.timeS;
    return `#${encodeRefinementLink({ ...state, startS: isAtTime ? timeS : state.startS })}`;
  };
  /** Pane of a mesh that is in step, from left to right. */
  const paneAt = (place: number) => {
    const id = comparedPanes(store.get())[place];
    return id ? PANES.indexOf(id) : -1;
  };
  const writeLink = createLinkWriter(store, link, () => isShown && store.get().plan !== null);

  return {
    link,
    open(newHash) {
      const read = decodeRefinementLink(newHash);
      const { problem } = initialRefinementState(read.link, read.problems);
      store.set({ ...read.link, problem });
    },
    setShown(value) {
      isShown = value;
      if (!value) trio.pause();
      writeLink();
    },
    probe: {
      state: () => store.get(),
      positions: (place = 0) => Array.from(picture.stage?.positions(paneAt(place)) ?? []),
      project: (vertex: number, place = 0) => picture.stage?.project(vertex, paneAt(place)),
    },
  };
}
