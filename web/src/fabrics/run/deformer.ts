// Finds the shapes that the view of fabrics shows: turns changes of the state and of the hand into
// questions to the worker, and answers into state and frames.

import { describe, type Failure, inputFailure } from '../../shared/bindings/answers';
import { frameViews } from '../../shared/bindings/frame';
import type { Triple } from '../../shared/bindings/geometry';
import { brokenFailure } from '../../shared/bindings/refusals';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { fetched } from '../../shared/page/fetched';
import type { StartShape } from '../../shared/page/view';
import { createClock } from '../../shared/state/clock';
import { Latest } from '../../shared/state/latest';
import {
  type ObjUnit,
  type OwnMesh,
  openObjFile,
  ownMeshState,
  textInMetres,
} from '../../shared/state/obj-file';
import type { Store } from '../../shared/state/store';
import { placeOf } from '../../shared/state/vectors';
import { answerOf } from '../../shared/workers/asked';
import { endedSentence, Restarts } from '../../shared/workers/restarts';
import type { TermNumbers } from '../bindings/deform-module';
import type { PaneState } from '../state/deform-state';
import { easedShape, easedWords, type RestEdges, reachOf, restEdges } from '../state/edge-reach';
import { EXPERIMENTS, type Experiment, ownExperiment } from '../state/experiments';
import { type Comparison, titleOf } from '../state/fabric-choice';
import type { FabricOrder } from '../state/fabric-order';
import { decodeFabricsLink, encodeFabricsLink, linkedHolds } from '../state/fabrics-link';
import {
  countedWeights,
  type FabricsLink,
  type FabricsState,
  linkFailure,
  panesFor,
  settlingPanes,
} from '../state/fabrics-state';
import { holdsOf } from '../state/holds';
import type {
  DeformFrame,
  FittedMessage,
  FromDeform,
  OpenedMessage,
} from '../worker/deform-protocol';
import { type DeformClient, type StartDeform, startDeformWorker } from './deform-client';
import { Hand } from './hand';
import { HeldCloth, undone } from './held-cloth';
import { LastGranted } from './last-granted';

/** Numbers of a cloth that is being pulled are shown this often [ms]: faster cannot be read. */
const NUMBERS_EVERY_MS = 150;

export interface DeformerView {
  /** Another cloth; its frames follow. */
  showMesh(triangles: Uint32Array, nVertices: number, experiment: Experiment): void;
  /** The buffer stays valid until the next one of that pane. */
  showFrame(pane: number, buffer: ArrayBuffer): void;
}

/** A cloth on its way to be shown. */
interface Opening {
  experiment: Experiment;
  link: FabricsLink | null;
  /** The visitor's mesh, if it is of that. */
  own: OwnMesh | null;
}

type Shown = Pick<
  FabricsState,
  'compared' | 'gallery' | 'order' | 'chosen' | 'terms' | 'form' | 'weightsFrom'
>;

function shownOf(state: FabricsState): Shown {
  const { compared, gallery, order, chosen, terms, form, weightsFrom } = state;
  return { compared, gallery, order, chosen, terms, form, weightsFrom };
}

const ALL_TERMS = { recovery: true, stretch: true, bending: true };

/** How a cloth is held that comes without a link. */
const UNMOVED: Pick<FabricsLink, 'moved' | 'released'> = { moved: [], released: [] };

/** Words after each end in a row, and after one more. */
const AFTER_END = [
  'It was started again, with the cloth held as it was.',
  'That happened twice: it was started again, with the cloth held as at first.',
];
const GIVEN_UP = 'That happened three times in a row. Reload the page to try once more.';

async function meshText({ experiment, own }: Opening): Promise<string> {
  if (own) return textInMetres(own.file, own.unit);
  return experiment.meshUrl === null ? '' : (await fetched(experiment.meshUrl)).text();
}

export class Deformer {
  private client: DeformClient;
  private readonly held: HeldCloth;
  readonly hand: Hand;
  private readonly granted = new LastGranted<Shown | null>(null);
  private readonly latest = new Latest(); // opening
  private cloth = -1; // the one that is shown
  private shown: (ArrayBuffer | undefined)[] = []; // frame of each pane
  private readonly clock = createClock();
  private obj: OwnMesh | null = null; // the visitor's, as it was opened last
  private readonly restarts = new Restarts();
  private isOpen = false; // the worker has a cloth
  private edges: RestEdges | null = null; // edges of the shown cloth at rest

  constructor(
    private readonly store: Store<FabricsState>,
    private readonly view: DeformerView,
    private readonly start: StartDeform = startDeformWorker,
  ) {
    this.client = this.startClient();
    this.hand = new Hand(
      store,
      () => this.held,
      (vertex, pane) => this.place(vertex, pane),
    );
    this.held = new HeldCloth(
      store,
      () => (this.isOpen ? this.client : null),
      () => this.hand.hasTaken(),
    );
    store.subscribe((state, previous) => {
      if (!state.cloth || state.cloth !== previous.cloth) return;
      if (state.form !== previous.form || state.terms !== previous.terms) this.sendPanes();
      if (state.weightsFrom !== previous.weightsFrom) this.showPanes();
    });
  }

  /** An experiment by its id, as it is by itself or as a link has it. */
  openExperiment(id: string, link?: FabricsLink): void {
    const known = EXPERIMENTS.find((experiment) => experiment.id === id);
    if (known) return void this.open({ experiment: known, link: link ?? null, own: null });
    if (this.obj) this.openOwn(this.obj, link ?? null);
  }

  async openObj(file: File): Promise<void> {
    const read = await openObjFile(file);
    if (typeof read === 'string') this.refuse(inputFailure(read));
    else this.openOwn({ file: read, unit: 'm' });
  }

  /** Takes the visitor's file in another unit. */
  setUnit(unit: ObjUnit): void {
    if (this.obj) this.openOwn({ ...this.obj, unit });
  }

  /** Gives up the file that is being read: what was shown before is shown again. */
  cancel(): void {
    if (this.store.get().reading === null) return;
    this.replaceClient();
    this.openAgain();
  }

  release(name: string): void {
    this.store.set({ problem: null });
    this.held.set(this.held.holds().filter((hold) => hold.name !== name));
  }

  /** Moves one hold by so much [m]. */
  nudge(name: string, [x, y, z]: Triple): void {
    const hold = this.held.holds().find((one) => one.name === name);
    if (!hold) return;
    const [a, b, c] = hold.offset;
    this.store.set({ invited: false, chosenHold: name });
    this.held.move(name, [a + x, b + y, c + z]);
  }

  /** Everything as the experiment has it. */
  resetHolds(): void {
    this.store.set({ problem: null, chosenHold: null });
    this.held.set(this.store.get().ownHolds);
  }

  compare({ fabrics: compared, chosen }: Comparison): void {
    this.store.set({ compared, chosen, gallery: false });
    this.fitOwn();
    this.showPanes();
  }

  setGallery(isShown: boolean): void {
    this.store.set({ gallery: isShown, chosen: 0 });
    this.showPanes();
  }

  /** All fabrics in another order; the chosen one stays chosen. */
  setOrder(order: FabricOrder): void {
    const { panes, chosen, gallery } = this.store.get();
    this.store.set({ order });
    if (!gallery) return;
    const title = (pane: PaneState | undefined) => pane && titleOf(pane.fabric);
    const wanted = title(panes[chosen]);
    const at = panesFor(this.store.get()).findIndex((pane) => title(pane) === wanted);
    this.store.set({ chosen: Math.max(0, at) });
    this.showPanes();
  }

  /** Asks for the weights of a visitor's own measurements. */
  measure(measures: TermNumbers): void {
    const question = answerOf(this.client.ask({ type: 'fit', measures }), (failure) =>
      this.refuse(failure),
    );
    void question.then((answer) => answer && this.receiveFitted(answer));
  }

  /** The shape of the chosen pane, as far as cloth bears it, to start a motion from; null when it cannot be told. */
  async startShape(): Promise<StartShape | null> {
    const { edges } = this;
    const question = this.client.ask({ type: 'section', pane: this.store.get().chosen });
    const answer = await answerOf(question, (failure) => this.refuse(failure));
    if (!answer || !edges) return null;
    const { section, positions } = answer;
    const reach = reachOf(edges, positions);
    const name = ['The pulled cloth', easedWords(reach)].filter((part) => part !== '').join(', ');
    return { name, section, positions: easedShape(edges.rest, positions, reach.share) };
  }

  private replaceClient(): void {
    this.client.terminate();
    this.client = this.startClient();
    this.isOpen = false;
    this.hand.drop();
    this.held.drop();
    this.store.set({ reading: null, isDragging: false });
  }

  /** Opens what is shown, held as it is or otherwise. */
  private openAgain(held: Partial<typeof UNMOVED> = {}): void {
    const state = this.store.get();
    const { link } = decodeFabricsLink(encodeFabricsLink(state));
    this.openExperiment(state.experiment, { ...link, ...held });
  }

  /** The worker is gone: another one shows the same once, then the same held as at first, and then none. */
  private breakDown(reason: string): void {
    const nEnds = this.restarts.noteEnd();
    if (nEnds === 0) {
      const problem = brokenFailure('The shapes', reason);
      return this.store.set({ phase: 'broken', problem });
    }
    const after = AFTER_END[nEnds - 1];
    const problem = inputFailure(`${endedSentence(reason)} ${after ?? GIVEN_UP}`);
    this.store.set({ problem });
    if (after === undefined) return this.store.set({ phase: 'broken' });
    this.replaceClient();
    this.openAgain(nEnds === 1 ? {} : UNMOVED);
  }

  private refuse(failure: Failure): void {
    this.store.set({ problem: failure });
  }

  private hear(message: FromDeform): void {
    if (message.type === 'frame' && message.cloth === this.cloth) this.receiveFrame(message);
    if (message.type === 'refused') this.refuse(message.failure);
  }

  private startClient(): DeformClient {
    return this.start({
      news: (message) => this.hear(message),
      broken: (reason) => this.breakDown(reason),
    });
  }

  private openOwn(own: OwnMesh, link: FabricsLink | null = null): void {
    const { name } = own.file;
    this.store.set({ reading: name });
    void this.open({ experiment: ownExperiment(name), link, own });
  }

  private async open(wanted: Opening): Promise<void> {
    const isCurrent = this.latest.start();
    const cloth = this.latest.nStarted;
    this.store.set({ phase: 'loading' });
    let reason = '';
    const objText = await meshText(wanted).catch((error) => {
      reason = describe(error);
      return null;
    });
    if (!isCurrent()) return;
    const refuse = (failure: Failure) => {
      if (isCurrent()) this.store.set({ phase: 'ready', reading: null });
      this.refuse(failure);
    };
    if (objText === null) return refuse(inputFailure(`The mesh could not be fetched: ${reason}.`));
    const { text: sceneText } = wanted.experiment;
    const question = { type: 'open', cloth, fabricsText, sceneText, objText } as const;
    const opened = await answerOf(this.client.ask(question), refuse);
    if (opened && isCurrent()) this.receiveOpened(opened, wanted);
  }

  private receiveOpened({ cloth, answer, triangles }: OpenedMessage, opening: Opening): void {
    const { experiment, link, own } = opening;
    if (own) this.obj = own;
    this.cloth = cloth;
    this.isOpen = true;
    this.edges = restEdges(triangles, answer.rest_m);
    this.restarts.noteStart();
    this.shown = [];
    this.hand.drop();
    const ownHolds = holdsOf(answer, triangles);
    const { holds, problems } = linkedHolds(ownHolds, answer, link ?? UNMOVED);
    this.held.open(ownHolds, holds);
    this.granted.value = null;
    this.store.set({
      phase: 'ready',
      experiment: experiment.id,
      ...(own ? ownMeshState(own) : {}),
      reading: null,
      cloth: answer,
      ownHolds,
      chosenHold: null,
      isDragging: false,
      invited: true,
      problem: link ? linkFailure(problems, this.store.get().problem) : null,
    });
    this.view.showMesh(triangles, answer.n_vertices, experiment);
    this.held.send();
    this.fitOwn();
    this.sendPanes();
  }

  private receiveFrame({ cloth, pane, buffer, report, status, updateMs }: DeformFrame): void {
    const { panes } = this.store.get();
    const old = this.shown[pane];
    this.shown[pane] = buffer;
    if (old) this.client.tell({ type: 'return', cloth, pane, buffer: old }, [old]);
    if (!panes[pane]) return;
    this.view.showFrame(pane, buffer);
    if (!this.clock.areNumbersDue(NUMBERS_EVERY_MS, status !== 'dragging')) return;
    const { energy, terms, steps } = report;
    const isFound = status === 'converged' || status === 'not_converged';
    if (isFound) this.restarts.noteWork();
    const reach = isFound && this.edges ? reachOf(this.edges, frameViews(buffer).positions) : null;
    const numbers = { energy, terms, steps, status, updateMs, reach };
    this.store.set({
      panes: panes.map((one, at): PaneState => (at === pane ? { ...one, ...numbers } : one)),
    });
  }

  /** The own fabric that is shown goes with the measurements in its form. */
  private receiveFitted({ measures, answer }: FittedMessage): void {
    const { compared, panes } = this.store.get();
    this.store.set({
      ownFabric: answer,
      compared: compared.map((one) => (one.kind === 'own' ? { ...one, measures } : one)),
    });
    if (panes.some(({ fabric }) => fabric.kind === 'own')) this.showPanes();
  }

  /** Panes for what is to be compared, or for all fabrics. */
  private showPanes(): void {
    const state = this.store.get();
    const panes = panesFor(state);
    this.store.set({ panes, chosen: Math.min(state.chosen, panes.length - 1), problem: null });
    if (state.cloth) this.sendPanes();
  }

  private sendPanes(): void {
    const { store } = this;
    // Numbers that are shown are of what was before, until new ones come.
    store.set({ panes: settlingPanes(store.get().panes) });
    if (!this.isOpen) return;
    const { panes, terms, form } = store.get();
    const weights = panes.map((pane) => countedWeights(pane, terms));
    const asked = this.granted.ask(this.client.ask({ type: 'show', form, weights }), {
      granted: () => shownOf(store.get()),
      refused: () => this.undoPanes(),
    });
    void answerOf(asked, (failure) => this.refuse(undone(failure)));
  }

  /** Goes back to what could be shown; when nothing could yet, to all terms. */
  private undoPanes(): void {
    const state = this.store.get();
    const last = this.granted.value ?? { ...shownOf(state), terms: ALL_TERMS };
    if (JSON.stringify(last) === JSON.stringify(shownOf(state))) return;
    this.store.set(last);
    this.showPanes();
  }

  /** Asks for the weights of a visitor's fabric that have not been fitted yet. */
  private fitOwn(): void {
    const { compared, ownFabric } = this.store.get();
    const own = compared.find((choice) => choice.kind === 'own');
    if (own && !ownFabric) this.measure(own.measures);
  }

  private place(vertex: number, pane: number): Triple {
    const buffer = this.shown[pane];
    return buffer ? placeOf(frameViews(buffer).positions, vertex) : [0, 0, 0];
  }
}
