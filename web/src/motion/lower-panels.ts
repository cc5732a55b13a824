// The panels that are far down: they come once there is a cloth to be told of.

import { createKeyList, HAND_KEYS } from '../shared/panels/keys-panel';
import { addSection } from '../shared/panels/section';
import { createWhyLink } from '../shared/panels/why-link';
import { type Store, watch } from '../shared/state/store';
import { createSelfContact } from './panels/contact/self-contact';
import { createConvergencePanel } from './panels/convergence/convergence-panel';
import { createEnergyPanel } from './panels/energy/energy-panel';
import { createLevelPanel } from './panels/levels/level-panel';
import { createOneSubstep } from './panels/method/one-substep';
import { createClothContact } from './panels/numbers/cloth-contact';
import { createSweepPanel } from './panels/speed-error/sweep-panel';
import { later } from './run/later';
import type { MotionRun } from './run/motion-run';
import type { Sweep } from './run/sweep';
import type { MotionState } from './state/motion-state';

/** Chart and table of the sweep. Returns what opens them and brings them into view. */
function createSweepTray(
  parent: HTMLElement,
  store: Store<MotionState>,
  run: MotionRun,
): () => void {
  const bring = later(store, 'The chart of the sweep', async () => {
    const { createSpeedErrorView } = await import('./panels/speed-error/speed-error-view');
    createSpeedErrorView(parent, store, run);
  });
  watch(store, ['sweepOpen'], async ({ sweepOpen }) => {
    if (sweepOpen && (await bring()) === null) store.set({ sweepOpen: false });
  });
  return async () => {
    store.set({ sweepOpen: true });
    await bring();
    const isCalm = matchMedia('(prefers-reduced-motion: reduce)').matches;
    parent.scrollIntoView({ block: 'start', behavior: isCalm ? 'instant' : 'smooth' });
  };
}

/** A sweep that comes with its first start. */
function createLaterSweep(store: Store<MotionState>): Sweep {
  const bring = later(store, 'The sweep', async () => {
    const { createSweep } = await import('./run/sweep');
    return createSweep(store);
  });
  return {
    start: async (wish) => (await bring())?.start(wish),
    cancel: async () => (await bring())?.cancel(),
  };
}

/** Contact of the cloth with itself; and what contact does where there are solids. */
function createContact(parent: HTMLElement, store: Store<MotionState>): void {
  const section = addSection(parent, 'Contact');
  createSelfContact(section, store);
  const bring = later(store, 'The panel of contact', async () => {
    const { createContactPanel } = await import('./panels/contact/contact-panel');
    return createContactPanel(section, store);
  });
  watch(store, ['colliders'], ({ colliders }) => {
    if (colliders.length > 0) void bring();
  });
}

/** Leads from a warning in the banner to the case that shows it. */
function linkBanner(messages: HTMLElement, store: Store<MotionState>): void {
  const { link, show } = createWhyLink();
  messages.querySelector('.problem')?.append(link);
  watch(store, ['problem'], ({ problem }) => show(problem?.warning));
}

export function createLowerPanels(
  place: (id: string) => HTMLElement,
  store: Store<MotionState>,
  run: MotionRun,
): void {
  const panel = place('panel');
  linkBanner(place('messages'), store);
  createOneSubstep(panel, store, run);
  const showChart = createSweepTray(place('tray'), store, run);
  createSweepPanel(panel, store, createLaterSweep(store), showChart);
  createLevelPanel(panel, store);
  createEnergyPanel(panel, store);
  createContact(panel, store);
  createClothContact(place('strip'), store);
  createConvergencePanel(panel, store, run);
  createKeyList(panel, HAND_KEYS);
}
