// The view of refinement: one garment on a walking figure, on a coarse, a planned and a fine mesh. Its
// store, its workers, its stage and its panels, wired together.
import type { View } from '../shared/page/view';
import '../shared/page/panes.css';
import './refinement.css';
import { inputFailure } from '../shared/bindings/answers';
import { fabricNamed } from '../shared/fabric/fabric-data';
import { createAnnouncer } from '../shared/panels/announcer';
import { element } from '../shared/panels/element';
import { createFailureBanner } from '../shared/panels/failure-banner';
import { createKeyList } from '../shared/panels/keys-panel';
import { PICTURE_LOST, replaceCanvas } from '../shared/panels/no-picture';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, watch } from '../shared/state/store';
import { createDetailPanel } from './panels/detail-panel';
import { createFitPanel } from './panels/fit-panel';
import { createGarmentBadges } from './panels/garment-badges';
import { createGarmentLegend } from './panels/garment-legend';
import { createGarmentPanel } from './panels/garment-panel';
import { garmentSentence } from './panels/garment-sentence';
import { createGarmentToolbar } from './panels/garment-toolbar';
import { paintOf, upperEnd } from './panels/paints';
import { objText, save } from './panels/saving';
import { createStoryPanel } from './panels/story-panel';
import { Trio } from './run/trio';
import { createGarmentStage, type GarmentStage } from './stage/garment-stage';
import { decodeRefinementLink, encodeRefinementLink } from './state/refinement-link';
import {
  initialRefinementState,
  PANES,
  type PaneId,
  type RefinementState,
} from './state/refinement-state';
import type { GarmentMesh } from './worker/garment-protocol';

const KEYS: readonly [string, string][] = [
  ['Space', 'play or pause'],
  ['.', 'one frame'],
  ['R', 'reset'],
  ['E and H', 'edges of the faces, hanging vertices'],
  ['Arrows', 'turn the view'],
  ['+ and -', 'closer, farther'],
  ['Home', 'first view'],
];

export function createRefinementView(root: HTMLElement, hash: string): View {
  const first = decodeRefinementLink(hash);
  const store = createStore<RefinementState>(initialRefinementState(first.link, first.problems));
  const meshes: Partial<Record<PaneId, GarmentMesh>> = {};
  let stage: GarmentStage | null = null;
  let isShown = false;

  const messages = element('div');
  const stageBox = element('section', { class: 'stage', 'aria-label': 'Garment on three meshes' });
  const legendBox = element('div');
  const toolBox = element('section', { class: 'toolbar', 'aria-label': 'Run' });
  const panel = element('aside', { class: 'panel', 'aria-label': 'Refinement' });
  const canvas = element('canvas', {
    tabindex: 0,
    role: 'application',
    'aria-label':
      'A walking figure in a garment, three times. Space plays, arrows turn the view, a press on a face tells why it is so fine.',
  });
  stageBox.append(canvas);
  root.replaceChildren(
    element('div', { class: 'left' }, messages, stageBox, legendBox, toolBox),
    panel,
  );

  function repaint(): void {
    const state = store.get();
    PANES.forEach((id, pane) => {
      const mesh = meshes[id];
      if (mesh) stage?.setPaint(pane, paintOf(state, mesh, state.plan, id === 'fine'));
    });
  }

  /** The scale of a quantity reaches as far as any pane's values did, and does not shrink. */
  function widenScale(): void {
    const { colour, ranges } = store.get();
    if (colour !== 'curvature' && colour !== 'distance') return;
    const ends = PANES.map((_, pane) => upperEnd(stage?.scalars(pane) ?? new Float32Array(0)));
    const most = Math.max(...ends);
    if (most > ranges[colour]) store.set({ ranges: { ...ranges, [colour]: most } });
  }

  const trio = new Trio(store, {
    showMesh(id, mesh) {
      meshes[id] = mesh;
      stage?.setMesh(PANES.indexOf(id), mesh);
    },
    showFrames(frames, solids) {
      for (const { pane, buffer } of frames) stage?.showFrame(PANES.indexOf(pane), buffer);
      if (solids) stage?.setSolids(solids);
      widenScale();
    },
  });

  const run = {
    play: () => trio.play(),
    pause: () => trio.pause(),
    step: () => trio.step(),
    reset: () => trio.reset(),
    cancel: () => trio.cancel(),
  };

  function key(name: string): boolean {
    const { playing, edges, hanging } = store.get();
    const actions: Record<string, () => void> = {
      ' ': playing ? run.pause : run.play,
      '.': run.step,
      r: run.reset,
      e: () => store.set({ edges: !edges }),
      h: () => store.set({ hanging: !hanging }),
    };
    actions[name]?.();
    return name in actions;
  }

  try {
    stage = createGarmentStage(stageBox, canvas, {
      press(pane, face) {
        if (PANES[pane] === 'planned') store.set({ face });
      },
      key,
      contextLost() {
        store.set({ problem: inputFailure(PICTURE_LOST) });
      },
    });
  } catch {
    replaceCanvas(canvas, 'The numbers');
  }

  createGarmentBadges(stageBox, store);
  createGarmentLegend(legendBox, store);
  watch(store, ['colour', 'ranges', 'plan', 'phase'], repaint);
  watch(store, ['panes'], ({ panes }) => {
    PANES.forEach((id, pane) => {
      stage?.setShown(pane, panes[id].source !== 'resting');
    });
  });
  watch(store, ['edges'], ({ edges }) => stage?.setEdges(edges));
  watch(store, ['hanging'], ({ hanging }) => stage?.setHanging(hanging));
  watch(store, ['fabric'], ({ fabric }) => stage?.setFabric(fabricNamed(fabric).id));
  watch(store, ['face', 'phase'], ({ face }) => stage?.setChosen(PANES.indexOf('planned'), face));
  const showProblem = createFailureBanner(messages, () => store.set({ problem: null }));
  watch(store, ['problem', 'phase'], showProblem);

  createAnnouncer(messages, store, garmentSentence);
  createGarmentToolbar(toolBox, store, {
    ...run,
    homeView: () => stage?.homeView(),
    async savePicture() {
      const picture = await stage?.picture();
      if (picture) save('pleat-refinement.png', picture);
    },
    saveObj() {
      const pane = PANES.indexOf('planned');
      if (!stage) return;
      const text = objText(stage.positions(pane), stage.triangles(pane));
      save('pleat-garment.obj', new Blob([text], { type: 'model/obj' }));
    },
  });
  createGarmentPanel(panel, store);
  createFitPanel(panel, store, { cancel: run.cancel });
  createDetailPanel(panel, store, { cancel: run.cancel });
  createStoryPanel(panel, store, () => meshes.planned ?? null);
  createKeyList(panel, KEYS);

  /** Where the link starts: the shown time, while it rests. */
  const link = () => {
    const state = store.get();
    const isAtTime = state.phase === 'ready' && !state.playing && state.timeS > 0;
    return `#${encodeRefinementLink({ ...state, startS: isAtTime ? state.timeS : state.startS })}`;
  };
  const writeLink = createLinkWriter(store, link, () => isShown && store.get().plan !== null);

  return {
    link,
    open(newHash) {
      const read = decodeRefinementLink(newHash);
      const { problem } = initialRefinementState(read.link, read.problems);
      store.set({ ...read.link, problem });
    },
    setShown(value) {
      isShown = value;
      if (!value) trio.pause();
      writeLink();
    },
    probe: {
      state: () => store.get(),
      positions: (pane = 0) => Array.from(stage?.positions(pane) ?? []),
      project: (vertex: number, pane = 0) => stage?.project(vertex, pane),
    },
  };
}
