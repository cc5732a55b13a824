// Two fabrics side by side in motion, in step: their store, their workers, their stage and their panel.
import { frameViews } from '../shared/bindings/frame';
import { fabricNamed } from '../shared/fabric/fabric-data';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createInvitation } from '../shared/panels/invitation';
import { createKeyList, HAND_KEYS } from '../shared/panels/keys-panel';
import { openStage } from '../shared/panels/open-stage';
import { createStageCanvas } from '../shared/panels/stage-canvas';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store, watch } from '../shared/state/store';
import type { SideStart } from '../shared/workers/side-run';
import { createPairBadges, createPairPanel, createPairTools } from './panels/pair-panel';
import { columnsFor } from './panels/pane-badges';
import { PairRun, type PairView } from './run/pair-run';
import { createFabricsStage, type Direction, type FabricsStage } from './stage/fabrics-stage';
import { linkFailure } from './state/fabrics-state';
import {
  decodePairLink,
  encodePairLink,
  initialPairState,
  PAIR_SCENES,
  type PairState,
} from './state/pair';
import type { Way } from './way';

/** Direction for cloth that hangs: from before, a little from the right and from above [rad]. */
const UPRIGHT: Direction = { azimuth: 0.4, polar: 1.34 };

export interface PairWay extends Way {
  /** Shows a fabric in the first pane. */
  wear(fabric: string): void;
}

/** The stage, where the browser can draw it; its buffers go back to the runs. */
class PairPicture implements PairView {
  private stage: FabricsStage | null = null;
  private readonly shown: (ArrayBuffer | null)[] = [null, null];
  private inviting = 0;

  constructor(private readonly store: Store<PairState>) {}

  open(
    box: HTMLElement,
    canvas: HTMLCanvasElement,
    run: PairRun,
    keys: Record<string, () => void>,
  ) {
    const { store } = this;
    const badges = createPairBadges(box, store);
    const invitation = createInvitation(box);
    const stage = openStage(canvas, store, (pictureLost) =>
      createFabricsStage(box, canvas, {
        grab: (vertex, pane) => run.grab(vertex, pane),
        moveGrab: (target) => run.moveGrab(target),
        releaseGrab: () => run.releaseGrab(),
        drawn: ({ x, y }) => invitation.place(x, y),
        key(name) {
          keys[name]?.();
          return name in keys;
        },
        pictureLost,
      }),
    );
    this.stage = stage;
    const layOut = () => {
      const nColumns = columnsFor(2, box.clientWidth, box.clientHeight);
      badges.setColumns(nColumns);
      stage?.setPanes(
        store.get().pair.map((name) => fabricNamed(name).id),
        nColumns,
      );
    };
    new ResizeObserver(layOut).observe(box);
    watch(store, ['pair'], layOut);
    watch(store, ['invited', 'phase'], ({ invited, phase }) =>
      invitation.setShown(invited && phase === 'ready' && stage !== null),
    );
  }

  showMesh(pane: number, { triangles, nVertices }: SideStart): void {
    this.shown[pane] = null;
    if (pane === 0) this.stage?.showMesh(triangles, nVertices);
  }

  showFrame(pane: number, buffer: ArrayBuffer): ArrayBuffer | null {
    const before = this.shown[pane] ?? null;
    this.shown[pane] = buffer;
    this.stage?.showFrame(pane, buffer);
    return before;
  }

  begin(isNew: boolean): void {
    const places = Array.from(this.positions(0));
    const { fallsBy } = PAIR_SCENES[this.store.get().scene];
    const below = places.map((metres, k) => (k % 3 === 1 ? metres - fallsBy : metres));
    if (isNew) this.stage?.frame([...places, ...below], UPRIGHT);
    this.inviting = places.length / 3 - 1;
    this.stage?.invite(this.inviting);
  }

  positions(pane: number): ArrayLike<number> {
    return this.stage?.positions(pane) ?? this.placesIn(pane);
  }

  homeView = () => this.stage?.homeView();
  invitingVertex = () => this.inviting;
  project = (vertex: number, pane = 0) => this.stage?.project(vertex, pane);

  private placesIn(pane: number): Float32Array {
    const buffer = this.shown[pane];
    return buffer ? frameViews(buffer).positions : new Float32Array(0);
  }
}

/** `left` takes its messages, stage and tools. */
export function createPairView(left: HTMLElement, panel: HTMLElement, hash: string): PairWay {
  const first = decodePairLink(hash);
  const store = createStore(initialPairState(first.link, linkFailure(first.problems, null)));
  let isShown = false;
  const messages = element('div');
  const stageBox = element('section', { class: 'stage', 'aria-label': 'Both cloths' });
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Run' });
  left.append(messages, stageBox, toolBox);
  const canvas = createStageCanvas(
    stageBox,
    'One scene in two fabrics. Space plays, G takes the cloth, arrows turn the view.',
  );
  const picture = new PairPicture(store);
  const run = new PairRun(store, picture);
  picture.open(stageBox, canvas, run, {
    ' ': () => (store.get().playing ? run.pause() : run.play()),
    '.': () => run.step(),
    r: () => void run.reset(),
  });
  createFailureBanner(messages, store);
  createPairTools(toolBox, store, run, picture.homeView);
  createPairPanel(panel, store);
  createKeyList(panel, HAND_KEYS);

  const link = () => `#${encodePairLink(store.get())}`;
  const writeLink = createLinkWriter(store, link, () => isShown);
  return {
    link,
    open(newHash) {
      const read = decodePairLink(newHash);
      store.set({ ...read.link, problem: linkFailure(read.problems, null) });
    },
    setShown(value) {
      isShown = value;
      if (!value) run.pause();
      writeLink();
    },
    wear(fabric) {
      const [before, other] = store.get().pair;
      store.set({ pair: [fabric, other === fabric ? before : other] });
    },
    probe: {
      state: () => store.get(),
      positions: (pane = 0) => Array.from(picture.positions(pane)),
      project: picture.project,
      inviting: picture.invitingVertex,
    },
  };
}
