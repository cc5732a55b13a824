// Finds the shapes that the view of fabrics shows: turns changes of the state and of the hand into
// messages, and answers into state and frames.
import {
  brokenSentence,
  type Failure,
  inputFailure,
  internalFailure,
} from '../../shared/bindings/answers';
import { frameViews } from '../../shared/bindings/frame';
import type { Triple } from '../../shared/bindings/geometry';
import { fabricsText } from '../../shared/fabric/fabric-data';
import type { StartShape } from '../../shared/page/view';
import type { Store } from '../../shared/state/store';
import { startDeformWorker } from '../../shared/workers/client';
import type { PaneState, Triple as TermTriple } from '../state/deform-state';
import { EXPERIMENTS, type Experiment, OWN, ownExperiment } from '../state/experiments';
import type { Comparison } from '../state/fabric-choice';
import { linkedHolds } from '../state/fabrics-link';
import {
  countedWeights,
  type FabricsLink,
  type FabricsState,
  heldBy,
  linkFailure,
  panesFor,
} from '../state/fabrics-state';
import { baseOf, type Hold, holdAt, holdsOf, joined, placeOf } from '../state/holds';
import type { DeformFrame, FromDeform } from '../worker/deform-protocol';

/** A hand that has not moved for so long rests [ms]. */
const REST_AFTER_MS = 150;

/** Numbers of a cloth that is being pulled are shown this often [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 150;

export interface DeformerView {
  /** Another cloth; its frames follow. */
  showMesh(triangles: Uint32Array, nVertices: number, experiment: Experiment): void;
  /** The buffer stays valid until the next one of that pane. */
  showFrame(pane: number, buffer: ArrayBuffer): void;
}

export interface Deformer {
  /** An experiment by its id, as it is by itself or as a link has it. */
  openExperiment(id: string, link?: FabricsLink): void;
  openObj(file: File): Promise<void>;
  grab(vertex: number, pane: number): void;
  /** Where the taken vertex is wanted [m]. */
  moveGrab(target: Triple): void;
  releaseGrab(): void;
  /** Puts a pin around a vertex, or takes out the one that holds it. */
  togglePin(vertex: number, pane: number): void;
  release(name: string): void;
  /** Moves one hold by so much [m]. */
  nudge(name: string, move: Triple): void;
  /** Everything as the experiment has it. */
  resetHolds(): void;
  compare(comparison: Comparison): void;
  setGallery(isShown: boolean): void;
  measure(measures: TermTriple): void;
  /** The shape of the chosen pane, to start a motion from. */
  startShape(): Promise<StartShape>;
}

/** What is on its way to be shown. */
interface Opening {
  experiment: Experiment;
  link: FabricsLink | null;
  /** Of the mesh that it names, unless that is to be fetched. */
  objText: string;
}

type Shown = Pick<
  FabricsState,
  'compared' | 'gallery' | 'chosen' | 'terms' | 'form' | 'weightsFrom'
>;

function shownOf({ compared, gallery, chosen, terms, form, weightsFrom }: FabricsState): Shown {
  return { compared, gallery, chosen, terms, form, weightsFrom };
}

const ALL_TERMS = { recovery: true, stretch: true, bending: true };

/** Of a cloth that no link comes with. */
const UNMOVED: Pick<FabricsLink, 'moved' | 'released'> = { moved: [], released: [] };

/** A failure of what was just changed, for somebody who sees pins and not a scene's file. */
function undone(failure: Failure): Failure {
  if (failure.where !== '/pins') return failure;
  const what = failure.what.charAt(0).toUpperCase() + failure.what.slice(1);
  return inputFailure(
    `Undone: without recovery, pins and handles have to say where all of the cloth is. ${what}.`,
  );
}

export function createDeformer(store: Store<FabricsState>, view: DeformerView): Deformer {
  const client = startDeformWorker(receive, broken);
  let asked = 0; // counts what is to be opened
  let cloth = -1; // the one that is shown
  let opening: Opening | null = null;
  let shown: (ArrayBuffer | undefined)[] = [];
  let taken: { name: string; base: Triple; isNew: Hold | null } | null = null;
  let restTimer = 0;
  let lastNumbersMs = 0;
  let obj: { name: string; text: string } | null = null;
  let granted: { show: Shown | null; hold: readonly Hold[] } = { show: null, hold: [] };
  let unanswered = { show: 0, hold: 0 };
  let onShape: ((shape: StartShape) => void) | null = null;

  function broken(reason: string): void {
    const problem = internalFailure(brokenSentence('The shapes', reason));
    store.set({ phase: 'broken', problem });
  }

  function refuse(failure: Failure): void {
    store.set({ problem: failure });
  }

  async function open(wanted: Opening): Promise<void> {
    asked += 1;
    const own = asked;
    opening = wanted;
    store.set({ phase: 'loading' });
    const { experiment } = wanted;
    let text = wanted.objText;
    try {
      if (experiment.meshUrl !== null) {
        const answer = await fetch(experiment.meshUrl);
        if (!answer.ok) throw new Error(answer.statusText);
        text = await answer.text();
      }
    } catch {
      if (own !== asked) return;
      opening = null;
      store.set({ phase: 'ready' });
      return refuse(inputFailure('The mesh could not be fetched. Check the connection.'));
    }
    if (own !== asked) return;
    const { text: sceneText } = experiment;
    client.send({ type: 'open', cloth: own, fabricsText, sceneText, objText: text });
  }

  /** Goes back to what could be shown; of a link that never could be, to all terms. */
  function undoShow(): void {
    const state = store.get();
    const last = granted.show ?? { ...shownOf(state), terms: ALL_TERMS };
    if (JSON.stringify(last) === JSON.stringify(shownOf(state))) return;
    store.set(last);
    showPanes();
  }

  /** Goes back to what held the cloth before. */
  function undoHold(): void {
    if (granted.hold === store.get().holds) return;
    setHolds(granted.hold);
    sendHolds(granted.hold);
  }

  /** What the page shows and what the worker has are the same again once nothing is unanswered. */
  function answered(what: 'show' | 'hold', isGranted: boolean): void {
    unanswered = { ...unanswered, [what]: unanswered[what] - 1 };
    if (unanswered[what] > 0) return;
    if (!isGranted) return what === 'show' ? undoShow() : undoHold();
    const state = store.get();
    granted =
      what === 'show' ? { ...granted, show: shownOf(state) } : { ...granted, hold: state.holds };
  }

  /** Numbers that are shown are of what was before, until new ones come. */
  function settle(): void {
    store.set({ panes: store.get().panes.map((pane) => ({ ...pane, status: 'settling' })) });
  }

  function sendPanes(): void {
    settle();
    const { panes, terms, form } = store.get();
    const weights = panes.map((pane) => countedWeights(pane, terms));
    unanswered.show += 1;
    client.send({ type: 'show', form, weights });
  }

  function sendHolds(holds: readonly Hold[]): void {
    unanswered.hold += 1;
    settle();
    const { vertices, places } = joined(holds);
    client.send({ type: 'hold', vertices, places }, [vertices.buffer, places.buffer]);
  }

  function setHolds(holds: readonly Hold[]): void {
    store.set(heldBy(holds));
  }

  /** The same holds elsewhere: a move is never refused. */
  function sendMove(holds: readonly Hold[]): void {
    setHolds(holds);
    if (unanswered.hold === 0) granted = { ...granted, hold: holds };
    const { places } = joined(holds);
    client.send({ type: 'move', places }, [places.buffer]);
    window.clearTimeout(restTimer);
    restTimer = window.setTimeout(rest, REST_AFTER_MS);
  }

  function receiveOpened({ answer, triangles }: Extract<FromDeform, { type: 'opened' }>): void {
    if (!opening) return;
    const { experiment, link, objText } = opening;
    if (experiment.id === OWN) obj = { name: answer.name, text: objText };
    opening = null;
    cloth = asked;
    shown = [];
    taken = null;
    const ownHolds = holdsOf(answer, triangles);
    const { holds, problems } = linkedHolds(ownHolds, answer, link ?? UNMOVED);
    setHolds(holds);
    granted = { show: null, hold: ownHolds };
    store.set({
      phase: 'ready',
      experiment: experiment.id,
      objName: experiment.id === OWN ? answer.name : store.get().objName,
      cloth: answer,
      ownHolds,
      chosenHold: null,
      isDragging: false,
      invited: true,
      problem: link ? linkFailure(problems, store.get().problem) : null,
    });
    view.showMesh(triangles, answer.n_vertices, experiment);
    sendHolds(holds);
    fitOwn();
    sendPanes();
  }

  function receiveFrame({ pane, buffer, report, status, updateMs }: DeformFrame): void {
    const { panes } = store.get();
    const old = shown[pane];
    shown[pane] = buffer;
    if (old) client.send({ type: 'return', cloth, pane, buffer: old }, [old]);
    if (!panes[pane]) return;
    view.showFrame(pane, buffer);
    const nowMs = performance.now();
    if (status === 'dragging' && nowMs - lastNumbersMs < NUMBERS_EVERY_MS) return;
    lastNumbersMs = nowMs;
    const { energy, terms, steps } = report;
    const numbers = { energy, terms, steps, status, updateMs };
    store.set({
      panes: panes.map((one, at): PaneState => (at === pane ? { ...one, ...numbers } : one)),
    });
  }

  /** The own fabric that is shown goes with the measurements in its form. */
  function receiveFitted({ measures, answer }: Extract<FromDeform, { type: 'fitted' }>): void {
    const { compared, panes } = store.get();
    store.set({
      ownFabric: answer,
      compared: compared.map((one) => (one.kind === 'own' ? { ...one, measures } : one)),
    });
    if (panes.some(({ fabric }) => fabric.kind === 'own')) showPanes();
  }

  function receive(message: FromDeform): void {
    switch (message.type) {
      case 'broken':
        return broken(message.reason);
      case 'opened':
        if (message.cloth === asked) receiveOpened(message);
        return;
      case 'frame':
        if (message.cloth === cloth) receiveFrame(message);
        return;
      case 'fitted':
        return receiveFitted(message);
      case 'granted':
        return answered(message.what, true);
      case 'section':
        onShape?.(message);
        return;
      case 'refused': {
        if (message.what === 'open') {
          opening = null;
          store.set({ phase: 'ready' });
        }
        if (message.what !== 'hold' && message.what !== 'show') return refuse(message.failure);
        answered(message.what, false);
        return refuse(undone(message.failure));
      }
    }
  }

  /** Panes for what is to be compared, or for all fabrics. */
  function showPanes(): void {
    const state = store.get();
    const panes = panesFor(state);
    store.set({ panes, chosen: Math.min(state.chosen, panes.length - 1), problem: null });
    if (state.cloth) sendPanes();
  }

  /** Asks for the weights of a visitor's fabric that have not been fitted yet. */
  function fitOwn(): void {
    const { compared, ownFabric } = store.get();
    const own = compared.find((choice) => choice.kind === 'own');
    if (own && !ownFabric) client.send({ type: 'fit', measures: own.measures });
  }

  function rest(): void {
    window.clearTimeout(restTimer);
    client.send({ type: 'rest', isHeld: taken !== null });
  }

  function place(vertex: number, pane: number): Triple {
    const buffer = shown[pane];
    return buffer ? placeOf(frameViews(buffer).positions, vertex) : [0, 0, 0];
  }

  /** A new hold that has `vertex` where it is seen. */
  function newHold(vertex: number, pane: number, kind: Hold['kind']): Hold | null {
    const state = store.get();
    const hold = state.cloth && holdAt(state.cloth, vertex, kind, state.holds);
    if (!hold) return null;
    const [x, y, z] = place(vertex, pane);
    const [bx, by, bz] = baseOf(hold, vertex) ?? [0, 0, 0];
    return { ...hold, offset: [x - bx, y - by, z - bz] };
  }

  function moved(name: string, offset: Triple): Hold[] {
    return store.get().holds.map((hold) => (hold.name === name ? { ...hold, offset } : hold));
  }

  store.subscribe((state, previous) => {
    if (!state.cloth || state.cloth !== previous.cloth) return;
    if (state.form !== previous.form || state.terms !== previous.terms) sendPanes();
    if (state.weightsFrom !== previous.weightsFrom) showPanes();
  });

  return {
    openExperiment(id, link) {
      const known = EXPERIMENTS.find((experiment) => experiment.id === id);
      if (known) return void open({ experiment: known, link: link ?? null, objText: '' });
      if (!obj) return;
      void open({ experiment: ownExperiment(obj.name), link: null, objText: obj.text });
    },
    async openObj(file) {
      const { name } = file;
      if (!/\.obj$/i.test(name))
        return refuse(inputFailure(`${name} is no OBJ file: the name does not end in .obj.`));
      try {
        const text = await file.text();
        await open({ experiment: ownExperiment(name), link: null, objText: text });
      } catch {
        refuse(inputFailure(`${name} could not be read.`));
      }
    },
    grab(vertex, pane) {
      const known = store.get().holds.find((hold) => hold.vertices.includes(vertex));
      const hold = known ?? newHold(vertex, pane, 'handle');
      const base = hold && baseOf(hold, vertex);
      if (!hold || !base) return;
      taken = { name: hold.name, base, isNew: known ? null : hold };
      store.set({ isDragging: true, invited: false, chosenHold: hold.name });
    },
    moveGrab([x, y, z]) {
      if (!taken) return;
      const { name, base, isNew } = taken;
      const offset: Triple = [x - base[0], y - base[1], z - base[2]];
      if (isNew) {
        // A press alone moves nothing, and holds nothing.
        const way = Math.hypot(...offset.map((metres, axis) => metres - (isNew.offset[axis] ?? 0)));
        if (way < 1e-3 * (store.get().cloth?.grasp_m ?? 0)) return;
        setHolds([...store.get().holds, { ...isNew, offset }]);
        taken.isNew = null;
        return sendHolds(store.get().holds);
      }
      sendMove(moved(name, offset));
    },
    releaseGrab() {
      const wasMoved = taken !== null && taken.isNew === null;
      taken = null;
      store.set({ isDragging: false });
      if (!wasMoved) return;
      settle();
      rest();
    },
    togglePin(vertex, pane) {
      const holds = store.get().holds;
      const known = holds.find((hold) => hold.vertices.includes(vertex));
      const pin = known ? null : newHold(vertex, pane, 'pin');
      const others = holds.filter((hold) => hold !== known);
      const next = pin ? [...others, pin] : others;
      setHolds(next);
      store.set({ invited: false, problem: null });
      sendHolds(next);
    },
    release(name) {
      const next = store.get().holds.filter((hold) => hold.name !== name);
      setHolds(next);
      store.set({ problem: null });
      sendHolds(next);
    },
    nudge(name, [x, y, z]) {
      const hold = store.get().holds.find((one) => one.name === name);
      if (!hold) return;
      const [a, b, c] = hold.offset;
      store.set({ invited: false, chosenHold: name });
      sendMove(moved(name, [a + x, b + y, c + z]));
    },
    resetHolds() {
      const { ownHolds } = store.get();
      setHolds(ownHolds);
      store.set({ problem: null, chosenHold: null });
      sendHolds(ownHolds);
    },
    compare({ fabrics: compared, chosen }) {
      store.set({ compared, chosen, gallery: false });
      fitOwn();
      showPanes();
    },
    setGallery(isShown) {
      store.set({ gallery: isShown, chosen: 0 });
      showPanes();
    },
    measure(measures) {
      client.send({ type: 'fit', measures });
    },
    startShape() {
      const { chosen } = store.get();
      return new Promise((resolve) => {
        onShape = resolve;
        client.send({ type: 'section', pane: chosen });
      });
    },
  };
}
