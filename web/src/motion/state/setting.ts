// The setting to compute: preset, fabric, model, level, method. The scene text given to the module
// is made here.
import ballText from '../../../../assets/scenes/ball.json?raw';
import curtainText from '../../../../assets/scenes/curtain.json?raw';
import flagText from '../../../../assets/scenes/flag.json?raw';
import freeFallText from '../../../../assets/scenes/free_fall_drape.json?raw';
import pendulumText from '../../../../assets/scenes/pendulum_10x10.json?raw';
import skirtText from '../../../../assets/scenes/skirt.json?raw';
import swagsText from '../../../../assets/scenes/swags.json?raw';
import swingingSheetText from '../../../../assets/scenes/swinging_sheet.json?raw';
import tableclothText from '../../../../assets/scenes/tablecloth.json?raw';
import tearingCurtainText from '../../../../assets/scenes/tearing_curtain.json?raw';
import windText from '../../../../assets/scenes/wind.json?raw';
import woolText from '../../../../assets/scenes/wool.json?raw';
import type { OwnQuantities } from '../../shared/fabric/fabric-data';
import {
  type Count,
  canRun,
  type DetailValue,
  METHOD_DETAILS,
  type Model,
  numberOf,
  STABLE_SUBSTEPS,
  STEPPER_NAMES,
  type Substeps,
  stepperRow,
} from '../../shared/steppers/steppers';
import { type Knit, knitOf, knitSection } from './knit';
import { leastSubsteps } from './least-substeps';
import { type Hold, type ObjMesh, objScene } from './obj-mesh';

/** Values by the keys of the table of details. */
export type Details = Readonly<Record<string, DetailValue>>;

export interface Setting {
  preset: PresetId;
  /** English name in the fabric file. */
  fabric: string;
  model: Model;
  /** Uniform refinement: each level halves the mesh size. */
  level: number;
  stepper: string;
  /** Time that one step advances [s]. */
  stepS: number;
  /** 0: as many as the stability bound asks for. */
  substeps: number;
  iterations: number;
  /** imex: share of the springs that shall be explicit at least, for which it takes more substeps. */
  explicitShare: number;
  /** Details of the method, where they are not what its stepper starts from. */
  details?: Details;
  /** The vertices that hold the mesh; of no meaning to other presets. */
  hold: Hold;
  /** Numbers of the knit of a preset whose cloth is knitted. */
  knit?: Knit;
  /** The cloth bounces off solids, for comparison. */
  bounces?: boolean;
  /** The cloth does not pass through itself. */
  meetsItself?: true;
}

interface SceneFile {
  name: string;
  caption: string;
  cloth: {
    sheet?: { columns: number; rows: number };
    mesh?: object;
    knit?: Record<string, unknown>;
  };
  fabric: { name: string; overrides?: OwnQuantities };
  model?: { tearing?: object; [law: string]: unknown };
  world?: { self_contact?: boolean | object; [part: string]: unknown };
  refinement?: { level?: number };
  method: {
    stepper: string;
    step_s: number;
    substeps?: Substeps;
    iterations?: number;
    explicit_share?: number;
    [detail: string]: unknown;
  };
  duration_s?: number;
  [part: string]: unknown;
}

export interface Preset {
  title: string;
  caption: string;
  scene: SceneFile;
}

export const MODELS: readonly Model[] = ['springs', 'membrane'];
export const LEVELS: readonly number[] = [0, 1, 2, 3, 4];
/** Steps offered, as fractions of a second: 1/30 s to 1/960 s. */
export const STEPS_PER_SECOND: readonly number[] = [30, 60, 120, 240, 480, 960];
export const MOST_SUBSTEPS = 100000;
export const MOST_ITERATIONS = 500;

/** Least shares of explicit springs that are offered. */
export const EXPLICIT_SHARES: readonly number[] = [0, 0.25, 0.5, 0.75, 0.9, 1];

/** Sliders of counts end here; fields take more. */
const SLIDER_MOST = 480;

/** The counts that a slider offers: all small ones, then ever fewer, each about an eighth more. */
export function sliderCounts(least: number): number[] {
  const counts: number[] = [];
  let count = least;
  while (count <= SLIDER_MOST) {
    counts.push(count);
    count += Math.max(1, 2 ** Math.floor(Math.log2(count)) / 8);
  }
  return counts;
}

/** `need`: why a scene may not have it. */
export const MODEL_TRAITS: Record<Model, { title: string; meaning: string; need: string }> = {
  springs: {
    title: 'Springs',
    meaning: 'A fast approximation, along the threads of a sheet.',
    need: 'Springs need the threads of a sheet.',
  },
  membrane: {
    title: 'Membrane and fitted bending',
    meaning: 'Cloth as a continuous surface: right on any mesh, and slower.',
    need: 'A knit is particles on springs of their own.',
  },
};

export const COUNTS: readonly Count[] = ['substeps', 'iterations'];

function presetFrom(title: string, text: string): Preset {
  const scene = JSON.parse(text) as SceneFile;
  return { title, caption: scene.caption, scene };
}

const OBJ: Preset = {
  title: 'Your OBJ',
  scene: {
    ...(JSON.parse(skirtText) as SceneFile),
    // A mesh of some thousand triangles keeps up with the clock, or nearly.
    method: { stepper: 'implicit', step_s: 1 / 60, substeps: 1, tolerance: 0.01 },
  },
  caption:
    'Any triangle mesh becomes cloth. Drop an OBJ file anywhere on this page, or choose one; until then a half-circle skirt stands in.',
};

export const PRESETS = {
  curtain: presetFrom('Curtain', curtainText),
  swags: presetFrom('Curtain on three hooks', swagsText),
  'tearing-curtain': presetFrom('Tearing curtain', tearingCurtainText),
  flag: presetFrom('Flag in the wind', flagText),
  tablecloth: presetFrom('Tablecloth on a ball', tableclothText),
  'swinging-sheet': presetFrom('Swinging sheet', swingingSheetText),
  'free-fall-drape': presetFrom('Free-fall drape', freeFallText),
  wind: presetFrom('Wind', windText),
  ball: presetFrom('Ball', ballText),
  pendulum: presetFrom('Pendulum 10 × 10', pendulumText),
  wool: presetFrom('Wool on a ball', woolText),
  obj: OBJ,
};
export type PresetId = keyof typeof PRESETS;

export const PRESET_IDS = Object.keys(PRESETS) as PresetId[];

/** The models that a preset's cloth can have: springs follow the threads of a sheet, and a knit is springs. */
export function modelsOf(preset: PresetId): Model[] {
  const { sheet, knit } = PRESETS[preset].scene.cloth;
  if (knit) return ['springs'];
  return sheet ? ['springs', 'membrane'] : ['membrane'];
}

/** The refinement levels that a preset's cloth can have: a knit has the particles that it has. */
export function levelsOf(preset: PresetId): readonly number[] {
  return PRESETS[preset].scene.cloth.knit ? [0] : LEVELS;
}

/** Why a level is not offered with the stepper of a setting; null where it is. */
export function levelNeed({ preset, stepper }: Setting, level: number): string | null {
  // No number of substeps up to 64 holds it.
  return preset === 'curtain' && stepper === 'hpbd' && level === 0
    ? 'Too coarse for this method.'
    : null;
}

/** Both counts of a method, with the stepper's own start where the method says nothing. */
function countsOf(stepper: string, method: { substeps?: Substeps; iterations?: number }) {
  const { settings } = stepperRow(stepper);
  return {
    substeps: numberOf(method.substeps ?? settings.substeps?.start ?? 1),
    iterations: numberOf(method.iterations ?? settings.iterations?.start ?? 1),
  };
}

/** The details of a method that are not what its stepper starts from, in their order; none when all are. */
export function detailsOf(
  stepper: string,
  method: Readonly<Record<string, unknown>>,
): Details | undefined {
  const own = Object.entries(stepperRow(stepper).details)
    .map(([key, start]): [string, DetailValue] => [key, (method[key] as DetailValue) ?? start])
    .filter(([key, value]) => value !== stepperRow(stepper).details[key]);
  return own.length > 0 ? Object.fromEntries(own) : undefined;
}

/** The value of a detail. */
export function detailOf(
  { stepper, details }: Pick<Setting, 'stepper' | 'details'>,
  key: string,
): DetailValue | undefined {
  return details?.[key] ?? stepperRow(stepper).details[key];
}

export function withDetail(setting: Setting, key: string, value: DetailValue | undefined): Setting {
  const { stepper, details } = setting;
  return { ...setting, details: detailsOf(stepper, { ...details, [key]: value }) };
}

/** The method makes use of a detail. */
export function isRead(setting: Setting, key: string): boolean {
  const beside = METHOD_DETAILS.find((detail) => detail.key === key)?.beside;
  const isBeside = ([other, words]: [string, readonly string[]]) =>
    words.includes(String(detailOf(setting, other)));
  return detailOf(setting, key) !== undefined && (!beside || Object.entries(beside).some(isBeside));
}

/** Presets whose cloth takes so many times the substeps of others: one swings down, and knits are loose. */
const HARDER: Partial<Record<PresetId, number>> = { pendulum: 2, wool: 3 };

/** Substeps with which a stepper holds a preset's cloth together; a preset has its own as far as it is made for. */
function startSubsteps({ preset, level, stepper, stepS, substeps, knit }: Setting): number {
  const { cloth, method, refinement } = PRESETS[preset].scene;
  const isMade = method.stepper === stepper && level <= (refinement?.level ?? 0);
  const mesh = knit ?? cloth.sheet;
  if (isMade || substeps === 0 || !mesh) return substeps;
  const nCells = Math.max(mesh.columns, mesh.rows) * 2 ** level;
  const hardness = HARDER[preset] ?? 1;
  return Math.max(substeps, leastSubsteps(stepperRow(stepper), hardness * nCells, stepS));
}

/** The setting a preset is made for. */
export function presetSetting(preset: PresetId): Setting {
  const { fabric, refinement, method, cloth, world } = PRESETS[preset].scene;
  return {
    preset,
    fabric: fabric.name,
    model: modelsOf(preset)[0] ?? 'membrane',
    level: refinement?.level ?? 0,
    stepper: method.stepper,
    stepS: method.step_s,
    ...countsOf(method.stepper, method),
    explicitShare: method.explicit_share ?? 0,
    details: detailsOf(method.stepper, method),
    hold: 'highest',
    ...(cloth.knit && { knit: knitOf(cloth.knit) }),
    ...(world?.self_contact && { meetsItself: true }),
  };
}

/** A setting under another stepper, with the counts and details that it starts with on such a mesh. */
export function withStepper(setting: Setting, stepper: string): Setting {
  const { method: own } = PRESETS[setting.preset].scene;
  const method = own.stepper === stepper ? own : {};
  const start = { ...setting, stepper, ...countsOf(stepper, method) };
  return { ...start, substeps: startSubsteps(start), details: detailsOf(stepper, method) };
}

/** A setting on another mesh. Substeps that nobody has chosen are those that the stepper starts with there. */
export function withLevel(setting: Setting, level: number): Setting {
  const { substeps } = withStepper(setting, setting.stepper);
  if (substeps !== setting.substeps) return { ...setting, level };
  return {
    ...setting,
    level,
    substeps: withStepper({ ...setting, level }, setting.stepper).substeps,
  };
}

/** A setting with another model, under the first stepper that can run it if its own cannot. */
export function withModel(setting: Setting, model: Model): Setting {
  const stepper = [setting.stepper, ...STEPPER_NAMES].find((name) => canRun(name, model));
  const isOther = stepper !== undefined && stepper !== setting.stepper;
  return { ...(isOther ? withStepper(setting, stepper) : setting), model };
}

/** Share of the springs that shall be explicit at least, of a stepper that parts them. */
export function wantedShare({ stepper, explicitShare }: Setting): number {
  return stepper === 'imex' ? explicitShare : 0;
}

/** The `method` part of a scene: only what the stepper listens to, and the preset's fine print. */
export function methodOf(setting: Setting): Record<string, unknown> {
  const own = PRESETS[setting.preset].scene.method;
  const method: Record<string, unknown> = own.stepper === setting.stepper ? { ...own } : {};
  const { settings, details } = stepperRow(setting.stepper);
  for (const key of Object.keys(details)) delete method[key];
  Object.assign(method, setting.details);
  for (const key of Object.keys(details)) if (!isRead(setting, key)) delete method[key];
  method.stepper = setting.stepper;
  method.step_s = setting.stepS;
  for (const count of COUNTS) if (settings[count]) method[count] = setting[count];
  if (method.substeps === 0) method.substeps = STABLE_SUBSTEPS;
  if (wantedShare(setting) > 0) method.explicit_share = setting.explicitShare;
  return method;
}

/** The fabric, with the numbers that a preset has of its own only where it is the preset's. */
function fabricOf({ preset, fabric }: Setting): SceneFile['fabric'] {
  const own = PRESETS[preset].scene.fabric;
  return own.name === fabric ? own : { name: fabric };
}

/** The numbers that the scene has in place of the fabric's. */
export function ownQuantities(setting: Setting): OwnQuantities {
  return fabricOf(setting).overrides ?? {};
}

/** A preset's own words on its model hold for the model that it is made for; that it tears, for each. */
function modelOf({ preset, model }: Setting): object {
  const { model: words } = PRESETS[preset].scene;
  const own = model === modelsOf(preset)[0] ? words : words && { tearing: words.tearing };
  return { ...own, elasticity: model };
}

/** Numbers that a preset has of contact with itself hold wherever there is any. */
function worldOf({ preset, bounces, meetsItself }: Setting): object {
  const { self_contact: own, ...world } = PRESETS[preset].scene.world ?? {};
  return {
    ...world,
    ...(bounces && { contact_response: 'uniform' }),
    ...(meetsItself && { self_contact: own || true }),
  };
}

/** The scene as the module reads it; `mesh` is the cloth of the preset that is any mesh. */
export function sceneOf(setting: Setting, mesh: ObjMesh | null = null): Record<string, unknown> {
  const scene: Record<string, unknown> = {
    ...PRESETS[setting.preset].scene,
    fabric: fabricOf(setting),
    model: modelOf(setting),
    world: worldOf(setting),
    refinement: { level: setting.level },
    method: methodOf(setting),
  };
  const { knit } = PRESETS[setting.preset].scene.cloth;
  if (knit && setting.knit) return { ...scene, cloth: { knit: knitSection(knit, setting.knit) } };
  if (setting.preset !== 'obj' || !mesh) return scene;
  const { cloth, pins, colliders } = objScene(mesh, setting.hold);
  const world = { ...worldOf(setting), colliders };
  return { ...scene, cloth, pins, world };
}

/** True when both settings compute the same thing, whatever an unused count says. */
export function isSameMethod(a: Setting, b: Setting): boolean {
  const { settings, details } = stepperRow(a.stepper);
  // Steps are fractions of a second that went through text: an ulp apart is the same.
  const isSameStep = Math.abs(a.stepS - b.stepS) < 1e-9;
  return (
    a.stepper === b.stepper &&
    isSameStep &&
    wantedShare(a) === wantedShare(b) &&
    COUNTS.every((count) => !settings[count] || a[count] === b[count]) &&
    Object.keys(details).every((key) => detailOf(a, key) === detailOf(b, key))
  );
}
