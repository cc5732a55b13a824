// The references that are shipped: runs of a preset as it is, which the shown cloth is compared with.
import { presetSetting, type Setting } from '../state/setting';

const FILES = import.meta.glob<string>('../../../../assets/references/*.reference', {
  query: '?url',
  import: 'default',
  eager: true,
});

/** The address of a setting's reference, by the names "curtain" and "curtain_membrane". */
export function referenceUrl({ preset, fabric, model, meetsItself }: Setting): string | null {
  const own = presetSetting(preset);
  // It could not match: half a megabyte for nothing.
  if (fabric !== own.fabric || meetsItself !== own.meetsItself) return null;
  const scene = preset.replaceAll('-', '_');
  const name = model === own.model ? scene : `${scene}_${model}`;
  return FILES[`../../../../assets/references/${name}.reference`] ?? null;
}
