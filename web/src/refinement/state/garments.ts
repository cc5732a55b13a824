// The garments and motions on offer, and the scene of each pane.
import liveSkirt from '../../../../assets/methods/live_skirt.json';
import squat from '../../../../assets/motions/squat.json?raw';
import turn from '../../../../assets/motions/turn.json?raw';
import walkFast from '../../../../assets/motions/walk_fast.json?raw';
import walkNormal from '../../../../assets/motions/walk_normal.json?raw';
import skirtEven from '../../../../assets/scenes/garments/skirt_even_fast_walk.json?raw';
import skirtFastWalk from '../../../../assets/scenes/garments/skirt_fast_walk.json?raw';
import skirtSquat from '../../../../assets/scenes/garments/skirt_squat.json?raw';
import skirtTurn from '../../../../assets/scenes/garments/skirt_turn.json?raw';
import skirtWalk from '../../../../assets/scenes/garments/skirt_walk.json?raw';
import slimTrousersEven from '../../../../assets/scenes/garments/slim_trousers_even_fast_walk.json?raw';
import slimTrousersFastWalk from '../../../../assets/scenes/garments/slim_trousers_fast_walk.json?raw';
import slimTrousersSquat from '../../../../assets/scenes/garments/slim_trousers_squat.json?raw';
import slimTrousersTurn from '../../../../assets/scenes/garments/slim_trousers_turn.json?raw';
import slimTrousersWalk from '../../../../assets/scenes/garments/slim_trousers_walk.json?raw';
import trousersEven from '../../../../assets/scenes/garments/trousers_even_fast_walk.json?raw';
import trousersFastWalk from '../../../../assets/scenes/garments/trousers_fast_walk.json?raw';
import trousersSquat from '../../../../assets/scenes/garments/trousers_squat.json?raw';
import trousersTurn from '../../../../assets/scenes/garments/trousers_turn.json?raw';
import trousersWalk from '../../../../assets/scenes/garments/trousers_walk.json?raw';
import type { HandedFiles } from '../bindings/refinement-module';
import type { PlanFile } from './plan-file';

export const GARMENTS = [
  { value: 'skirt', title: 'Skirt' },
  { value: 'trousers', title: 'Trousers' },
  { value: 'slim_trousers', title: 'Slim trousers' },
] as const;
export type GarmentId = (typeof GARMENTS)[number]['value'];

/** The first one is what plans are made of. */
export const MOTIONS = [
  { value: 'walk', title: 'Normal walk: the example' },
  { value: 'fast_walk', title: 'Fast walk: like the example' },
  { value: 'turn', title: 'Turn on the spot' },
  { value: 'squat', title: 'Squat: unlike the example' },
] as const;
export type MotionId = (typeof MOTIONS)[number]['value'];

/** Method of the steps of all panes: the scenes' own method, or one that shows a fine skirt while it walks. */
export const METHODS = [
  { value: 'implicit', title: 'implicit: the scenes’ own' },
  { value: 'multigrid', title: 'multigrid: computed as it walks' },
] as const;
export type MethodId = (typeof METHODS)[number]['value'];

const SCENES: Record<GarmentId, Record<MotionId, string>> = {
  skirt: { walk: skirtWalk, fast_walk: skirtFastWalk, turn: skirtTurn, squat: skirtSquat },
  trousers: {
    walk: trousersWalk,
    fast_walk: trousersFastWalk,
    turn: trousersTurn,
    squat: trousersSquat,
  },
  slim_trousers: {
    walk: slimTrousersWalk,
    fast_walk: slimTrousersFastWalk,
    turn: slimTrousersTurn,
    squat: slimTrousersSquat,
  },
};

/** The motions that the scenes name. */
export const MOTION_FILES: HandedFiles = {
  '../../motions/walk_normal.json': walkNormal,
  '../../motions/walk_fast.json': walkFast,
  '../../motions/turn.json': turn,
  '../../motions/squat.json': squat,
};

/** A mesh of other columns and rows, evenly as fine, with as many vertices as the usual plan's. */
const EVEN_SCENES: Record<GarmentId, string> = {
  skirt: skirtEven,
  trousers: trousersEven,
  slim_trousers: slimTrousersEven,
};

/** Choice of the mesh that a garment is on. */
export type GarmentMeshWish = { level: number } | { plan: PlanFile } | 'even';

interface GarmentScene {
  caption: string;
  cloth: object;
  fabric: { name: string };
  start: string;
  refinement: object;
  method: { step_s: number };
  duration_s: number;
}

function sceneOf(garment: GarmentId, motion: MotionId): GarmentScene {
  return JSON.parse(SCENES[garment][motion]) as GarmentScene;
}

/** The scene's parts by which a mesh is made, and where its cloth begins. */
function meshParts(garment: GarmentId, mesh: GarmentMeshWish) {
  if (mesh !== 'even') return { refinement: mesh };
  const { cloth, refinement, start } = JSON.parse(EVEN_SCENES[garment]) as GarmentScene;
  return { cloth, refinement, start };
}

export function captionOf(garment: GarmentId, motion: MotionId): string {
  return sceneOf(garment, motion).caption;
}

/** The fabric that a garment is made of when nobody says otherwise. */
export function usualFabric(garment: GarmentId): string {
  return sceneOf(garment, 'walk').fabric.name;
}

/** Name of the example that a motion gives a plan. */
export function exampleName(garment: GarmentId, motion: MotionId, fabric: string): string {
  const name = `${garment}_${motion}`;
  return fabric === usualFabric(garment) ? name : `${name} in ${fabric}`;
}

/** The methods that keep a garment's edges: without a hold on touched cloth, trousers stretch. */
export function methodsOf(garment: GarmentId): readonly MethodId[] {
  return garment === 'skirt' ? ['implicit', 'multigrid'] : ['implicit'];
}

/** The text of a scene on one of its meshes, with its own substeps or so many. */
export function sceneText(
  garment: GarmentId,
  motion: MotionId,
  fabric: string,
  mesh: GarmentMeshWish,
  substeps: number | null = null,
  methodId: MethodId = 'implicit',
): string {
  const scene = sceneOf(garment, motion);
  const { step_s } = scene.method;
  const usual = methodId === 'multigrid' ? { step_s, ...liveSkirt } : scene.method;
  const method = substeps === null ? usual : { ...usual, substeps };
  return JSON.stringify({
    ...scene,
    fabric: { name: fabric },
    method,
    ...meshParts(garment, mesh),
  });
}
