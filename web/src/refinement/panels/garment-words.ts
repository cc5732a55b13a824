// The words of the view of refinement.

import { digits, milliseconds, percent, smallLength } from '../../shared/panels/quantity';
import { warningSentence } from '../../shared/panels/warning-words';
import { exampleName, GARMENTS } from '../state/garments';
import { type PlanFile, type PlanStory, planStory } from '../state/plan-file';
import {
  comparedPanes,
  type FrameSource,
  type GarmentPane,
  MOST_SUBSTEPS,
  PANE_TITLES,
  type PaneId,
  type RefinementState,
} from '../state/refinement-state';

export function vertices(count: number): string {
  return `${count.toLocaleString('en').replaceAll(',', '\u202f')} vertices`;
}

const FINE_CLOTH = 'fine’s shape on this mesh';

/** The cost of a frame, and where it was measured; of the fine pane's cloth, that it is that. */
export function costWords({ source, msPerFrame }: GarmentPane, isFineCloth: boolean): string {
  if (isFineCloth) return FINE_CLOTH;
  const cost = msPerFrame === null ? '' : `${milliseconds(msPerFrame)} a frame`;
  switch (source) {
    case 'recorded':
      return cost === '' ? 'recorded' : `${cost}, recorded`;
    case 'computed':
      return cost === '' ? 'computed here' : `${cost} here`;
    case 'sampled':
      return `${FINE_CLOTH}; press Play`;
    case 'resting':
      return 'rests';
  }
}

/** Words on the quantity that the colours of distance show. */
export function errorWords(pane: PaneId, { distanceM, source }: GarmentPane): string {
  if (pane === 'fine') return source === 'resting' ? '' : 'the reference';
  return distanceM === null ? '' : `${smallLength(distanceM)} off fine`;
}

/** The first sign seen in the steps of a pane that they are no cloth. */
export function warningWords({ warnings: [first] }: GarmentPane): string {
  return first ? warningSentence(first) : '';
}

/** The substeps that may help a pane that shows it, as far as the page goes; else null. */
export function hintedSubsteps({ warnings: [first] }: GarmentPane): number | null {
  const hint = first?.hints['/method/substeps'];
  return hint === undefined ? null : Math.min(Number(hint), MOST_SUBSTEPS);
}

/** "skirt_fast_walk in silk" → "fast walk in silk". */
function exampleWords(name: string): string {
  const garment = GARMENTS.find(({ value }) => name.startsWith(`${value}_`));
  return name.slice(garment ? garment.value.length + 1 : 0).replaceAll('_', ' ');
}

/** "example walk", "examples walk and squat". */
export function examplesWords({ examples }: PlanStory): string {
  const names = new Intl.ListFormat('en-GB').format(examples.map(exampleWords));
  return `${examples.length > 1 ? 'examples' : 'example'} ${names}`;
}

/** The least and the largest number of several examples. */
export function fromTo(values: readonly number[]): string {
  const least = digits(Math.min(...values), 2);
  const most = digits(Math.max(...values), 2);
  return least === most ? least : `${least}–${most}`;
}

function whatToDo({ garment, motion, fabric }: RefinementState, plan: PlanFile): string {
  if (motion !== 'squat') return 'Play, or move the time below the picture.';
  const own = exampleName(garment, motion, fabric);
  if (plan.examples.some(({ name }) => name === own))
    return 'Play, and watch the light: now the plan knows where the knees bend the cloth.';
  return 'Play, and watch the light: the knees bend the cloth where no walk did, and the plan does not know it.';
}

const PLANNED = PANE_TITLES.planned.toLowerCase();

/** One sentence: what to notice. */
export function noticeSentence(state: RefinementState): string {
  const { panes, plan } = state;
  const { planned, fine } = panes;
  if (planned.nVertices === 0 || fine.nVertices === 0 || !plan)
    return `One garment on one walking figure, on a uniform, a ${PLANNED} and a fine mesh.`;
  const share = planned.nVertices / fine.nVertices;
  const story = planStory(plan);
  const where = story.isByShape
    ? `where larger ones would lose most of what the ${examplesWords(story)} showed`
    : `only where the ${examplesWords(story)} bent the cloth`;
  return `The ${PLANNED} mesh has ${percent(share)} of the fine one’s vertices: small faces ${where}. ${whatToDo(state, plan)}`;
}

function times(more: number, less: number): string {
  return `${digits(more / less, 2)} times`;
}

/** Words on what the finer meshes cost. */
export function levelsSentence({ panes }: Pick<RefinementState, 'panes'>): string {
  const { coarse, fine } = panes;
  if (coarse.nVertices === 0 || fine.nVertices === 0) return '';
  const isTimed = coarse.msPerFrame !== null && fine.msPerFrame !== null;
  const isTimedAlike = isTimed && coarse.source === fine.source;
  const time = isTimedAlike
    ? ` and ${times(fine.msPerFrame ?? 0, coarse.msPerFrame ?? 1)} the time of a frame`
    : '';
  return `A level splits each face into four. The two from coarse to fine cost ${times(fine.nVertices, coarse.nVertices)} the vertices${time}.`;
}

/** Pointer to what one more level buys: words before the link, the link, and words after it. */
export const ONE_MORE_LEVEL = {
  before: 'How much nearer one more level comes, folds do not tell: for that open ',
  link: 'the swinging sheet',
  hash: '#scene=swinging-sheet',
  after:
    ' and press “Measure speed and error”. It says what the mesh does wrong at each level of that sheet.',
};

/** Words on what the shown meshes lose of the fine one, and on what chance does to two fine runs. */
export function lossSentence({
  panes,
  rival,
  floor,
}: Pick<RefinementState, 'panes' | 'rival' | 'floor'>): string {
  const { planned } = panes;
  const other = panes[rival];
  if (other.lostM === null || planned.lostM === null) return '';
  const named = PANE_TITLES[rival].toLowerCase();
  const lost = `The ${named} mesh cannot show details smaller than ${smallLength(other.lostM)}, the ${PLANNED} one none smaller than ${smallLength(planned.lostM)}.`;
  if (other.foldsM === null || planned.foldsM === null) return lost;
  const folds = ` Folds differ from fine’s by ${smallLength(other.foldsM)} and ${smallLength(planned.foldsM)}`;
  if (!floor) return `${lost}${folds}, some of which is chance.`;
  return `${lost}${folds}, but folds are chance: two equally fine runs differ by ${smallLength(floor.foldsM)} too.`;
}

export function ruleWords({ rule, isByShape }: PlanStory): string {
  const value = Number(rule.value.toFixed(2));
  if (isByShape)
    return rule.kind === 'demand'
      ? `where a vertex saves most, until no more than ${value} mm of the example’s shapes were lost`
      : `where a vertex saves most of the example’s shapes, up to ${vertices(rule.value)}`;
  return rule.kind === 'demand'
    ? `where the patterns at a face’s corners sum to more than ${value}`
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
  const sorted = `sorted the coarse vertices into ${patterns.length} patterns of bending`;
  const origin =
    story.examples.length > 1
      ? `The ${examplesWords(story)} each ${sorted}; where they differ, the higher pattern counts.`
      : `The ${examplesWords(story)} ${sorted}.`;
  const again = story.isByShape
    ? ''
    : ' A split face asks for one less at each corner before it may be split again.';
  return `${origin} ${splits}${again}`;
}

/** Says where the frames come from, and which panes wait. */
export function sourceSentence(state: RefinementState): string {
  const { panes, method, substeps } = state;
  const named = (...sources: FrameSource[]) =>
    comparedPanes(state)
      .filter((id) => sources.includes(panes[id].source))
      .map((id) => PANE_TITLES[id].toLowerCase());
  const here = named('computed', 'sampled');
  const recorded = named('recorded');
  const sentences: string[] = [];
  if (recorded.length > 0)
    sentences.push(
      `Frames that come with the page: ${recorded.join(', ')}. They were computed beforehand by the native build of the same program; their milliseconds are that machine’s, not this one’s.`,
    );
  if (here.length > 0) sentences.push(`Computed on this device: ${here.join(', ')}.`);
  if (method === 'multigrid')
    sentences.push(
      'Steps are position-based, on coarser and coarser levels of each mesh. The badges tell what a frame costs.',
    );
  if (substeps !== null && here.length > 0)
    sentences.push(`Each of their steps is made in ${substeps} substeps, until another motion.`);
  if (panes.fine.source === 'computed') sentences.push('The others wait for the fine mesh.');
  if (panes.fine.source === 'resting')
    sentences.push('The fine mesh rests: there is nothing to hold the others against.');
  return sentences.join(' ');
}
