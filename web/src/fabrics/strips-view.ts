// Fifteen strips over an edge: their store, their worker, their stage and their panel, wired together.
import { fabricNamed, fabrics } from '../shared/fabric/fabric-data';
import { createAnnouncer } from '../shared/panels/announcer';
import { button, element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createKeyList, VIEW_KEYS } from '../shared/panels/keys-panel';
import { openStage } from '../shared/panels/open-stage';
import { createStageCanvas } from '../shared/panels/stage-canvas';
import { createLinkReader } from '../shared/state/link-reader';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, watch } from '../shared/state/store';
import { createStripNames, stripsToAShelf } from './panels/strip-names';
import { createStripsPanel, type StripsActions, stripsAnswer } from './panels/strips-panel';
import { StripRun } from './run/strip-run';
import { createStripsStage, type StripsStage } from './stage/strips-stage';
import { linkFailure } from './state/fabrics-state';
import { LYING_M, OVERHANG_M, WIDTH_M } from './state/strips';
import { initialStripsState, type StripsState, sortedStrips } from './state/strips-state';
import { takeWay } from './state/ways';
import type { Way } from './way';

const LINK = '#view=fabrics&show=strips';

const SIZES = { width: WIDTH_M, lying: LYING_M, hanging: OVERHANG_M };

function problemsIn(hash: string): string[] {
  const reader = createLinkReader(hash, 'fabrics');
  takeWay(reader);
  return reader.finish();
}

function sentenceFor(state: StripsState, previous: StripsState): string | null {
  return state.phase === 'done' && previous.phase !== 'done' ? stripsAnswer(state) : null;
}

/** `left` takes its messages, stage and tools; `move` shows a fabric beside another in motion. */
export function createStripsView(
  left: HTMLElement,
  panel: HTMLElement,
  hash: string,
  { move }: Pick<StripsActions, 'move'>,
): Way {
  const store = createStore(initialStripsState());
  let isShown = false;
  let isResting = false; // stopped while another view is shown
  let stage: StripsStage | null = null;
  const messages = element('div');
  const stageBox = element('section', { class: 'stage strips', 'aria-label': 'Strips of cloth' });
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Tools' });
  left.append(messages, stageBox, toolBox);
  const canvas = createStageCanvas(
    stageBox,
    'Strips of fifteen fabrics over an edge. Arrows turn the view.',
  );
  const run = new StripRun(store, {
    showStrip: (name, start) => stage?.showStrip(name, fabricNamed(name).id, start),
    showFrame: (name, buffer) => stage?.showFrame(name, buffer),
  });
  const names = createStripNames(stageBox, store);

  function arrange(): void {
    const { clientWidth, clientHeight } = stageBox;
    if (clientWidth === 0 || clientHeight === 0) return;
    const nToAShelf = stripsToAShelf(clientWidth, clientHeight, fabrics.length);
    stage?.arrange(sortedStrips(store.get()), nToAShelf);
  }

  stage = openStage(canvas, store, (pictureLost) =>
    createStripsStage(stageBox, canvas, SIZES, {
      drawn: names.place,
      key: () => false,
      pictureLost,
    }),
  );
  new ResizeObserver(() => {
    stage?.refit();
    arrange();
  }).observe(stageBox);
  watch(store, ['droops'], arrange);
  createFailureBanner(messages, store);
  createAnnouncer(messages, store, sentenceFor);
  toolBox.append(
    button('View', () => stage?.homeView(), {
      title: 'Look from the first direction again (Home)',
    }),
  );
  createStripsPanel(panel, store, { go: () => run.go(), stop: () => run.stop(), move });
  createKeyList(panel, VIEW_KEYS);
  store.set({ problem: linkFailure(problemsIn(hash), null) });
  run.go();

  const writeLink = createLinkWriter(
    store,
    () => LINK,
    () => isShown,
  );
  return {
    link: () => LINK,
    open: (newHash) => store.set({ problem: linkFailure(problemsIn(newHash), null) }),
    setShown(value) {
      isShown = value;
      if (value && isResting) run.go();
      isResting = !value && store.get().phase === 'running';
      if (isResting) run.stop();
      writeLink();
    },
    probe: {
      state: () => ({ ...store.get(), sorted: sortedStrips(store.get()) }),
      positions: (place = 0) =>
        Array.from(stage?.positions(sortedStrips(store.get())[place] ?? '') ?? []),
    },
  };
}
