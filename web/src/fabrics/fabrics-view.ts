// The view of fabrics: one cloth, pulled by hand, in one to four fabrics or in all. Its store, its
// worker, its stage and its panels, wired together.
import type { StartShape, View } from '../shared/page/view';
import '../shared/page/panes.css';
import './fabrics.css';
import './panel.css';
import { inputFailure } from '../shared/bindings/answers';
import { createAnnouncer } from '../shared/panels/announcer';
import { createDropTarget } from '../shared/panels/drop-target';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createInvitation } from '../shared/panels/invitation';
import { PICTURE_LOST, replaceCanvas } from '../shared/panels/no-picture';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, watch } from '../shared/state/store';
import { createEnergyCurve } from './panels/energy-curve';
import { createExperimentPanel } from './panels/experiment-panel';
import { createFabricCard } from './panels/fabric-card';
import { createFabricGallery } from './panels/fabric-gallery';
import { createFabricsKeys } from './panels/fabrics-keys';
import { fabricsSentence } from './panels/fabrics-sentence';
import { createHoldList } from './panels/hold-list';
import { createOwnFabricForm } from './panels/own-fabric-form';
import { columnsFor, createPaneBadges } from './panels/pane-badges';
import { createStageTools } from './panels/stage-tools';
import { createTermReading } from './panels/term-reading';
import { createTermSwitches } from './panels/term-switches';
import { Deformer } from './run/deformer';
import { createFabricsStage, type FabricsStage } from './stage/fabrics-stage';
import type { HoldMark } from './stage/hold-marks';
import { withShown, withToggled } from './state/fabric-choice';
import { decodeFabricsLink, encodeFabricsLink } from './state/fabrics-link';
import { type FabricsState, initialFabricsState, recordOf } from './state/fabrics-state';
import { joined, middleOf } from './state/holds';

export type FabricsView = View;

export interface FabricsActions {
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

export function createFabricsView(
  root: HTMLElement,
  hash: string,
  actions: FabricsActions,
): FabricsView {
  const first = decodeFabricsLink(hash);
  const store = createStore(initialFabricsState(first.link, first.problems));
  let isShown = false;
  let stage: FabricsStage | null = null;
  let awaitsFraming = false;

  const messages = element('div');
  const stageBox = element('section', { class: 'stage', 'aria-label': 'Cloth' });
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Tools' });
  const panel = element('aside', { class: 'panel', 'aria-label': 'Fabrics and experiment' });
  const canvas = element('canvas', {
    tabindex: 0,
    role: 'application',
    'aria-label': 'Cloth in three dimensions. G takes the cloth, arrows turn the view.',
  });
  stageBox.append(canvas);
  root.replaceChildren(element('div', { class: 'left' }, messages, stageBox, toolBox), panel);

  const deformer: Deformer = new Deformer(store, {
    showMesh(triangles, nVertices, { bodies }) {
      awaitsFraming = true;
      stage?.showMesh(triangles, nVertices);
      stage?.setBodies(bodies);
    },
    showFrame(pane, buffer) {
      stage?.showFrame(pane, buffer);
      if (!awaitsFraming || pane !== 0) return;
      awaitsFraming = false;
      const state = store.get();
      const held = joined(state.holds).places;
      stage?.frame([...(state.cloth?.rest_m ?? []), ...held]);
      stage?.invite(invitingVertex(state));
    },
  });

  const choosePane = (chosen: number) => {
    if (chosen < store.get().panes.length) store.set({ chosen });
  };
  const invitation = createInvitation(stageBox);
  const badges = createPaneBadges(stageBox, store, { choose: choosePane });

  function key(name: string): boolean {
    if (name === 'p') store.set({ tool: store.get().tool === 'pin' ? 'pull' : 'pin' });
    else if (/^[1-4]$/.test(name)) choosePane(Number(name) - 1);
    else return false;
    return true;
  }

  try {
    stage = createFabricsStage(stageBox, canvas, {
      press(vertex, pane) {
        choosePane(pane);
        if (store.get().tool === 'pin') deformer.togglePin(vertex, pane);
        return store.get().tool === 'pin';
      },
      grab: (vertex, pane) => deformer.grab(vertex, pane),
      moveGrab: (target) => deformer.moveGrab(target),
      releaseGrab: () => deformer.releaseGrab(),
      key,
      drawn: ({ x, y }) => invitation.place(x, y),
      contextLost() {
        store.set({ problem: inputFailure(PICTURE_LOST) });
      },
    });
  } catch {
    replaceCanvas(canvas, 'The numbers');
  }

  function layOut(): void {
    const { panes, ownFabric } = store.get();
    const nColumns = columnsFor(panes.length, stageBox.clientWidth, stageBox.clientHeight);
    const ids = panes.map(({ fabric }) => recordOf(fabric, ownFabric).id);
    stage?.setPanes(ids, nColumns);
    badges.setColumns(nColumns);
  }
  new ResizeObserver(layOut).observe(stageBox);

  let dressed = '';
  watch(store, ['panes', 'ownFabric'], ({ panes, ownFabric }) => {
    const fabrics = JSON.stringify(panes.map(({ fabric }) => recordOf(fabric, ownFabric).id));
    if (fabrics === dressed) return; // numbers alone
    dressed = fabrics;
    layOut();
  });
  watch(store, ['pins', 'handles', 'chosenHold'], (state) => stage?.setMarks(marksOf(state)));
  watch(store, ['edges'], ({ edges }) => stage?.setEdges(edges));
  watch(store, ['chosen'], ({ chosen }) => stage?.choose(chosen));
  watch(store, ['tool'], ({ tool }) => stageBox.classList.toggle('pinning', tool === 'pin'));
  watch(store, ['invited', 'phase', 'panes'], ({ invited, phase, panes }) =>
    invitation.setShown(invited && phase === 'ready' && panes[0]?.status !== 'dragging'),
  );
  const showProblem = createFailureBanner(messages, () => store.set({ problem: null }));
  watch(store, ['problem', 'phase'], showProblem);

  createAnnouncer(messages, store, fabricsSentence);
  createStageTools(toolBox, store, {
    homeView: () => stage?.homeView(),
    wear() {
      const fabric = store.get().panes[store.get().chosen]?.fabric;
      if (fabric?.kind === 'named') actions.wear(fabric.name);
    },
    async start() {
      const fabric = store.get().panes[store.get().chosen]?.fabric;
      const shape = fabric?.kind === 'named' ? await deformer.startShape() : null;
      if (fabric?.kind === 'named' && shape) actions.start(shape, fabric.name);
    },
  });
  createExperimentPanel(panel, store, {
    openExperiment: (id) => deformer.openExperiment(id),
    openObj: (file) => void deformer.openObj(file),
  });
  createFabricGallery(panel, store, {
    compare: (comparison) => deformer.compare(comparison),
    choose: choosePane,
    showAll: (all) => deformer.setGallery(all),
  });
  createFabricCard(panel, store, { setWeightsFrom: (weightsFrom) => store.set({ weightsFrom }) });
  createTermReading(panel, store);
  createTermSwitches(panel, store, {
    setForm: (form) => store.set({ form }),
    setTerms: (terms) => store.set({ terms }),
  });
  createEnergyCurve(panel, store);
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
  createHoldList(panel, store, {
    nudge(name, direction) {
      const hold = store.get().holds.find((one) => one.name === name);
      if (!hold || !stage) return;
      const from = middleOf(hold);
      const to = stage.stepFrom(from, direction);
      deformer.nudge(name, [to[0] - from[0], to[1] - from[1], to[2] - from[2]]);
    },
    choose: (chosenHold) => store.set({ chosenHold }),
    release: (name) => deformer.release(name),
    resetHolds: () => deformer.resetHolds(),
  });
  createFabricsKeys(panel);
  createDropTarget(document.body, {
    openObj(file) {
      if (isShown) void deformer.openObj(file);
    },
  });
  deformer.openExperiment(first.link.experiment, first.link);

  const link = () => `#${encodeFabricsLink(store.get())}`;
  const writeLink = createLinkWriter(store, link, () => isShown && store.get().cloth !== null);

  return {
    link,
    open(newHash) {
      const read = decodeFabricsLink(newHash);
      store.set({ ...initialFabricsState(read.link, read.problems), objName: store.get().objName });
      deformer.openExperiment(read.link.experiment, read.link);
    },
    setShown(value) {
      isShown = value;
      writeLink();
    },
    probe: {
      state: () => store.get(),
      positions: (pane = 0) => Array.from(stage?.positions(pane) ?? []),
      project: (vertex: number, pane = 0) => stage?.project(vertex, pane),
      inviting: () => invitingVertex(store.get()),
    },
  };
}
