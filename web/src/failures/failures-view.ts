// The view of failures: one hard case by a naive method and by one that holds. Its store, its two workers,
// its stage and its panels, wired together.
import type { View } from '../shared/page/view';
import '../shared/page/panes.css';
import './failures.css';
import { frameViews } from '../shared/bindings/frame';
import { fabricNamed } from '../shared/fabric/fabric-data';
import { createAnnouncer } from '../shared/panels/announcer';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createKeyList, HAND_KEYS } from '../shared/panels/keys-panel';
import { openStage } from '../shared/panels/open-stage';
import { createStageCanvas } from '../shared/panels/stage-canvas';
import type { HeldStageEvents } from '../shared/stage/held-stage';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store, watch } from '../shared/state/store';
import { createCaseList } from './panels/case-list';
import { createCaseStory } from './panels/case-story';
import { createDuelTools } from './panels/duel-tools';
import { createSideBadges } from './panels/side-badges';
import { spokenSign } from './panels/sign-words';
import { Duel, type DuelView } from './run/duel';
import { createDuelStage, type DuelStage } from './stage/duel-stage';
import { decodeFailuresLink, encodeFailuresLink } from './state/failures-link';
import { type FailuresState, initialFailuresState } from './state/failures-state';

/** Panes narrower than this stand one above the other [CSS pixels]. */
const LEAST_PANE_WIDTH = 240;

/** The cloth of all cases has one colour, whatever it is made of. */
const SHOWN_FABRIC = 'fine cotton';

/** Who only looks sees the first case when it has failed [s]. */
const FIRST_SHOWN_S = 1;

/** The parts of the view, empty. */
function createLayout(root: HTMLElement) {
  const part = (name: string, className = '') =>
    element('section', { class: className, 'aria-label': name });
  const parts = {
    messages: element('div'),
    badges: part('Naive and ours', 'side-badges'),
    stageBox: part('Both cloths', 'stage'),
    toolBox: part('Run', 'toolbar'),
    panel: element('aside', { class: 'panel', 'aria-label': 'Cases' }),
  };
  const { panel, ...left } = parts;
  root.replaceChildren(element('div', { class: 'left' }, ...Object.values(left)), panel);
  return parts;
}

/** The stage, where the browser can draw it; its buffers go back to the runs. */
class Picture implements DuelView {
  private stage: DuelStage | null = null;
  private readonly shown: (ArrayBuffer | null)[] = [null, null];

  open(
    { stageBox, badges }: { stageBox: HTMLElement; badges: HTMLElement },
    canvas: HTMLCanvasElement,
    store: Store<FailuresState>,
    events: Omit<HeldStageEvents, 'pictureLost'>,
  ): void {
    const stage = openStage(canvas, store, (pictureLost) =>
      createDuelStage(stageBox, canvas, { ...events, pictureLost }),
    );
    this.stage = stage;
    if (!stage) return;
    stage.setFabric(fabricNamed(SHOWN_FABRIC).id);
    watch(store, ['edges'], ({ edges }) => stage.setEdges(edges));
    new ResizeObserver(() => {
      const nColumns = stageBox.clientWidth < 2 * LEAST_PANE_WIDTH ? 1 : 2;
      badges.style.setProperty('--columns', String(nColumns));
      stage.setColumns(nColumns);
    }).observe(stageBox);
  }

  showMesh: DuelView['showMesh'] = (pane, mesh) => {
    this.shown[pane] = null;
    this.stage?.showMesh(pane, mesh);
  };

  showFrame(pane: number, buffer: ArrayBuffer): ArrayBuffer | null {
    const before = this.shown[pane] ?? null;
    this.shown[pane] = buffer;
    this.stage?.showFrame(pane, buffer);
    return before;
  }

  setColliders: DuelView['setColliders'] = (colliders) => this.stage?.setColliders(colliders);
  frame: DuelView['frame'] = (colliders) => this.stage?.frame(colliders);
  follow: DuelView['follow'] = (pane) => this.stage?.follow(pane);
  homeView = () => this.stage?.homeView();
  project = (vertex: number, pane?: number) => this.stage?.project(vertex, pane);

  positions(pane: number): number[] {
    const buffer = this.shown[pane];
    return buffer ? Array.from(frameViews(buffer).positions) : [];
  }
}

export function createFailuresView(root: HTMLElement, hash: string): View {
  const first = decodeFailuresLink(hash);
  const store = createStore(initialFailuresState(first.caseId, first.problems));
  let isShown = false;
  const { messages, badges, stageBox, toolBox, panel } = createLayout(root);
  const canvas = createStageCanvas(
    stageBox,
    'A cloth by a naive method, and beside it by one that holds. Space plays, G takes the cloth, arrows turn the view.',
  );
  const picture = new Picture();
  const duel = new Duel(store, picture);
  const toggle = () => (store.get().playing ? duel.pause() : duel.play());
  const keys: Record<string, () => void> = {
    ' ': toggle,
    '.': () => duel.step(),
    r: () => void duel.reset(),
  };
  picture.open({ stageBox, badges }, canvas, store, {
    grab: (vertex, pane) => duel.grab(vertex, pane),
    moveGrab: (target) => duel.moveGrab(target),
    releaseGrab: () => duel.releaseGrab(),
    key(name) {
      keys[name]?.();
      return name in keys;
    },
  });
  if (!first.isNamed) void duel.showAt(FIRST_SHOWN_S);
  createFailureBanner(messages, store, () => duel.retry());
  createAnnouncer(messages, store, spokenSign);
  createSideBadges(badges, store);
  createDuelTools(toolBox, store, duel, picture.homeView);
  createCaseList(panel, store);
  createCaseStory(panel, store);
  createKeyList(panel, HAND_KEYS);

  const link = () => `#${encodeFailuresLink(store.get())}`;
  const writeLink = createLinkWriter(store, link, () => isShown);
  return {
    link,
    open(newHash) {
      const { caseId, problems } = decodeFailuresLink(newHash);
      const { problem } = initialFailuresState(caseId, problems);
      store.set({ caseId, problem });
    },
    setShown(value) {
      isShown = value;
      if (!value) duel.pause();
      writeLink();
    },
    probe: {
      state: () => store.get(),
      positions: (pane = 0) => picture.positions(pane),
      project: (vertex: number, pane = 0) => picture.project(vertex, pane),
    },
  };
}
