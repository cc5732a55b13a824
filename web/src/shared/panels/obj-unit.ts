// Choice of the unit of an OBJ file, which does not say that itself.
import { OBJ_UNITS, type ObjUnit } from '../state/obj-file';
import { choice, field } from './element';

/** Words on a visitor's mesh: its size, its unit, and what is odd about it. */
export function ownMeshWords(
  size: string,
  { objUnit, objOdd }: { objUnit: ObjUnit; objOdd: string | null },
  skipped: string | undefined,
): string {
  const unit = OBJ_UNITS.find(({ value }) => value === objUnit)?.title;
  const parts = [`${size}, taken in ${unit}.`];
  if (objOdd) parts.push(objOdd);
  if (skipped) parts.push(`${skipped}.`);
  parts.push('It stays on this machine, and no link carries it.');
  return parts.join(' ');
}

export function createObjUnit(setUnit: (unit: ObjUnit) => void) {
  const units = choice(OBJ_UNITS, setUnit);
  return { box: field('Unit of the file', units.control), select: units.select };
}
