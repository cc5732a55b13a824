// The view of modes: the shapes that a body likes to take, mixed, kept as keys, and what lies between them.
// Its store, its worker, its stage and its panels, wired together.
import '../shared/page/panes.css';
import './modes.css';
import { inputFailure } from '../shared/bindings/answers';
import type { View } from '../shared/page/view';
import { createAnnouncer } from '../shared/panels/announcer';
import { createDropTarget } from '../shared/panels/drop-target';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createInvitation } from '../shared/panels/invitation';
import { objText, save } from '../shared/panels/saving';
import { createStageCanvas, PICTURE_LOST, replaceCanvas } from '../shared/panels/stage-canvas';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store, watch } from '../shared/state/store';
import type { Energy } from './bindings/modal-module';
import { createCompletionCurves } from './panels/completion-curves';
import { columnsFor, createEnergyBadges, type EnergyBadges } from './panels/energy-badges';
import { createModeList } from './panels/mode-list';
import { createModelPanel } from './panels/model-panel';
import { createModesKeys } from './panels/modes-keys';
import { createModesNumbers } from './panels/modes-numbers';
import { modesSentence } from './panels/modes-sentence';
import { createModesTools } from './panels/modes-tools';
import { createShareChart } from './panels/share-chart';
import { createTimelinePanel } from './panels/timeline-panel';
import { createWorkingBar } from './panels/working-bar';
import { KeyEditor } from './run/key-editor';
import { ModesRun } from './run/modes-run';
import { Pull } from './run/pull';
import { shownEnergies } from './run/showing';
import { createModesStage, type ModesStage } from './stage/modes-stage';
import { firstKeys } from './state/key-shapes';
import { enclosedVolume, farthestMove } from './state/mix';
import { decodeModesLink, encodeModesLink } from './state/modes-link';
import { initialModesState, type ModesState } from './state/modes-state';

/** A step of the timeline by a key press, in keys. */
const TIME_STEP = 0.05;

/** Nothing moves unasked where the visitor's system says so. */
function mayMove(): boolean {
  return !window.matchMedia('(prefers-reduced-motion: reduce)').matches;
}

/** What a visitor does, whichever control it is done with. */
class Hands {
  readonly editor: KeyEditor;
  readonly pull: Pull;

  constructor(
    private readonly store: Store<ModesState>,
    private readonly run: ModesRun,
  ) {
    this.editor = new KeyEditor(run);
    this.pull = new Pull(store, run, mayMove);
  }

  togglePlaying(): void {
    const { playing, phase } = this.store.get();
    if (phase === 'ready') this.store.set({ playing: !playing, invited: false });
  }

  toggleShowing(): void {
    const { showing } = this.store.get();
    this.store.set({ showing: showing === 'modes' ? 'keys' : 'modes' });
  }

  /** One mode and no other; it swings at once, unless motion is not wanted. */
  playAlone(mode: number): void {
    if (mode >= (this.store.get().found?.modes.length ?? 0)) return;
    const amplitudes = Array.from({ length: mode + 1 }, (_, at) => (at === mode ? 1 : 0));
    const playing = this.store.get().phase === 'ready' && mayMove();
    this.store.set({ amplitudes, showing: 'modes', playing, invited: false });
  }

  setAmplitude(mode: number, amplitude: number): void {
    const { amplitudes } = this.store.get();
    const length = Math.max(amplitudes.length, mode + 1);
    this.store.set({
      amplitudes: Array.from({ length }, (_, at) =>
        at === mode ? amplitude : (amplitudes[at] ?? 0),
      ),
      showing: 'modes',
    });
  }

  moveTime(by: number): void {
    const { time, keys } = this.store.get();
    const end = Math.max(0, keys.length - 1);
    const next = Math.min(end, Math.max(0, time + by));
    this.store.set({ time: next, playing: false, showing: 'keys' });
  }

  key(name: string): boolean {
    if (name === ' ') this.togglePlaying();
    else if (name === 'm') this.toggleShowing();
    else if (name === 'k') this.editor.keep();
    else if (name === ',') this.moveTime(-TIME_STEP);
    else if (name === '.') this.moveTime(TIME_STEP);
    else if (/^[1-9]$/.test(name)) this.playAlone(Number(name) - 1);
    else return false;
    return true;
  }

  /** The present mix of an energy at its full swing; empty before there is a body. */
  private mixed(energy: Energy): Float64Array {
    const body = this.run.present;
    const positions = new Float64Array(body?.shape.length ?? 0);
    body?.mix(positions, energy, this.store.get().amplitudes);
    return positions;
  }

  move(): number {
    const shape = this.run.present?.shape ?? [];
    return farthestMove(this.mixed(this.store.get().energy), shape);
  }

  /** Volume of the mix over that at rest; null of an open surface. */
  volumeOf(energy: Energy): number | null {
    const body = this.run.present;
    if (!body || !this.store.get().surface?.closed) return null;
    const { triangles, shape } = body;
    return enclosedVolume(this.mixed(energy), triangles) / enclosedVolume(shape, triangles);
  }
}

/** The picture, of one store. */
class Picture {
  stage: ModesStage | null = null;
  private badges: EnergyBadges | null = null;
  private readonly invitation;
  private nPanes = 1;

  constructor(
    private readonly box: HTMLElement,
    private readonly store: Store<ModesState>,
  ) {
    this.invitation = createInvitation(box);
  }

  /** Opens the stage where the browser can draw it. */
  open(canvas: HTMLCanvasElement, hands: Hands): void {
    const { store, box } = this;
    try {
      this.stage = createModesStage(box, canvas, {
        key: (name) => hands.key(name),
        grab: (vertex, pane) => hands.pull.grab(vertex, pane),
        moveGrab: (target) => hands.pull.move(target),
        releaseGrab: () => hands.pull.release(),
        drawn: ({ x, y }) => this.invitation.place(x, y),
        pictureLost(isLost) {
          if (isLost) store.set({ problem: inputFailure(PICTURE_LOST) });
          else if (store.get().problem?.what === PICTURE_LOST) store.set({ problem: null });
        },
      });
    } catch {
      replaceCanvas(canvas, 'The numbers');
    }
    this.badges = createEnergyBadges(box, store, shownEnergies, (energy) => hands.volumeOf(energy));
    new ResizeObserver(() => this.layOut()).observe(box);
    watch(store, ['edges'], ({ edges }) => this.stage?.setEdges(edges));
    watch(store, ['invited', 'phase', 'playing'], ({ invited, phase, playing }) =>
      this.invitation.setShown(invited && phase === 'ready' && !playing),
    );
  }

  setPanes(count: number): void {
    if (count === this.nPanes) return;
    this.nPanes = count;
    this.layOut();
  }

  private layOut(): void {
    const nColumns = columnsFor(this.nPanes, this.box.clientWidth);
    this.stage?.setPanes(this.nPanes, nColumns);
    this.badges?.setColumns(nColumns);
  }
}

/** Modes whose full swings the camera sees; higher ones go no farther. */
const SEEN_MODES = 4;

/** Has the camera see the body, its keys and its full swings. */
function frame(stage: ModesStage, { keys, energy }: ModesState, run: ModesRun): void {
  const body = run.present;
  if (!body) return;
  const places: number[] = [];
  const swing = new Float64Array(body.shape.length);
  for (let mode = 0; mode < SEEN_MODES; ++mode)
    for (const amplitude of [-1, 1]) {
      body.mix(swing, energy, [...new Array<number>(mode).fill(0), amplitude]);
      for (const place of swing) places.push(place);
    }
  stage.frame([...body.shape, ...keys.flatMap(({ positions }) => [...positions])], places);
  stage.invite(body.liveliest(keys, energy));
}

function createPanels(
  panel: HTMLElement,
  store: Store<ModesState>,
  run: ModesRun,
  hands: Hands,
): void {
  createModelPanel(panel, store, {
    openModel(id) {
      store.set({ problem: null });
      run.openModel(id);
    },
    openObj: (file) => void run.openObj(file),
    setUnit: (unit) => run.setUnit(unit),
    setCells: (cells) => void run.reopen({ cells }),
    setVolume: (volume) => void run.reopen({ volume }),
  });
  createModeList(panel, store, {
    setEnergy(energy, compares) {
      store.set({ problem: null });
      void run.setEnergy(energy, compares);
    },
    setCount: (count) => void run.reopen({ count }),
    playAlone: (mode) => hands.playAlone(mode),
    setAmplitude: (mode, amplitude) => hands.setAmplitude(mode, amplitude),
  });
  createShareChart(panel, store);
  createModesKeys(panel);
}

export function createModesView(root: HTMLElement, hash: string): View {
  const first = decodeModesLink(hash);
  const store = createStore(initialModesState(first.link, first.problems));
  let isShown = false;
  const messages = element('div');
  const stageBox = element('section', { class: 'stage', 'aria-label': 'Body' });
  const numbers = element('section', { 'aria-label': 'Numbers' });
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Tools' });
  const timeline = element('section', { class: 'timeline', 'aria-label': 'Timeline' });
  const panel = element('aside', { class: 'panel', 'aria-label': 'Model and modes' });
  const canvas = createStageCanvas(
    stageBox,
    'A body in three dimensions. Space plays, arrows turn the view.',
  );
  root.classList.add('modes');
  root.replaceChildren(
    element('div', { class: 'left' }, messages, stageBox, numbers, toolBox, timeline),
    panel,
  );

  const picture = new Picture(stageBox, store);
  const run = new ModesRun(store, {
    showMesh: (...mesh) => picture.stage?.showMesh(...mesh),
    setPanes: (count) => picture.setPanes(count),
    showShape: (pane, positions) => picture.stage?.showShape(pane, positions),
    showGhost: (positions) => picture.stage?.showGhost(positions),
    framed() {
      if (picture.stage) frame(picture.stage, store.get(), run);
    },
  });
  const hands = new Hands(store, run);
  picture.open(canvas, hands);
  createWorkingBar(stageBox, store, () => run.cancel());
  watch(
    store,
    ['problem', 'phase'],
    createFailureBanner(messages, () => store.set({ problem: null })),
  );
  createAnnouncer(messages, store, modesSentence);
  createModesNumbers(numbers, store, () => hands.move());
  createModesTools(toolBox, store, {
    togglePlaying: () => hands.togglePlaying(),
    homeView: () => picture.stage?.homeView(),
    saveObj() {
      const body = run.present;
      if (!body) return;
      const text = objText(run.shown.positions(0), body.triangles);
      save('pleat-shape.obj', new Blob([text], { type: 'model/obj' }));
    },
  });
  createTimelinePanel(timeline, store, {
    keep: () => hands.editor.keep(),
    replace: () => hands.editor.replace(),
    delete: () => hands.editor.delete(),
    openFiles: (files) => void hands.editor.openFiles(files),
    example: () => void run.setKeys(firstKeys(store.get().model)),
  });
  createCompletionCurves(timeline, store);
  createPanels(panel, store, run, hands);
  createDropTarget(document.body, {
    openObj(file) {
      if (isShown) void run.openObj(file);
    },
  });
  run.openModel(first.link.model, first.link);

  const link = () => `#${encodeModesLink(store.get())}`;
  const writeLink = createLinkWriter(store, link, () => isShown && store.get().surface !== null);
  return {
    link,
    open(newHash) {
      const read = decodeModesLink(newHash);
      const { objName, objUnit, objOdd } = store.get();
      const { problem } = initialModesState(read.link, read.problems);
      store.set({ objName, objUnit, objOdd, problem });
      run.openModel(read.link.model, read.link);
    },
    setShown(value) {
      isShown = value;
      if (!value) store.set({ playing: false });
      writeLink();
    },
    probe: {
      state: () => store.get(),
      positions: (pane = 0) => Array.from(run.shown.positions(pane)),
      project: (vertex: number, pane = 0) => picture.stage?.project(vertex, pane),
      inviting: () => run.present?.liveliest(store.get().keys, store.get().energy) ?? 0,
    },
  };
}
