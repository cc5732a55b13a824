// Choice of the unit of an OBJ file, which does not say that itself.
import { OBJ_UNITS, type ObjUnit } from '../state/obj-file';
import { choice, field } from './element';

export function createObjUnit(setUnit: (unit: ObjUnit) => void) {
  const units = choice(OBJ_UNITS, setUnit);
  return { box: field('Unit of the file', units.control), select: units.select };
}
