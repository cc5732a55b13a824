// The state that a link carries, to text and back. A part that cannot be read gives its default
// and one sentence; it never stops the page.
import { fabrics } from '../../shared/fabric/fabric-data';
import type { Pose } from '../../shared/stage/camera-control';
import type { HeatMap } from '../../shared/stage/heat-map';
import { createLinkReader, type LinkReader, oneOf, slug } from '../../shared/state/link-reader';
import {
  type Count,
  canRun,
  type DetailValue,
  METHOD_DETAILS,
  type MethodDetail,
  numberOf,
  STEPPER_NAMES,
  stepperRow,
} from '../../shared/steppers/steppers';
import { LEVEL_MAKERS, MOST_COARSE } from './coarse-levels';
import { knitIn, knitText } from './knit';
import type { Hold } from './obj-mesh';
import {
  detailOf,
  EXPLICIT_SHARES,
  levelsOf,
  MOST_ITERATIONS,
  MOST_SUBSTEPS,
  modelsOf,
  PRESET_IDS,
  type PresetId,
  presetSetting,
  type Setting,
  STEPS_PER_SECOND,
  withDetail,
  withModel,
  withStepper,
} from './setting';

export interface MotionLink {
  setting: Setting;
  heat: HeatMap;
  /** Upper end of the scale of stretch [%], or chosen from the frame. */
  heatRange: 'auto' | number;
  edges: boolean;
  /** The springs are drawn by how the stepper takes them. */
  springs: boolean;
  /** The coarser level that is drawn over the cloth; 0: none. */
  coarse: number;
  /** The stepper whose levels they are, where the cloth's own has none. */
  coarseAs: string;
  /** The account of energy is open, which takes keeping it. */
  energy: boolean;
  /** The reference is compared with, which takes fetching it. */
  compare: boolean;
  /** Steps that are run through before the cloth is shown. */
  startSteps: number;
  /** Pose from which the cloth is seen; null for the first one. */
  camera: Pose | null;
}

export const HEAT_MAPS: readonly HeatMap[] = ['off', 'magnitude', 'signed', 'distance'];
export const HEAT_RANGES: readonly number[] = [0.5, 1, 2, 5, 10];
const DEFAULT_PRESET: PresetId = 'curtain';
/** A link runs through this much at most: half a minute of a usual scene on a usual device [s]. */
const LATEST_START_S = 60;
/** A first visit starts here: the curtain hangs in folds, and its error is known [s]. */
const FIRST_VISIT_START_S = 1.5;

function wholeNumber(least: number, most: number) {
  return (text: string): number | undefined => {
    const value = /^\d{1,6}$/.test(text) ? Number(text) : -1;
    return value >= least && value <= most ? value : undefined;
  };
}

/** "1/60" is a sixtieth of a second. */
function stepFraction(text: string): number | undefined {
  const perSecond = STEPS_PER_SECOND.find((count) => text === `1/${count}`);
  return perSecond === undefined ? undefined : 1 / perSecond;
}

function startTime(text: string): number | undefined {
  const value = /^\d{1,2}(\.\d{1,3})?$/.test(text) ? Number(text) : Number.NaN;
  return value <= LATEST_START_S ? value : undefined;
}

/** Steps as `steps` counts them, or as the seconds of `start` hold them. */
function takeStart({ take }: LinkReader, stepS: number, usualS: number): number {
  const stepsIn = (seconds: number) => Math.round(seconds / stepS);
  const start = take('start', usualS, `0 to ${LATEST_START_S} s`, startTime);
  const most = stepsIn(LATEST_START_S);
  return take('steps', stepsIn(start), `0 to ${most}`, wholeNumber(0, most));
}

/** Decimals of the numbers of a pose: a thousandth of a turn or of the scene cannot be seen. */
const POSE_DECIMALS = 3;

function poseText({ azimuth, polar, zoom, shift }: Pose): string {
  return [azimuth, polar, zoom, ...shift]
    .map((value) => Number(value.toFixed(POSE_DECIMALS)))
    .join(',');
}

function poseIn(text: string): Pose | undefined {
  if (!/^-?\d{1,3}(\.\d{1,6})?(,-?\d{1,3}(\.\d{1,6})?){5}$/.test(text)) return undefined;
  const [azimuth = 0, polar = 0, zoom = 1, x = 0, y = 0, z = 0] = text.split(',').map(Number);
  return { azimuth, polar, zoom, shift: [x, y, z] };
}

function holdIn(text: string): Hold | undefined {
  if (text === 'highest' || text === 'nothing') return text;
  return text.startsWith('group:') ? (text as Hold) : undefined;
}

/** A detail as text to its value. */
function detailIn({ words, least = 0, most = 0 }: MethodDetail) {
  return (text: string): DetailValue | undefined => {
    if (words) return words.find((word) => word === text);
    const value = /^\d{1,2}(\.\d{1,6})?$/.test(text) ? Number(text) : Number.NaN;
    return value >= least && value <= most ? value : undefined;
  };
}

/** The setting with what the link says of the details that its stepper reads. */
function takeDetails({ take }: LinkReader, setting: Setting): Setting {
  const read = METHOD_DETAILS.filter(({ key }) => detailOf(setting, key) !== undefined);
  return read.reduce((present, detail) => {
    const { key, words, least, most } = detail;
    const expected = words ? words.join(', ') : `${least} to ${most}`;
    const value = take<DetailValue | undefined>(key, undefined, expected, detailIn(detail));
    return value === undefined ? present : withDetail(present, key, value);
  }, setting);
}

/** The parts of the details that are not what the preset has them. */
function detailParts(setting: Setting): [string, string][] {
  const usual = withStepper(presetSetting(setting.preset), setting.stepper);
  return METHOD_DETAILS.map(({ key }) => key)
    .filter((key) => detailOf(setting, key) !== detailOf(usual, key))
    .map((key) => [key, String(detailOf(setting, key))]);
}

/** The link to the state that is shown: one that rests is met after as many steps as it took. */
export function linkTo(
  state: MotionLink & {
    phase: string;
    playing: boolean;
    ahead: number | null;
    numbers: { time_s: number } | null;
  },
): MotionLink {
  const { phase, playing, ahead, numbers, setting, startSteps } = state;
  if (phase !== 'ready' || playing || ahead !== null || !numbers) return { ...state, startSteps };
  const steps = Math.round(Math.min(numbers.time_s, LATEST_START_S) / setting.stepS);
  return { ...state, startSteps: steps };
}

/** The part of a link after `#`. */
export function encodeMotionLink(link: MotionLink): string {
  const { setting } = link;
  const parts: [string, string][] = [
    ['scene', setting.preset],
    ['fabric', slug(setting.fabric)],
    ['model', setting.model],
    ['level', String(setting.level)],
    ['stepper', setting.stepper],
    ['step', `1/${Math.round(1 / setting.stepS)}`],
    ['substeps', String(setting.substeps)],
    ['iterations', String(setting.iterations)],
    ['heat', link.heat],
    ['range', String(link.heatRange)],
    ['edges', link.edges ? 'on' : 'off'],
    ['steps', String(link.startSteps)],
  ];
  if (setting.explicitShare > 0) parts.push(['explicit', String(100 * setting.explicitShare)]);
  parts.push(...detailParts(setting));
  if (link.coarse > 0) parts.push(['coarse', String(link.coarse)], ['coarse_as', link.coarseAs]);
  if (link.springs) parts.push(['springs', 'on']);
  if (link.energy) parts.push(['energy', 'on']);
  if (link.compare) parts.push(['compare', 'on']);
  if (link.camera) parts.push(['camera', poseText(link.camera)]);
  if (setting.bounces) parts.push(['response', 'uniform']);
  if (setting.meetsItself !== presetSetting(setting.preset).meetsItself)
    parts.push(['self_contact', setting.meetsItself ? 'on' : 'off']);
  if (setting.knit) parts.push(['knit', knitText(setting.knit)]);
  if (setting.preset === 'obj') parts.push(['hold', encodeURIComponent(setting.hold)]);
  return parts.map(([key, value]) => `${key}=${value}`).join('&');
}

/** The state a link stands for; `problems` says in words what could not be read. */
export function decodeMotionLink(hash: string): { link: MotionLink; problems: string[] } {
  const reader = createLinkReader(hash);
  const { take, takeSwitch, finish } = reader;
  const preset = take('scene', DEFAULT_PRESET, PRESET_IDS.join(', '), oneOf(PRESET_IDS));
  const models = modelsOf(preset);
  const levels = levelsOf(preset);
  const own = presetSetting(preset);
  const model = take('model', own.model, models.join(', '), oneOf(models));
  const usual = withModel(own, model);
  const steppers = STEPPER_NAMES.filter((stepper) => canRun(stepper, model));
  const stepper = take('stepper', usual.stepper, steppers.join(', '), oneOf(steppers));
  const level = take('level', own.level, `0 to ${levels.at(-1)}`, oneOf(levels));
  const start = withStepper({ ...usual, level }, stepper);
  const takeCount = (count: Count, most: number) => {
    const least = numberOf(stepperRow(stepper).settings[count]?.least ?? 1);
    return take(count, start[count], `${least} to ${most}`, wholeNumber(least, most));
  };
  const responses = ['resting', 'uniform'] as const;
  const response = take('response', 'resting', responses.join(' or '), oneOf(responses));
  const meetsItself = takeSwitch('self_contact', own.meetsItself);
  const setting: Setting = takeDetails(reader, {
    ...start,
    meetsItself: meetsItself || undefined,
    fabric: take('fabric', own.fabric, 'the name of a fabric', (text) => {
      return fabrics.find((fabric) => slug(fabric.name_en) === text)?.name_en;
    }),
    stepS: take('step', start.stepS, '1/30 to 1/960', stepFraction),
    substeps: takeCount('substeps', MOST_SUBSTEPS),
    iterations: takeCount('iterations', MOST_ITERATIONS),
    explicitShare: take('explicit', start.explicitShare, 'one of the shares offered', (text) =>
      EXPLICIT_SHARES.find((share) => text === String(100 * share)),
    ),
    hold: take('hold', own.hold, 'highest, nothing or group:NAME', holdIn),
    ...(response === 'uniform' && { bounces: true }),
    ...(own.knit && { knit: take('knit', own.knit, 'the numbers of a knit', knitIn) }),
  });
  const heat = take('heat', 'off', HEAT_MAPS.join(', '), oneOf(HEAT_MAPS));
  const range = take<MotionLink['heatRange']>('range', 'auto', 'auto or a percentage', (text) =>
    text === 'auto' ? 'auto' : oneOf(HEAT_RANGES)(text),
  );
  const [edges, springs, energy] = [
    takeSwitch('edges'),
    takeSwitch('springs'),
    takeSwitch('energy'),
  ];
  const coarse = take('coarse', 0, `0 to ${MOST_COARSE}`, wholeNumber(0, MOST_COARSE));
  const [usualMaker = ''] = LEVEL_MAKERS.slice(-1);
  const coarseAs = take('coarse_as', usualMaker, LEVEL_MAKERS.join(', '), oneOf(LEVEL_MAKERS));
  const usualStart = /^#?$/.test(hash) ? FIRST_VISIT_START_S : 0;
  const startSteps = takeStart(reader, setting.stepS, usualStart);
  const compare = takeSwitch('compare');
  const camera = take<Pose | null>('camera', null, 'six numbers', poseIn);
  const drawing = { heat, heatRange: range, edges, springs, coarse, coarseAs };
  const link = { setting, ...drawing, energy, compare, startSteps, camera };
  return { link, problems: finish() };
}
