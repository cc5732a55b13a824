// The view of cloth in motion: the store, the playback, the stage and the panels, wired together.
import './motion.css';
import { fabricNamed } from '../shared/fabric/fabric-data';
import type { StartShape, View } from '../shared/page/view';
import { createAnnouncer } from '../shared/panels/announcer';
import { createDropTarget } from '../shared/panels/drop-target';
import { element, setText } from '../shared/panels/element';
import { createInvitation } from '../shared/panels/invitation';
import { createRunTools } from '../shared/panels/run-tools';
import { createStageCanvas, PICTURE_LOST, replaceCanvas } from '../shared/panels/stage-canvas';
import type { Print } from '../shared/stage/fabric-material';
import { createLinkWriter } from '../shared/state/link-writer';
import { createStore, type Store, watch } from '../shared/state/store';
import { createDrawingPanel } from './panels/drawing-panel';
import { createLinkTool } from './panels/link-tool';
import { createMethodPanel } from './panels/method/method-panel';
import { motionSentence } from './panels/motion-sentence';
import { createNumbersStrip } from './panels/numbers/numbers-strip';
import { createProblemBanner } from './panels/problem-banner';
import { createFabricPanel } from './panels/scene/fabric-panel';
import { createScenePanel } from './panels/scene/scene-panel';
import { createWorkBar } from './panels/work-bar';
import { later } from './run/later';
import { MotionRun } from './run/motion-run';
import { createMotionStage, type MotionStage } from './stage/motion-stage';
import type { Knit } from './state/knit';
import { decodeMotionLink, encodeMotionLink, linkTo } from './state/motion-link';
import { AT_START, initialMotionState, type MotionState, shownHeat } from './state/motion-state';
import { deformedMesh, holdFor } from './state/obj-mesh';
import { PRESETS, presetSetting } from './state/setting';
import { MANY_SUBSTEPS } from './state/step-cost';

export interface MotionView extends View {
  /** The shown scene in that fabric. */
  wear(fabric: string): void;
  /** Sets a cloth in motion from the shape that it was pulled into. */
  start(shape: StartShape, fabric: string): void;
}

const TOOL_WORDS = {
  step: 'One step (full stop)',
  reset: 'Back to the start (R)',
  view: 'Look from the first direction again (Home)',
  speed: 'simulated seconds a second',
};

type Place = (id: string) => HTMLElement;

/** The picture, which gets frames; null where the browser cannot draw it. */
function createPicture(
  box: HTMLElement,
  store: Store<MotionState>,
  run: () => MotionRun | null,
): MotionStage | null {
  const canvas = createStageCanvas(
    box,
    'Cloth in three dimensions. Space plays, G takes the cloth, arrows turn the view.',
  );
  const invitation = createInvitation(box);
  watch(store, ['invited', 'phase', 'ahead', 'busy'], ({ invited, phase, ahead, busy }) =>
    invitation.setShown(invited && phase === 'ready' && ahead === null && busy === null),
  );
  const bringHeatLegend = later(store, 'The scale of the colours', async () => {
    (await import('./panels/heat-legend')).createHeatLegend(box, store);
  });
  watch(store, ['heat'], ({ heat }) => {
    if (heat !== 'off') void bringHeatLegend();
  });
  const keys: Record<string, () => void> = {
    ' ': () => (store.get().playing ? run()?.pause() : run()?.play()),
    '.': () => run()?.step(),
    r: () => run()?.reset(),
  };
  try {
    return createMotionStage(box, canvas, {
      grab(vertex) {
        run()?.play();
        run()?.grab(vertex);
      },
      moveGrab: (target) => run()?.moveGrab(target),
      releaseGrab: () => run()?.releaseGrab(),
      key(name) {
        keys[name]?.();
        return name in keys;
      },
      drawn({ heatScale, camera, invitation: { x, y } }) {
        const { heatScale: scale, camera: pose } = store.get();
        if (JSON.stringify(scale) !== JSON.stringify(heatScale)) store.set({ heatScale });
        if (JSON.stringify(pose) !== JSON.stringify(camera)) store.set({ camera });
        invitation.place(x, y);
      },
      pictureLost(isLost) {
        const { problem } = store.get();
        if (isLost)
          store.set({ playing: false, problem: { source: 'picture', sentence: PICTURE_LOST } });
        else if (problem?.source === 'picture') store.set({ problem: null });
      },
    });
  } catch {
    invitation.remove();
    const sentence = replaceCanvas(canvas, 'The numbers and the sweep');
    store.set({ problem: { source: 'browser', sentence } });
    return null;
  }
}

function createPanels(
  place: Place,
  store: Store<MotionState>,
  run: MotionRun,
  { homeView, link }: { homeView(): void; link(): string },
): void {
  createProblemBanner(place('messages'), store, run);
  const caption = element('p', { class: 'caption' });
  place('messages').append(caption);
  watch(store, ['setting'], ({ setting }) => setText(caption, PRESETS[setting.preset].caption));
  createAnnouncer(place('messages'), store, motionSentence);
  createWorkBar(place('stage'), store, run);
  createNumbersStrip(place('strip'), store, run);
  createRunTools(place('toolbar'), store, run, homeView, TOOL_WORDS, (phase) => phase !== 'broken');
  createLinkTool(place('toolbar'), store, { rest: () => run.rest(), link });
  createScenePanel(place('panel'), store, run.obj);
  createFabricPanel(place('panel'), store);
  createMethodPanel(place('panel'), store, run);
  createDrawingPanel(place('panel'), store);
  const bringLower = later(store, 'The lower part of the panel', async () => {
    (await import('./lower-panels')).createLowerPanels(place, store, run);
  });
  watch(store, ['phase'], ({ phase }) => {
    if (phase !== 'loading') void bringLower();
  });
}

/** Warnings of a run are told, and remedies tried, by a part that comes with the first of them. */
function tellOfRun(store: Store<MotionState>, run: MotionRun): void {
  const bring = later(store, 'What tells of the run', async () => {
    (await import('./run/warnings')).tellWarnings(store, run);
  });
  let hasAsked = false;
  watch(store, ['numbers'], async ({ numbers }) => {
    const [worst] = numbers?.warnings ?? [];
    if (!worst) hasAsked = false;
    if (!worst || hasAsked) return;
    hasAsked = true;
    const isHere = (await bring()) !== null;
    if (!isHere) store.set({ problem: { source: 'setting', sentence: `${worst.sentence}.` } });
  });
}

/** The cost of steps of many substeps is foretold by a part that comes with the first of them. */
function foretellCost(store: Store<MotionState>): void {
  const bring = later({ set: () => undefined }, 'The cost of a step', async () => {
    (await import('./run/step-probe')).foretellSteps(store);
  });
  watch(store, ['summary'], ({ summary }) => {
    if (Number(summary?.substeps) >= MANY_SUBSTEPS) void bring();
  });
}

/** The stitches come when a knit is first shown; without them it is drawn plain. */
function drawKnit(store: Store<MotionState>, stage: MotionStage): void {
  let drawn: Knit | undefined;
  let printOf: ((knit: Knit) => Print) | null = null;
  const bringStitches = later(store, 'The stitches of the knit', async () => {
    printOf = (await import('./stage/knit-drawing')).knitPrint;
  });
  async function draw(knit: Knit): Promise<void> {
    await bringStitches();
    if (printOf && drawn === knit) stage.setPrint(printOf(knit));
  }
  watch(store, ['setting'], ({ setting: { knit } }) => {
    if (knit === drawn) return;
    drawn = knit;
    if (knit) void draw(knit);
    else stage.setPrint(null);
  });
}

/** Brings drawings over the cloth when they are first asked for. */
function drawOverlays(
  box: HTMLElement,
  store: Store<MotionState>,
  stage: MotionStage,
  run: MotionRun,
): void {
  const bringSprings = later(store, 'The drawing of the springs', async () => {
    (await import('./spring-drawing')).drawSprings(box, store, stage);
  });
  const bringLevels = later(store, 'The drawing of levels', async () => {
    (await import('./level-drawing')).drawLevels(box, store, stage, run);
  });
  // The warning stands, whether its place can be marked or not.
  const bringPlace = later({ set: () => undefined }, 'The mark of a place', async () => {
    (await import('./place-drawing')).drawPlace(box, store, stage);
  });
  watch(store, ['springs', 'coarse', 'problem'], ({ springs, coarse, problem }) => {
    if (springs) void bringSprings();
    if (coarse > 0) void bringLevels();
    if (problem?.vertex !== undefined) void bringPlace();
  });
}

/** Has the picture follow what the state says of it. */
function drawFrom(store: Store<MotionState>, stage: MotionStage): void {
  watch(store, ['setting'], ({ setting }) => stage.setFabric(fabricNamed(setting.fabric).id));
  drawKnit(store, stage);
  watch(store, ['colliders'], ({ colliders }) => stage.setColliders(colliders));
  watch(store, ['heat', 'heatRange', 'numbers'], (state) =>
    stage.setHeat(shownHeat(state), state.heatRange),
  );
  watch(store, ['edges'], ({ edges }) => stage.setEdges(edges));
  watch(store, ['camera'], ({ camera }) => stage.setCamera(camera));
}

/** `place` finds the parts of the document by their ids. */
export function createMotionView(place: Place, hash: string): MotionView {
  let isShown = false;
  const first = decodeMotionLink(hash);
  const store = createStore(initialMotionState(first.link, first.problems));
  let running: MotionRun | null = null;
  const stage = createPicture(place('stage'), store, () => running);
  const run = new MotionRun(store, {
    showMesh: (...mesh) => stage?.showMesh(...mesh),
    showFrame: (...frame) => stage?.showFrame(...frame),
  });
  running = run;
  const link = () => `#${encodeMotionLink(linkTo(store.get()))}`;
  tellOfRun(store, run);
  foretellCost(store);
  createPanels(place, store, run, { homeView: () => stage?.homeView(), link });
  createDropTarget(
    () => isShown,
    (file) => void run.obj.open(file),
  );
  if (stage) {
    drawFrom(store, stage);
    drawOverlays(place('stage'), store, stage, run);
  }

  const writeLink = createLinkWriter(store, link, () => isShown);
  const drawing = ['heat', 'heatRange', 'edges', 'springs', 'coarse', 'coarseAs'] as const;
  watch(store, ['setting', ...drawing, 'energy', 'compare'], () => writeLink());

  return {
    link,
    open(newHash) {
      const read = decodeMotionLink(newHash);
      const { problem } = initialMotionState(read.link, read.problems);
      run.showAnew({ ...read.link, problem });
    },
    setShown(value) {
      isShown = value;
      if (!isShown) run.pause();
      writeLink();
    },
    wear(fabric) {
      store.set({ setting: { ...store.get().setting, fabric } });
    },
    start(shape, fabric) {
      const mesh = deformedMesh(shape);
      const setting = { ...presetSetting('obj'), fabric, hold: holdFor(mesh, 'group:held') };
      store.set({ ...AT_START, mesh, setting });
    },
    probe: {
      state: () => store.get(),
      positions: () => Array.from(stage?.positions() ?? []),
      project: (vertex: number) => stage?.project(vertex),
      inviting: () => stage?.inviting(),
    },
  };
}
