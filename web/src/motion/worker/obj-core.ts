// Reads an OBJ file into the section "cloth" of a scene, as a function of the module.
// The only file that calls delete() on its object.
import { granted } from '../../shared/bindings/answers';
import type { ObjAnswer, PleatModule } from '../../shared/bindings/pleat-module';
import { refusalOf } from '../../shared/bindings/refusals';
import { DIRECTIONS, liesFlat, objMesh } from '../state/obj-mesh';
import type { FromObj, ToObj } from './obj-protocol';

export function readObj(module: Pick<PleatModule, 'Scene'>, message: ToObj): FromObj {
  const { fabricsText, objText, file } = message;
  const { name, low, high } = file;
  const scene = new module.Scene(fabricsText);
  try {
    const threads = liesFlat({ low, high }) ? 'along_x' : 'down';
    const meshText = JSON.stringify({ obj: name, warp_direction: DIRECTIONS[threads] });
    const answer = granted<ObjAnswer>(scene.readObj(objText, meshText));
    const known = answer.needs_direction ? threads : 'texture';
    const { isOwn, unit, odd } = file;
    return { type: 'objRead', mesh: objMesh({ name, isOwn, unit, odd, threads: known }, answer) };
  } catch (error) {
    return refusalOf(error);
  } finally {
    scene.delete();
  }
}
