// What the view of refinement says.
import type { FitAnswer } from '../../sim/refinement-module';
import type { PlanStory } from '../../state/plan-file';
import {
  type FrameSource,
  type GarmentPane,
  PANES,
  type PaneId,
  type RefinementState,
} from '../../state/refinement-state';
import { milliseconds, percent, smallLength } from '../quantity';

export const PANE_TITLES: Record<PaneId, string> = {
  coarse: 'Coarse',
  planned: 'Multi-resolution',
  fine: 'Fine',
};

/** Beyond this share of its faces for ten frames the monitor fires; docs/methods/multiresolution.md. */
export const LARGEST_SHARE = 0.05;
export const FRAMES_TO_FIRE = 10;

export function vertices(count: number): string {
  return `${count.toLocaleString('en').replaceAll(',', '\u202f')} vertices`;
}

/** How dear a frame is, and where that was found out. */
export function costWords({ source, msPerFrame }: GarmentPane): string {
  const cost = msPerFrame === null ? '' : `${milliseconds(msPerFrame)} a frame`;
  switch (source) {
    case 'recorded':
      return cost === '' ? 'recorded' : `${cost}, recorded`;
    case 'computed':
      return cost === '' ? 'computed here' : `${cost} here`;
    case 'sampled':
      return 'fine’s shape on this mesh; press Play';
    case 'resting':
      return 'rests';
  }
}

export function errorWords(pane: PaneId, { errorM, source }: GarmentPane): string {
  if (pane === 'fine') return source === 'resting' ? '' : 'what the others are held against';
  return errorM === null ? '' : `${smallLength(errorM)} off fine`;
}

/** One sentence: what to notice. */
export function noticeSentence({ panes, plan, motion }: RefinementState): string {
  const { planned, fine } = panes;
  if (planned.nVertices === 0 || fine.nVertices === 0 || !plan)
    return 'One garment on one walking figure, on a coarse, a planned and a fine mesh.';
  const share = planned.nVertices / fine.nVertices;
  const what =
    motion === 'squat'
      ? 'Play, and watch the light below: the knees bend the cloth where no walk did, and the plan does not know it.'
      : 'Compare the folds with those on the right.';
  return `The middle mesh has ${percent(share)} of the fine one’s vertices: small faces only where the example walk bent the cloth. ${what}`;
}

export function ruleWords({ rule }: PlanStory): string {
  return rule.kind === 'demand'
    ? `where the patterns at a face’s corners sum to more than ${Number(rule.value.toFixed(2))}`
    : `one after another, the most urgent first, up to ${vertices(rule.value)}`;
}

/** The plan in a few sentences. */
export function storySentences(story: PlanStory): string {
  const { nSplits, nForBalance, patterns } = story;
  const asked = nSplits - nForBalance;
  const splits =
    nForBalance === 0
      ? `${nSplits} faces were split, ${ruleWords(story)}; none only to keep neighbours within one level of each other.`
      : `${nSplits} faces were split: ${asked} ${ruleWords(story)}, the other ${nForBalance} only to keep neighbours within one level of each other.`;
  return `The example walk sorted the coarse vertices into ${patterns.length} patterns of bending. ${splits} A split face asks for one less at each corner before it may be split again.`;
}

export interface FitReading {
  light: 'fits' | 'uneasy' | 'fires' | 'unknown';
  title: string;
  detail: string;
}

/** The monitor's light. */
export function fitReading(fit: FitAnswer | null, story: PlanStory | null): FitReading {
  if (!fit || !story?.patterns.every(({ limitPerM }) => limitPerM !== null))
    return {
      light: 'unknown',
      title: 'Not watched yet',
      detail: 'The light compares each frame with the example once the cloth moves.',
    };
  const share = `${percent(fit.share)} of the faces bend more than their pattern did in the example; at most ${percent(fit.worst_share)} so far.`;
  if (fit.fires || fit.first_fired !== null)
    return {
      light: 'fires',
      title: 'Does not fit the example',
      detail: `${share} More than ${percent(LARGEST_SHARE)} for ${FRAMES_TO_FIRE} frames in a row: the mesh was planned for another kind of motion.`,
    };
  if (fit.share > LARGEST_SHARE)
    return {
      light: 'uneasy',
      title: 'Fits, but for now',
      detail: `${share} That has lasted ${fit.n_in_a_row} of ${FRAMES_TO_FIRE} frames.`,
    };
  return { light: 'fits', title: 'Fits the example', detail: share };
}

/** Where the frames come from, and who waits for whom. */
export function sourceSentence({ panes }: RefinementState): string {
  const named = (...sources: FrameSource[]) =>
    PANES.filter((id) => sources.includes(panes[id].source)).map((id) =>
      PANE_TITLES[id].toLowerCase(),
    );
  const here = named('computed', 'sampled');
  const recorded = named('recorded');
  const sentences: string[] = [];
  if (recorded.length > 0)
    sentences.push(
      `Frames that come with the page: ${recorded.join(', ')}. They were computed by the same core on one core of a desktop, whose milliseconds are shown.`,
    );
  if (here.length > 0) sentences.push(`Computed on this device: ${here.join(', ')}.`);
  if (panes.fine.source === 'computed') sentences.push('The others wait for the fine mesh.');
  if (panes.fine.source === 'resting')
    sentences.push('The fine mesh rests: there is nothing to hold the others against.');
  return sentences.join(' ');
}
