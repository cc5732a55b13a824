// The answer that the picture gives, in a sentence: how far from the fine cloth each mesh is now, and at what cost.
import { percent, smallLength } from '../../shared/panels/quantity';
import { type GarmentId, usualFabric } from '../state/garments';
import {
  comparedPanes,
  PANE_TITLES,
  type PaneId,
  type RefinementState,
  showsFineCloth,
} from '../state/refinement-state';

/** Largest share of the other mesh's distance at which the planned one is called much nearer. */
const MUCH_NEARER = 0.5;

const SKIRT = { title: 'skirt', verb: 'is', one: 'one', whose: 'its' };
const TROUSERS = { title: 'trousers', verb: 'are', one: 'ones', whose: 'their' };
const NAMES: Record<GarmentId, typeof SKIRT> = {
  skirt: SKIRT,
  trousers: TROUSERS,
  slim_trousers: TROUSERS,
};

const nameOf = (id: PaneId) => PANE_TITLES[id].toLowerCase();

/** The share of the fine mesh's cost that the planned one has: of its time where both were timed alike. */
function costWords({ garment, panes: { planned, fine } }: RefinementState): string {
  const { whose } = NAMES[garment];
  const isTimedAlike = planned.source === fine.source && planned.msPerFrame && fine.msPerFrame;
  if (isTimedAlike)
    return `at ${percent((planned.msPerFrame ?? 0) / (fine.msPerFrame ?? 1))} of ${whose} time`;
  return `with ${percent(planned.nVertices / fine.nVertices)} of ${whose} vertices`;
}

/** Words on cloth that goes through itself in what is shown; null where it does not. */
export function tangleSentence(state: RefinementState): string | null {
  const counts = comparedPanes(state).map((id) => ({
    id,
    n: state.panes[id].faults?.n_crossings ?? 0,
  }));
  if (counts.every(({ n }) => n === 0)) return null;
  const list = counts.map(({ id, n }) => `${nameOf(id)} ${n}`).join(', ');
  return `Cloth passes through itself here (edges that cross: ${list}): nothing guards against that yet, so this moment says nothing about meshes.`;
}

/** Words before any distance is known; empty where what comes with the page will tell it in a moment. */
function waitingSentence({ garment, fabric, phase, panes: { fine } }: RefinementState): string {
  if (phase === 'ready' && fine.source === 'resting')
    return 'The fine mesh rests, so that nobody knows how far off the others are.';
  const usual = usualFabric(garment);
  if (fabric === usual || phase === 'broken' || phase === 'stopped') return '';
  return `How far off each mesh is, is known beforehand in ${usual} only: in ${fabric} it is computed here.`;
}

/** Empty while nothing is known and nothing has to be computed. */
export function answerSentence(state: RefinementState): string {
  const { panes, garment, rival, fabric } = state;
  const [ours, theirs] = [panes.planned.distanceM, panes[rival].distanceM];
  // Distances that are known while something else is fetched belong to what was shown before.
  if (ours === null || theirs === null || state.phase === 'loading') return waitingSentence(state);
  const [near, far] = [smallLength(ours), smallLength(theirs)];
  // While it is computed nobody counts whether cloth passes through itself.
  if (state.playing && panes.planned.source === 'computed')
    return `Computed now in ${fabric}: multi-resolution ${near} off fine, ${nameOf(rival)} ${far}. Pause to learn whether cloth passes through itself.`;
  const tangle = tangleSentence(state);
  if (tangle !== null) return tangle;
  if (ours > MUCH_NEARER * theirs && state.timeS > 0 && !showsFineCloth(state))
    return `Once they move, meshes go ways of their own: the multi-resolution one is ${near} off the fine one, the ${nameOf(rival)} one ${far}.`;
  const { title, verb, one } = NAMES[garment];
  return `The multi-resolution ${title} ${verb} ${near} off the fine ${one} ${costWords(state)}; the ${nameOf(rival)} ${one} ${verb} ${far} off.`;
}
