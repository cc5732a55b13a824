// The files that a garment's scenes name, as they are handed to a module.
import skirtStart from '../../../../assets/starts/skirt.json?url';
import trousersStart from '../../../../assets/starts/trousers.json?url';
import type { HandedFiles } from '../bindings/refinement-module';
import { type GarmentId, MOTION_FILES } from '../state/garments';

export type FetchBytes = (url: string) => Promise<ArrayBuffer>;

const START_URLS: Record<GarmentId, string> = { skirt: skirtStart, trousers: trousersStart };

const kept = new Map<GarmentId, Promise<HandedFiles>>();

async function fetchFiles(garment: GarmentId, fetchBytes: FetchBytes): Promise<HandedFiles> {
  const start = new TextDecoder().decode(await fetchBytes(START_URLS[garment]));
  return { ...MOTION_FILES, [`../../starts/${garment}.json`]: start };
}

/** Fetches where the garment has settled, once, and adds the motions. */
export function sceneFiles(garment: GarmentId, fetchBytes: FetchBytes): Promise<HandedFiles> {
  const known = kept.get(garment);
  if (known) return known;
  const files = fetchFiles(garment, fetchBytes);
  kept.set(garment, files);
  files.catch(() => kept.delete(garment));
  return files;
}
