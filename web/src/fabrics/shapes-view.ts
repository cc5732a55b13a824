// Shapes of least energy: one cloth, pulled by hand, in one to four fabrics or in all. Its store, its
// worker, its stage and its panels, wired together.
import type { StartShape } from '../shared/page/view';
import '../shared/page/energies.css';
import type { Collider } from '../shared/bindings/geometry';
import { createAnnouncer } from '../shared/panels/announcer';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createInvitation } from '../shared/panels/invitation';
import { createKeyList, type Keys, VIEW_KEYS } from '../shared/panels/keys-panel';
import { openStage } from '../shared/panels/open-stage';
import { createStageCanvas } from '../shared/panels/stage-canvas';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store, watch } from '../shared/state/store';
import { createEnergyCurve } from './panels/energy-curve';
import { createExperimentPanel } from './panels/experiment-panel';
import { createFabricCard } from './panels/fabric-card';
import { createFabricGallery } from './panels/fabric-gallery';
import { fabricsSentence } from './panels/fabrics-sentence';
import { createGalleryHeading } from './panels/gallery-heading';
import { createHoldList } from './panels/hold-list';
import { createOwnFabricForm } from './panels/own-fabric-form';
import { columnsFor, createPaneBadges } from './panels/pane-badges';
import { createStageTools } from './panels/stage-tools';
import { createTermReading } from './panels/term-reading';
import { createTermSwitches } from './panels/term-switches';
import { Deformer } from './run/deformer';
import {
  createFabricsStage,
  type FabricsStage,
  type FabricsStageEvents,
} from './stage/fabrics-stage';
import type { HoldMark } from './stage/hold-marks';
import { withShown, withToggled } from './state/fabric-choice';
import { decodeFabricsLink, encodeFabricsLink } from './state/fabrics-link';
import { type FabricsState, initialFabricsState, recordOf } from './state/fabrics-state';
import { joined, middleOf } from './state/holds';
import type { Way } from './way';

const KEYS: Keys = [
  ['G', 'take the cloth at the middle of the chosen picture; then arrows, Page Up and Page Down'],
  ['G or Escape', 'let go: the handle stays'],
  ['P', 'change between pulling and pinning'],
  ['1 to 4', 'choose a picture'],
  ...VIEW_KEYS,
];

export interface ShapesActions {
  /** Shows that fabric in motion. */
  wear(fabric: string): void;
  /** Sets a cloth of that fabric in motion from a shape. */
  start(shape: StartShape, fabric: string): void;
}

function marksOf(state: FabricsState): HoldMark[] {
  return state.holds.map((hold) => ({
    kind: hold.kind,
    place: middleOf(hold),
    isChosen: hold.name === state.chosenHold,
  }));
}

/** The vertex in the middle of the first handle, that asks to be pulled. */
function invitingVertex({ handles, cloth }: FabricsState): number {
  const [handle] = handles;
  if (handle) return handle.vertices[Math.floor(handle.vertices.length / 2)] ?? 0;
  return Math.floor((cloth?.n_vertices ?? 0) / 2);
}

/** The picture and what lies on it, all of one store. */
class Picture {
  stage: FabricsStage | null = null;
  private readonly invitation;
  private readonly badges;
  private awaitsFraming = false;
  private dressed = ''; // ids of the fabrics in the panes

  constructor(
    private readonly box: HTMLElement,
    private readonly store: Store<FabricsState>,
  ) {
    this.invitation = createInvitation(box);
    this.badges = createPaneBadges(box, store, { choose: (pane) => this.choose(pane) });
  }

  choose(chosen: number): void {
    if (chosen < this.store.get().panes.length) this.store.set({ chosen });
  }

  showMesh(triangles: Uint32Array, nVertices: number, bodies: Collider[]): void {
    this.awaitsFraming = true;
    this.stage?.showMesh(triangles, nVertices);
    this.stage?.setBodies(bodies);
  }

  showFrame(pane: number, buffer: ArrayBuffer): void {
    this.stage?.showFrame(pane, buffer);
    if (!this.awaitsFraming || pane !== 0) return;
    this.awaitsFraming = false;
    const state = this.store.get();
    const held = joined(state.holds).places;
    this.stage?.frame([...(state.cloth?.rest_m ?? []), ...held]);
    this.stage?.invite(invitingVertex(state));
  }

  /** Opens the stage where the browser can draw it, and follows the store from then on. */
  open(canvas: HTMLCanvasElement, deformer: Deformer): void {
    const { store, box } = this;
    this.stage = openStage(canvas, store, (pictureLost) =>
      createFabricsStage(box, canvas, { ...this.events(deformer), pictureLost }),
    );
    new ResizeObserver(() => this.layOut()).observe(box);
    watch(store, ['panes', 'ownFabric'], () => this.dress());
    watch(store, ['pins', 'handles', 'chosenHold'], (state) =>
      this.stage?.setMarks(marksOf(state)),
    );
    watch(store, ['edges'], ({ edges }) => this.stage?.setEdges(edges));
    watch(store, ['chosen'], ({ chosen }) => this.stage?.choose(chosen));
    watch(store, ['tool'], ({ tool }) => box.classList.toggle('pinning', tool === 'pin'));
    watch(store, ['invited', 'phase', 'panes'], ({ invited, phase, panes }) =>
      this.invitation.setShown(invited && phase === 'ready' && panes[0]?.status !== 'dragging'),
    );
  }

  private events(deformer: Deformer): Omit<FabricsStageEvents, 'pictureLost'> {
    const { store } = this;
    return {
      press: (vertex, pane) => {
        this.choose(pane);
        if (store.get().tool === 'pin') deformer.hand.togglePin(vertex, pane);
        return store.get().tool === 'pin';
      },
      grab: (vertex, pane) => deformer.hand.grab(vertex, pane),
      moveGrab: (target) => deformer.hand.move(target),
      releaseGrab: () => deformer.hand.release(),
      key: (name) => this.key(name),
      drawn: ({ x, y }) => this.invitation.place(x, y),
    };
  }

  private key(name: string): boolean {
    const { tool } = this.store.get();
    if (name === 'p') this.store.set({ tool: tool === 'pin' ? 'pull' : 'pin' });
    else if (/^[1-4]$/.test(name)) this.choose(Number(name) - 1);
    else return false;
    return true;
  }

  private fabricIds(): number[] {
    const { panes, ownFabric } = this.store.get();
    return panes.map(({ fabric }) => recordOf(fabric, ownFabric).id);
  }

  private dress(): void {
    const ids = JSON.stringify(this.fabricIds());
    if (ids === this.dressed) return; // numbers alone
    this.dressed = ids;
    this.layOut();
  }

  private layOut(): void {
    const { clientWidth, clientHeight } = this.box;
    const ids = this.fabricIds();
    const nColumns = columnsFor(ids.length, clientWidth, clientHeight);
    this.stage?.setPanes(ids, nColumns);
    this.badges.setColumns(nColumns);
  }
}

/** The own fabric's form, and what shows it beside others or takes it away. */
function createOwnFabric(panel: HTMLElement, store: Store<FabricsState>, deformer: Deformer): void {
  createOwnFabricForm(panel, store, {
    measure: (measures) => deformer.measure(measures),
    show(measures) {
      const { compared: fabrics, chosen, gallery } = store.get();
      const comparison = { fabrics, chosen: gallery ? 0 : chosen };
      deformer.compare(withShown(comparison, { kind: 'own', measures }));
    },
    hide() {
      const { compared: fabrics, chosen } = store.get();
      const own = fabrics.find(({ kind }) => kind === 'own');
      const left = own && withToggled({ fabrics, chosen }, own);
      if (left && typeof left !== 'string') deformer.compare(left);
    },
  });
}

function createPanels(
  panel: HTMLElement,
  store: Store<FabricsState>,
  deformer: Deformer,
  picture: Picture,
): void {
  createExperimentPanel(panel, store, deformer);
  createFabricGallery(panel, store, {
    compare: (comparison) => deformer.compare(comparison),
    choose: (pane) => picture.choose(pane),
    showAll: (all) => deformer.setGallery(all),
    setOrder: (order) => deformer.setOrder(order),
  });
  createFabricCard(panel, store, { setWeightsFrom: (weightsFrom) => store.set({ weightsFrom }) });
  createTermReading(panel, store);
  createTermSwitches(panel, store, {
    setForm: (form) => store.set({ form }),
    setTerms: (terms) => store.set({ terms }),
  });
  createEnergyCurve(panel, store);
  createOwnFabric(panel, store, deformer);
  createHoldList(panel, store, {
    nudge(name, direction) {
      const hold = store.get().holds.find((one) => one.name === name);
      if (!hold || !picture.stage) return;
      const from = middleOf(hold);
      const to = picture.stage.stepFrom(from, direction);
      deformer.nudge(name, [to[0] - from[0], to[1] - from[1], to[2] - from[2]]);
    },
    choose: (chosenHold) => store.set({ chosenHold }),
    release: (name) => deformer.release(name),
    resetHolds: () => deformer.resetHolds(),
  });
  createKeyList(panel, KEYS);
}

function createTools(
  toolBox: HTMLElement,
  store: Store<FabricsState>,
  deformer: Deformer,
  homeView: () => void,
  actions: ShapesActions,
): void {
  const chosenName = () => {
    const { panes, chosen } = store.get();
    const fabric = panes[chosen]?.fabric;
    return fabric?.kind === 'named' ? fabric.name : null;
  };
  createStageTools(toolBox, store, {
    homeView,
    wear() {
      const name = chosenName();
      if (name !== null) actions.wear(name);
    },
    async start() {
      const name = chosenName();
      const shape = name === null ? null : await deformer.startShape();
      if (name !== null && shape) actions.start(shape, name);
    },
  });
}

/** `left` takes its messages, stage and tools. */
export interface ShapesWay extends Way {
  /** Takes a visitor's mesh. */
  take(file: File): void;
}

export function createShapesView(
  left: HTMLElement,
  panel: HTMLElement,
  hash: string,
  actions: ShapesActions,
): ShapesWay {
  const first = decodeFabricsLink(hash);
  const store = createStore(initialFabricsState(first.link, first.problems));
  let isShown = false;
  const messages = element('div');
  const stageBox = element('section', { class: 'stage', 'aria-label': 'Cloth' });
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Tools' });
  const canvas = createStageCanvas(
    stageBox,
    'Cloth in three dimensions. G takes the cloth, arrows turn the view.',
  );
  const heading = createGalleryHeading(store);
  left.append(messages, heading, stageBox, toolBox);

  const picture = new Picture(stageBox, store);
  const deformer = new Deformer(store, {
    showMesh: (triangles, nVertices, { bodies }) => picture.showMesh(triangles, nVertices, bodies),
    showFrame: (pane, buffer) => picture.showFrame(pane, buffer),
  });
  picture.open(canvas, deformer);
  createFailureBanner(messages, store);
  createAnnouncer(messages, store, fabricsSentence);
  createTools(toolBox, store, deformer, () => picture.stage?.homeView(), actions);
  createPanels(panel, store, deformer, picture);
  deformer.openExperiment(first.link.experiment, first.link);

  const link = () => `#${encodeFabricsLink(store.get())}`;
  const writeLink = createLinkWriter(store, link, () => isShown && store.get().cloth !== null);
  return {
    link,
    take: (file) => void deformer.openObj(file),
    open(newHash) {
      const read = decodeFabricsLink(newHash);
      const { objName, objUnit, objOdd } = store.get();
      const own = { objName, objUnit, objOdd };
      store.set({ ...initialFabricsState(read.link, read.problems), ...own });
      deformer.openExperiment(read.link.experiment, read.link);
    },
    setShown(value) {
      isShown = value;
      writeLink();
    },
    probe: {
      state: () => store.get(),
      positions: (pane = 0) => Array.from(picture.stage?.positions(pane) ?? []),
      project: (vertex: number, pane = 0) => picture.stage?.project(vertex, pane),
      inviting: () => invitingVertex(store.get()),
    },
  };
}
