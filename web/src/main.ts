// Wiring only: the store, the playback, the stage and the panels, and the state in the address.
import './design.css';
import { createPlayback, type Playback } from './sim/playback';
import { createSweep } from './sim/sweep';
import { createStage, type Stage } from './stage/stage';
import { initialState, shownHeat } from './state/app-state';
import { fabricNamed } from './state/fabric-data';
import { createStore, watch } from './state/store';
import { decodeLink, encodeLink } from './state/url-codec';
import { createAnnouncer } from './views/announcer';
import { createDrawingPanel } from './views/drawing-panel';
import { createDropTarget } from './views/drop-target';
import { element } from './views/element';
import { createFabricPanel } from './views/fabric-panel';
import { createHeatLegend } from './views/heat-legend';
import { createInvitation } from './views/invitation';
import { createKeysPanel } from './views/keys-panel';
import { createMethodPanel } from './views/method-panel';
import { createNumbersStrip } from './views/numbers-strip';
import { createProblemBanner } from './views/problem-banner';
import { createScenePanel } from './views/scene-panel';
import { createSpeedErrorView } from './views/speed-error-view';
import { createSweepPanel } from './views/sweep-panel';
import { createToolbar } from './views/toolbar';

const place = (id: string): HTMLElement => {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found;
};

const { link, problems } = decodeLink(window.location.hash);
const store = createStore(initialState(link, problems));

const stageBox = place('stage');
const canvas = element('canvas', {
  tabindex: 0,
  role: 'application',
  'aria-label': 'Cloth in three dimensions. Space plays, G takes the cloth, arrows turn the view.',
});
stageBox.append(canvas);

let playback: Playback | null = null;
let stage: Stage | null = null;

function togglePlay(): void {
  if (store.get().playing) playback?.pause();
  else playback?.play();
}

const stageKeys: Record<string, () => void> = {
  ' ': togglePlay,
  '.': () => playback?.step(),
  r: () => playback?.reset(),
};

const invitation = createInvitation(stageBox, store);
createHeatLegend(stageBox, store);

try {
  stage = createStage(stageBox, canvas, {
    grab(vertex) {
      playback?.play();
      playback?.grab(vertex);
    },
    moveGrab: (target) => playback?.moveGrab(target),
    releaseGrab: () => playback?.releaseGrab(),
    key(name) {
      stageKeys[name]?.();
      return name in stageKeys;
    },
    drawn(scale, at) {
      const { heatScale } = store.get();
      if (JSON.stringify(scale) !== JSON.stringify(heatScale)) store.set({ heatScale: scale });
      invitation.place(at.x, at.y);
    },
    contextLost() {
      const sentence =
        'The browser took the graphics away for a moment. Reload if the picture stays empty.';
      store.set({ playing: false, problem: { source: 'run', sentence } });
    },
  });
} catch {
  canvas.remove();
  const sentence =
    'This browser shows no WebGL 2, so the cloth cannot be drawn. The numbers and the sweep still work.';
  stageBox.append(element('p', { class: 'plain' }, sentence));
  store.set({ problem: { source: 'browser', sentence } });
}

playback = createPlayback(store, {
  showMesh: (...mesh) => stage?.showMesh(...mesh),
  showFrame: (...frame) => stage?.showFrame(...frame),
});
const { play, pause, step, reset } = playback;
const actions = { play, pause, step, reset, homeView: () => stage?.homeView() };

createProblemBanner(place('messages'), store, actions);
createAnnouncer(place('messages'), store);
createNumbersStrip(place('strip'), store);
createToolbar(place('toolbar'), store, actions);
createScenePanel(place('panel'), store, playback);
createDropTarget(document.body, playback);
createFabricPanel(place('panel'), store);
createMethodPanel(place('panel'), store);
createDrawingPanel(place('panel'), store);
createSweepPanel(place('panel'), store, createSweep(store));
createKeysPanel(place('panel'));
createSpeedErrorView(place('tray'), store);

watch(store, ['setting'], ({ setting }) => stage?.setFabric(fabricNamed(setting.fabric).id));
watch(store, ['colliders'], ({ colliders }) => stage?.setColliders(colliders));
watch(store, ['heat', 'heatRange', 'numbers'], (state) =>
  stage?.setHeat(shownHeat(state), state.heatRange),
);
watch(store, ['edges'], ({ edges }) => stage?.setEdges(edges));
watch(store, ['setting', 'heat', 'heatRange', 'edges', 'startS'], (state) => {
  const hash = `#${encodeLink(state)}`;
  if (hash !== window.location.hash) window.history.replaceState(null, '', hash);
});
window.addEventListener('hashchange', () => {
  const read = decodeLink(window.location.hash);
  store.set({ ...read.link, problem: initialState(read.link, read.problems).problem });
});

if (import.meta.env.PROD && 'serviceWorker' in navigator) {
  // Without it (a page opened from an insecure address) the page works, but only while served.
  navigator.serviceWorker.register('./offline.js').catch(() => undefined);
}

// For the console and for tests: the state and the present frame, to look at.
Object.assign(window, {
  pleat: {
    state: () => store.get(),
    positions: () => Array.from(stage?.positions() ?? []),
    project: (vertex: number) => stage?.project(vertex),
    inviting: () => stage?.inviting(),
  },
});
