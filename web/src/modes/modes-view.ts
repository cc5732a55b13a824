// The view of modes: the shapes that a body likes to take, mixed, kept as keys, and what lies between them.
// Its store, its worker, its stage and its panels, wired together.
import '../shared/page/panes.css';
import './modes.css';
import type { View } from '../shared/page/view';
import { createAnnouncer } from '../shared/panels/announcer';
import { createDropTarget } from '../shared/panels/drop-target';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createKeyList, type Keys, VIEW_KEYS } from '../shared/panels/keys-panel';
import { objText, save } from '../shared/panels/saving';
import { createStageCanvas } from '../shared/panels/stage-canvas';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store } from '../shared/state/store';
import { frame, Picture } from './modes-picture';
import { createCompletionCurves } from './panels/completion-curves';
import { createModeList } from './panels/mode-list';
import { createModelPanel } from './panels/model-panel';
import { createModesNumbers } from './panels/modes-numbers';
import { modesSentence } from './panels/modes-sentence';
import { createModesTools } from './panels/modes-tools';
import { createShareChart } from './panels/share-chart';
import { createTimelinePanel } from './panels/timeline-panel';
import { createWorkingBar } from './panels/working-bar';
import { Hands } from './run/hands';
import { ModesRun } from './run/modes-run';
import { firstKeys } from './state/key-shapes';
import { decodeModesLink, encodeModesLink } from './state/modes-link';
import { initialModesState, type ModesState } from './state/modes-state';

const KEYS: Keys = [
  ['Space', 'play or pause'],
  ['M', 'modes or key frames'],
  ['1 to 9', 'that mode alone'],
  [', and .', 'back and on along the keys'],
  ['K', 'keep the mix as a key'],
  ...VIEW_KEYS,
];

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
  createKeyList(panel, KEYS);
}

function createTimeline(
  timeline: HTMLElement,
  store: Store<ModesState>,
  run: ModesRun,
  { editor }: Hands,
): void {
  createTimelinePanel(timeline, store, {
    keep: () => editor.keep(),
    replace: () => editor.replace(),
    delete: () => editor.delete(),
    openFiles: (files) => void editor.openFiles(files),
    example: () => void run.setKeys(firstKeys(store.get().model)),
  });
  createCompletionCurves(timeline, store);
}

function saveShape({ present, shown }: ModesRun): void {
  if (!present) return;
  const text = objText(shown.positions(0), present.triangles);
  save('pleat-shape.obj', new Blob([text], { type: 'model/obj' }));
}

/** The parts of the view, empty. */
function createLayout(root: HTMLElement) {
  const part = (name: string, className = '') =>
    element('section', { class: className, 'aria-label': name });
  const parts = {
    messages: element('div'),
    stageBox: part('Body', 'stage'),
    numbers: part('Numbers'),
    toolBox: part('Tools', 'toolbar'),
    timeline: part('Timeline', 'timeline'),
    panel: element('aside', { class: 'panel', 'aria-label': 'Model and modes' }),
  };
  const { panel, ...left } = parts;
  root.classList.add('modes');
  root.replaceChildren(element('div', { class: 'left' }, ...Object.values(left)), panel);
  return parts;
}

export function createModesView(root: HTMLElement, hash: string): View {
  const first = decodeModesLink(hash);
  const store = createStore(initialModesState(first.link, first.problems));
  let isShown = false;
  const { messages, stageBox, numbers, toolBox, timeline, panel } = createLayout(root);
  const canvas = createStageCanvas(
    stageBox,
    'A body in three dimensions. Space plays, arrows turn the view.',
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
  createFailureBanner(messages, store, () => run.retry());
  createAnnouncer(messages, store, modesSentence);
  createModesNumbers(numbers, store, () => hands.move());
  createModesTools(toolBox, store, {
    togglePlaying: () => hands.togglePlaying(),
    homeView: () => picture.stage?.homeView(),
    saveObj: () => saveShape(run),
  });
  createTimeline(timeline, store, run, hands);
  createPanels(panel, store, run, hands);
  createDropTarget(
    () => isShown,
    (file) => void run.openObj(file),
  );
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
