// The garments and motions on offer, and the scene of each pane.
import liveSkirt from '../../../../assets/methods/live_skirt.json';
import type { HandedFiles } from '../bindings/refinement-module';
import type { PlanFile } from './plan-file';

const SCENES = import.meta.glob<string>('../../../../assets/scenes/garments/*.json', {
  query: '?raw',
  import: 'default',
  eager: true,
});

const MOTION_TEXTS = import.meta.glob<string>(
  '../../../../assets/motions/{squat,turn,walk_fast,walk_normal}.json',
  { query: '?raw', import: 'default', eager: true },
);

export const GARMENTS = [
  { value: 'skirt', title: 'Skirt' },
  { value: 'trousers', title: 'Trousers' },
  { value: 'slim_trousers', title: 'Slim trousers' },
] as const;
export type GarmentId = (typeof GARMENTS)[number]['value'];

/** The first one is what plans are made of. Whether others are like it, the light tells. */
export const MOTIONS = [
  { value: 'walk', title: 'Normal walk' },
  { value: 'fast_walk', title: 'Fast walk' },
  { value: 'turn', title: 'Turn on the spot' },
  { value: 'squat', title: 'Squat' },
] as const;
export type MotionId = (typeof MOTIONS)[number]['value'];

/** Method of the steps of all panes: the scenes' own method, or one that shows a fine skirt while it walks. */
export const METHODS = [
  { value: 'implicit', title: 'Careful (slow)' },
  { value: 'multigrid', title: 'Live' },
] as const;
export type MethodId = (typeof METHODS)[number]['value'];

/** The motions, by the names that the scenes have for them. */
export const MOTION_FILES: HandedFiles = Object.fromEntries(
  Object.entries(MOTION_TEXTS).map(([path, text]) => [
    path.replace(/^.*\/motions/, '../../motions'),
    text,
  ]),
);

/** Choice of the mesh that a garment is on. */
export type GarmentMeshWish = { level: number } | { plan: PlanFile } | 'even';

interface GarmentScene {
  cloth: object;
  fabric: { name: string };
  start: string;
  refinement: object;
  method: { step_s: number };
  duration_s: number;
}

function sceneOf(garment: GarmentId, motion: MotionId | 'even_fast_walk'): GarmentScene {
  const text = SCENES[`../../../../assets/scenes/garments/${garment}_${motion}.json`];
  if (!text) throw new Error(`no scene of the ${garment} has a ${motion}`);
  return JSON.parse(text) as GarmentScene;
}

/**
 * The scene's parts by which a mesh is made, and where its cloth begins. The even mesh has other columns and
 * rows, evenly as fine, and as many vertices as the usual plan's.
 */
function meshParts(garment: GarmentId, mesh: GarmentMeshWish) {
  if (mesh !== 'even') return { refinement: mesh };
  const { cloth, refinement, start } = sceneOf(garment, 'even_fast_walk');
  return { cloth, refinement, start };
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
