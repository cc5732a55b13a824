// Runs the view of modes: turns what a visitor does into questions to the worker, and answers into state.
import { describe, type Failure, inputFailure } from '../../shared/bindings/answers';
import { brokenFailure } from '../../shared/bindings/refusals';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { fetched } from '../../shared/page/fetched';
import { Latest } from '../../shared/state/latest';
import {
  type ObjFile,
  type ObjUnit,
  type OwnMesh,
  openObjFile,
  ownMeshState,
  textInMetres,
} from '../../shared/state/obj-file';
import type { Store } from '../../shared/state/store';
import { answerOf } from '../../shared/workers/asked';
import { Renewed } from '../../shared/workers/renewed';
import { endedSentence } from '../../shared/workers/restarts';
import type { Energy } from '../bindings/modal-module';
import { DRAPE_FRAMES, DRAPE_FRAMES_PER_S, type KeyOrigin, remade } from '../state/key-shapes';
import { BAR_SIDES_M, modelOf, OWN } from '../state/models';
import { energiesOf, type ModesLink, type ModesState, usualLink } from '../state/modes-state';
import type { ModalAnswers, Opened, OpenedMessage, ToModal } from '../worker/modal-protocol';
import { Body } from './body';
import { KeyWork } from './key-work';
import { type StartModal, startModalWorker } from './modal-client';
import { ModeFinder } from './mode-finder';
import { type ShapeView, Showing } from './showing';
import { noticed } from './slow-work';

/** Steps of 1/60 s of the draping cloth's run between two frames that are kept. */
const STEPS_EACH = 60 / DRAPE_FRAMES_PER_S;

/** Linen, for the visitor's mesh. */
const OWN_LOOK_ID = 3;

export interface ModesRunView extends ShapeView {
  /** Another body; its shapes follow. */
  showMesh(triangles: Uint32Array, nVertices: number, lookId: number): void;
  /** Everything is there: the camera may look at it. */
  framed(): void;
}

/** A model that can be opened. */
interface Wanted {
  link: ModesLink;
  /** The visitor's mesh, if it is of that. */
  own: OwnMesh | null;
}

/** The failure with the file that it is of. */
function named(failure: Failure, { name }: ObjFile): Failure {
  const where = failure.where ? `${name}: ${failure.where}` : name;
  return { ...failure, where };
}

export class ModesRun {
  readonly finder: ModeFinder;
  readonly keyWork: KeyWork;
  readonly shown: Showing;
  private readonly client: Renewed<ToModal, ModalAnswers>;
  private body: Body | null = null;
  private own: OwnMesh | null = null;
  private wanted: Wanted | null = null; // the newest
  private last: Wanted | null = null; // the last one that had its modes
  private readonly latest = new Latest(); // opening

  constructor(
    readonly store: Store<ModesState>,
    private readonly view: ModesRunView,
    start: StartModal = startModalWorker,
  ) {
    this.client = new Renewed<ToModal, ModalAnswers>(start, {
      renewed: (reason) => this.startAgain(reason),
      lost: (reason, hasWorked) => this.breakDown(reason, hasWorked),
    });
    const refuse = (failure: Failure) => this.refuse(failure);
    this.finder = new ModeFinder(store, this.client, refuse);
    this.keyWork = new KeyWork(store, this.client, refuse);
    this.shown = new Showing(store, view);
  }

  get present(): Body | null {
    return this.body;
  }

  /** A model by its id, as it is by itself or as a link has it. */
  openModel(id: string, link: ModesLink = this.kept(usualLink(id))): void {
    if (id !== OWN) return void this.open({ link, own: null });
    if (this.own) void this.open({ link, own: this.own });
  }

  async openObj(file: File): Promise<void> {
    const read = await openObjFile(file);
    if (typeof read === 'string') return this.refuse(inputFailure(read));
    this.store.set({ problem: null });
    void this.open({ link: this.kept(usualLink(OWN)), own: { file: read, unit: 'm' } });
  }

  setUnit(unit: ObjUnit): void {
    if (this.own) void this.open({ link: this.kept(usualLink(OWN)), own: { ...this.own, unit } });
  }

  /**
   * Opens the present body cut otherwise, or in another volume: its modes and in-betweens are found anew. Where
   * that cannot be, it is as it was.
   */
  async reopen(changes: Partial<Pick<ModesLink, 'cells' | 'volume' | 'count'>>): Promise<void> {
    const { link, own } = this.now();
    this.store.set({ problem: null });
    await this.open({ link: { ...link, ...changes }, own });
    const { found, problem } = this.store.get();
    if (found || !problem) return;
    await this.open({ link, own });
    this.store.set({ problem });
  }

  /** True once the modes of that energy are shown. */
  async setEnergy(energy: Energy, compares: boolean): Promise<boolean> {
    const { body } = this;
    if (!body || !(await this.finder.ensure(body, energy))) return false;
    if (compares && !(await this.finder.ensure(body, 'surface'))) return false;
    if (body !== this.body) return false;
    this.store.set({ energy, compares, found: this.finder.found(energy) });
    return true;
  }

  /** Gives up what takes long: keys that cannot be filled in between, or a body whose modes are not there yet. */
  cancel(): void {
    if (this.store.get().working === null) return;
    const again = this.lastGood();
    this.client.replace();
    this.store.set({ working: null });
    void this.open(again);
  }

  /** Opens by another worker what could not be opened. */
  retry(): void {
    void this.open(this.lastGood());
  }

  refuse(failure: Failure): void {
    this.store.set({ problem: failure });
  }

  /** Keys that can be made again, of the present body; modes that they need are found first. */
  async setKeys(origins: readonly KeyOrigin[]): Promise<void> {
    const { body } = this;
    if (!body) return;
    for (const origin of origins)
      if (origin.kind === 'mix' && !(await this.finder.ensure(body, origin.energy))) return;
    if (body !== this.body) return;
    const keys = origins.flatMap((origin) => (origin.kind === 'file' ? [] : body.key(origin)));
    const { time } = this.store.get();
    this.store.set({ keys, chosenKey: 0, time: Math.min(time, Math.max(0, keys.length - 1)) });
    await this.keyWork.update(body);
  }

  /** The places of a key in a file, in the unit of the model; null when it is none of it, which is told. */
  async keyFrom(file: ObjFile): Promise<Float64Array | null> {
    const text = textInMetres(file, this.store.get().objUnit);
    const question = this.client.ask({ type: 'key', text });
    const answer = await answerOf(question, (failure) => this.refuse(named(failure, file)));
    return answer?.positions ?? null;
  }

  /** The worker has a successor, which opens what the other one had. */
  private startAgain(reason: string): void {
    const again = this.lastGood();
    const sentence = `${endedSentence(reason)} It was started again.`;
    this.store.set({ working: null, problem: inputFailure(sentence) });
    void this.open(again);
  }

  private breakDown(reason: string, hasWorked: boolean): void {
    const problem = hasWorked
      ? inputFailure(`${endedSentence(reason)} That happened twice.`)
      : brokenFailure('Modes', reason);
    this.store.set({ phase: 'broken', playing: false, working: null, problem });
  }

  /** A link with the settings that stay from one model to the next. */
  private kept(link: ModesLink): ModesLink {
    const { count, ghost, edges, showing } = this.store.get();
    return { ...link, count, ghost, edges, showing };
  }

  /** The shown model, with the keys that can be made again. */
  private now(): Wanted {
    const state = this.store.get();
    const { model, cells, volume, energy, compares, count, amplitudes } = state;
    const { showing, time, ghost, edges } = state;
    const keys = remade(state.keys);
    const shown = { model, cells, volume, energy, compares, count, amplitudes };
    return {
      link: { ...shown, showing, time, ghost, edges, keys },
      own: model === OWN ? this.own : null,
    };
  }

  /** The shown model with the keys that its worker knew, or the last one that had its modes. */
  private lastGood(): Wanted {
    if (!this.body && this.wanted) return this.wanted;
    const now = this.now();
    const keys = this.keyWork.known();
    const isFound = this.store.get().found !== null;
    return isFound || !this.last ? { ...now, link: { ...now.link, keys } } : this.last;
  }

  private async textOf({ link, own }: Wanted): Promise<Opened> {
    const source = modelOf(link.model)?.source;
    if (!source) return { kind: 'obj', text: own ? textInMetres(own.file, own.unit) : '' };
    switch (source.kind) {
      case 'box':
        return { kind: 'box', text: JSON.stringify({ sides_m: BAR_SIDES_M, cells: link.cells }) };
      case 'obj':
        return { kind: 'obj', text: await (await fetched(source.url)).text() };
      case 'scene': {
        const frames = source.drapes ? DRAPE_FRAMES : 0;
        return { kind: 'scene', text: source.text, frames, stepsEach: STEPS_EACH };
      }
    }
  }

  private async open(wanted: Wanted): Promise<void> {
    const { link, own } = wanted;
    const isCurrent = this.latest.start();
    const before = this.now();
    const isOther = !this.body || before.link.model !== link.model || before.own !== own;
    const { found, phase } = this.store.get();
    if (found) this.last = before;
    this.wanted = wanted;
    if (phase === 'broken') {
      this.client.replace();
      this.store.set({ problem: null });
    }
    this.store.set({ phase: 'loading', playing: false });
    const refuse = (failure: Failure) => {
      const problem = own ? named(failure, own.file) : failure;
      if (isCurrent()) this.store.set({ phase: 'ready', problem });
    };
    let text: Opened;
    try {
      text = await this.textOf(wanted);
    } catch (error) {
      return refuse(inputFailure(`The mesh could not be fetched: ${describe(error)}.`));
    }
    if (!isCurrent()) return;
    const question = this.client.ask({ type: 'open', fabricsText, opened: text });
    const words = own ? `Reading ${own.file.name}` : 'Making the body';
    const opened = await noticed(this.store, words, answerOf(question, refuse));
    if (!opened || !isCurrent()) return;
    const body = this.take(opened, wanted);
    await this.fill(body, link);
    if (!isCurrent()) return;
    if (this.store.get().phase === 'loading') this.store.set({ phase: 'ready' });
    if (this.store.get().found) this.client.prove();
    if (isOther) this.view.framed();
  }

  /** The answer becomes the body that is shown, still without modes. */
  private take(opened: OpenedMessage, { link, own }: Wanted): Body {
    const body = new Body(opened);
    this.body = body;
    if (own) this.own = own;
    this.finder.forget(body);
    this.keyWork.forget();
    this.shown.take(body);
    const lookId = modelOf(link.model)?.lookId ?? OWN_LOOK_ID;
    this.view.showMesh(opened.triangles, body.nVertices, lookId);
    const { keys: _, ...shown } = link;
    this.store.set({
      ...shown,
      ...(own && ownMeshState(own)),
      surface: opened.answer,
      found: null,
      keys: [],
      chosenKey: 0,
      completion: null,
      drapeShares: null,
    });
    this.shown.draw();
    return body;
  }

  private async fill(body: Body, link: ModesLink): Promise<void> {
    const { energy, compares, count, keys } = link;
    const usual = energiesOf(link.model).includes(energy) ? energy : 'volume';
    if (!(await this.setEnergy(usual, compares))) return;
    if (keys.length > 0) await this.setKeys(keys);
    if (body !== this.body || body.drape.length === 0) return;
    const question = this.client.ask({ type: 'drapeShares', drape: body.drape, count });
    const answer = await answerOf(question, (failure) => this.refuse(failure));
    if (answer && body === this.body) this.store.set({ drapeShares: answer.shares });
  }
}
