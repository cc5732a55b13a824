// The files that a garment's scenes name, as they are handed to a module.
import type { HandedFiles } from '../bindings/refinement-module';
import { type GarmentId, MOTION_FILES } from '../state/garments';

export type FetchBytes = (url: string) => Promise<ArrayBuffer>;

/** Starts on the fine mesh, of which all that refine the same faces take their part; and on the even one. */
const START_URLS = import.meta.glob<string>('../../../../assets/starts/*.json', {
  query: '?url',
  import: 'default',
  eager: true,
});

const kept = new Map<string, Promise<string>>();

/** Text of a garment's settled state, fetched once. */
function startText(name: string, fetchBytes: FetchBytes): Promise<string> {
  const known = kept.get(name);
  if (known) return known;
  const url = START_URLS[`../../../../assets/starts/${name}.json`] ?? '';
  const text = fetchBytes(url).then((bytes) => new TextDecoder().decode(bytes));
  kept.set(name, text);
  text.catch(() => kept.delete(name));
  return text;
}

/** The motions, and where the garment has settled on the meshes that are asked for. */
export async function sceneFiles(
  garment: GarmentId,
  fetchBytes: FetchBytes,
  isEven = false,
): Promise<HandedFiles> {
  const names = isEven ? [garment, `${garment}_even`] : [garment];
  const starts = await Promise.all(
    names.map(async (name) => [`../../starts/${name}.json`, await startText(name, fetchBytes)]),
  );
  return { ...MOTION_FILES, ...Object.fromEntries(starts) };
}
