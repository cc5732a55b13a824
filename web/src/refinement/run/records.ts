// The frames that come with the page. They are made by `npm run recordings`.
import type { GarmentId, MotionId } from '../state/garments';
import type { PaneId } from '../state/refinement-state';

const URLS = import.meta.glob<string>('../../../../assets/recordings/*/*', {
  query: '?url',
  import: 'default',
  eager: true,
});

function urlOf(folder: string, file: string): string | null {
  return URLS[`../../../../assets/recordings/${folder}/${file}`] ?? null;
}

/** Address of a pane's record, in the garment's usual fabric and by its usual plan. */
export function recordUrl(garment: GarmentId, motion: MotionId, pane: PaneId): string | null {
  return urlOf(`${garment}_${motion}`, `${pane}.recording`);
}

/** Address of how far apart two runs on the fine mesh are. */
export function floorUrl(garment: GarmentId, motion: MotionId): string | null {
  return urlOf(`${garment}_${motion}`, 'floor.json');
}

export interface ExampleUrls {
  plan: string;
  features: string;
  frames: string;
}

/** Addresses of the usual plan and of the example that plans are made of. */
export function exampleUrls(garment: GarmentId): ExampleUrls | null {
  const folder = `${garment}_walk`;
  const plan = urlOf(folder, 'plan.json');
  const features = urlOf(folder, 'features.recording');
  const frames = urlOf(folder, 'example.recording');
  return plan && features && frames ? { plan, features, frames } : null;
}
