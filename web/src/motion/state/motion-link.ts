// The state that a link carries, to text and back. A part that cannot be read gives its default
// and one sentence; it never stops the page.
import { fabrics } from '../../shared/fabric/fabric-data';
import type { HeatMap } from '../../shared/stage/heat-map';
import { createLinkReader, oneOf, slug } from '../../shared/state/link-reader';
import { type Count, canRun, STEPPER_NAMES, stepperRow } from '../../shared/steppers/steppers';
import type { Hold } from './obj-mesh';
import {
  LEVELS,
  MOST_ITERATIONS,
  MOST_SUBSTEPS,
  modelsOf,
  PRESET_IDS,
  type PresetId,
  presetSetting,
  type Setting,
  STEPS_PER_SECOND,
  withModel,
  withStepper,
} from './setting';

export interface MotionLink {
  setting: Setting;
  heat: HeatMap;
  /** Upper end of the scale of stretch [%], or chosen from the frame. */
  heatRange: 'auto' | number;
  edges: boolean;
  /** Simulated time that is run through before the cloth is shown [s]. */
  startS: number;
}

export const HEAT_MAPS: readonly HeatMap[] = ['off', 'magnitude', 'signed', 'distance'];
export const HEAT_RANGES: readonly number[] = [0.5, 1, 2, 5, 10];
const DEFAULT_PRESET: PresetId = 'curtain';
const LATEST_START_S = 10;
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
  const value = /^\d{1,2}(\.\d)?$/.test(text) ? Number(text) : Number.NaN;
  return value <= LATEST_START_S ? value : undefined;
}

function holdIn(text: string): Hold | undefined {
  if (text === 'highest' || text === 'nothing') return text;
  return text.startsWith('group:') ? (text as Hold) : undefined;
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
    ['start', String(link.startS)],
  ];
  if (setting.preset === 'obj') parts.push(['hold', encodeURIComponent(setting.hold)]);
  return parts.map(([key, value]) => `${key}=${value}`).join('&');
}

/** The state a link stands for; `problems` says in words what could not be read. */
export function decodeMotionLink(hash: string): { link: MotionLink; problems: string[] } {
  const text = hash.replace(/^#/, '');
  const { take, finish } = createLinkReader(new URLSearchParams(text));
  const preset = take('scene', DEFAULT_PRESET, PRESET_IDS.join(', '), oneOf(PRESET_IDS));
  const models = modelsOf(preset);
  const own = presetSetting(preset);
  const model = take('model', own.model, models.join(', '), oneOf(models));
  const usual = withModel(own, model);
  const steppers = STEPPER_NAMES.filter((stepper) => canRun(stepper, model));
  const stepper = take('stepper', usual.stepper, steppers.join(', '), oneOf(steppers));
  const start = withStepper(usual, stepper);
  const takeCount = (count: Count, most: number) => {
    const least = stepperRow(stepper).settings[count]?.least ?? 1;
    return take(count, start[count], `${least} to ${most}`, wholeNumber(least, most));
  };
  const setting: Setting = {
    preset,
    fabric: take('fabric', own.fabric, 'the name of a fabric', (text) => {
      return fabrics.find((fabric) => slug(fabric.name_en) === text)?.name_en;
    }),
    model,
    level: take('level', own.level, '0 to 4', oneOf(LEVELS)),
    stepper,
    stepS: take('step', start.stepS, '1/30 to 1/960', stepFraction),
    substeps: takeCount('substeps', MOST_SUBSTEPS),
    iterations: takeCount('iterations', MOST_ITERATIONS),
    hold: take('hold', own.hold, 'highest, nothing or group:NAME', holdIn),
  };
  const heat = take('heat', 'off', HEAT_MAPS.join(', '), oneOf(HEAT_MAPS));
  const range = take<MotionLink['heatRange']>('range', 'auto', 'auto or a percentage', (text) =>
    text === 'auto' ? 'auto' : oneOf(HEAT_RANGES)(text),
  );
  const edges = take('edges', 'off', 'on or off', oneOf(['on', 'off'])) === 'on';
  const usualStart = text === '' ? FIRST_VISIT_START_S : 0;
  const startS = take('start', usualStart, `0 to ${LATEST_START_S} s`, startTime);
  return { link: { setting, heat, heatRange: range, edges, startS }, problems: finish() };
}
