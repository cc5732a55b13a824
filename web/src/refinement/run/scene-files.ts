// The files that a garment's scenes name, as they are handed to a module.
import skirtStart from '../../../../assets/starts/skirt.json?url';
import skirtEvenStart from '../../../../assets/starts/skirt_even.json?url';
import slimTrousersStart from '../../../../assets/starts/slim_trousers.json?url';
import slimTrousersEvenStart from '../../../../assets/starts/slim_trousers_even.json?url';
import trousersStart from '../../../../assets/starts/trousers.json?url';
import trousersEvenStart from '../../../../assets/starts/trousers_even.json?url';
import type { HandedFiles } from '../bindings/refinement-module';
import { type GarmentId, MOTION_FILES } from '../state/garments';

export type FetchBytes = (url: string) => Promise<ArrayBuffer>;

/** Starts on the fine mesh, of which all that refine the same faces take their part; and on the even one. */
type StartName = GarmentId | `${GarmentId}_even`;

const START_URLS: Record<StartName, string> = {
  skirt: skirtStart,
  skirt_even: skirtEvenStart,
  trousers: trousersStart,
  trousers_even: trousersEvenStart,
  slim_trousers: slimTrousersStart,
  slim_trousers_even: slimTrousersEvenStart,
};

const kept = new Map<StartName, Promise<string>>();

/** Text of a garment's settled state, fetched once. */
function startText(name: StartName, fetchBytes: FetchBytes): Promise<string> {
  const known = kept.get(name);
  if (known) return known;
  const text = fetchBytes(START_URLS[name]).then((bytes) => new TextDecoder().decode(bytes));
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
  const names: StartName[] = isEven ? [garment, `${garment}_even`] : [garment];
  const starts = await Promise.all(
    names.map(async (name) => [`../../starts/${name}.json`, await startText(name, fetchBytes)]),
  );
  return { ...MOTION_FILES, ...Object.fromEntries(starts) };
}
