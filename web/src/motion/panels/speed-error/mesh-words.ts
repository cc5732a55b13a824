// Words on what a sweep's errors are made of, and on what refinement buys.
import { digits, smallLength, stepTitle } from '../../../shared/panels/quantity';
import { STEPPERS } from '../../../shared/steppers/steppers';
import type { BenchRow } from '../../bindings/sweep-module';
import { hasFinished, REFERENCE_LEVEL } from '../../state/sweep-plan';
import type { MeshError } from '../../state/sweep-state';
import { boundOf } from './mesh-floors';

const OWN_MESH =
  'is what a method does wrong on its own mesh. What the mesh does wrong is not in it, and not known here:';

const WHAT_ERRORS_ARE: Record<MeshError, string> = {
  known: `is the distance from the exact motion on the finer mesh of level ${REFERENCE_LEVEL}: the method and its mesh both have their share. A line marks what each level’s mesh does wrong alone; a method gets below it by luck at most.`,
  unshipped: `${OWN_MESH} the finer motion to compare with comes with the swinging sheet as it is, of springs. Others take from minutes to hours, and cloth that folds finds other folds on every mesh.`,
  unfetched: `${OWN_MESH} the finer motion to compare with could not be fetched. Check the connection.`,
};

const ERRORS_OF_METHODS =
  'Compare methods within one level only: each is held against the exact motion on its own mesh.';

/** A method that is so many times as wrong as its mesh is what is wrong. */
const MUCH = 3;

/** An error that keeps so much of itself on a finer mesh gained nothing from it. */
const HARDLY_LESS = 0.8;

/** Words on what the errors of a sweep over so long [s] are. */
export function errorSentence(meshError: MeshError, durationS: number): string {
  return `The error, over ${digits(durationS, 1)} s, ${WHAT_ERRORS_ARE[meshError]}`;
}

/** Name of the errors: only those against one and the same motion have the mesh in them. */
export function errorName(meshError: MeshError): string {
  return meshError === 'known' ? 'Error' : 'Method’s error';
}

/** Error of the mesh of a row [m], or a bound that it is below; null where its reference tells neither. */
function mostOfMesh(row: BenchRow): number | null {
  return row.mesh_error_m ?? boundOf(row);
}

/** Words on the error of the mesh of a row, as far as its reference tells; `below` goes before a bound. */
export function meshText(row: BenchRow, meshError: MeshError, below = '<'): string {
  if (meshError !== 'known' || row.mesh_error_m !== null) return smallLength(row.mesh_error_m);
  const bound = boundOf(row);
  return bound === null ? smallLength(null) : `${below} ${smallLength(bound)}`;
}

/** Words on the error of the mesh from level to level; empty before a row has finished. */
function refinementSentence(rows: readonly BenchRow[]): string {
  const ofLevels = new Map(rows.filter(hasFinished).map((row) => [row.level, row]));
  const meshes = [...ofLevels.values()].sort((a, b) => a.level - b.level);
  const [first, ...finer] = meshes;
  const last = finer.at(-1);
  if (!first) return '';
  const wordsOf = (row: BenchRow) => `${meshText(row, 'known', 'below')} at level ${row.level}`;
  if (!last) return `Error of the mesh: ${wordsOf(first)}.`;
  const isOneFiner = finer.length === 1 && last.level === first.level + 1;
  const isTold = first.mesh_error_m !== null;
  const falls = (mostOfMesh(last) ?? Number.POSITIVE_INFINITY) < (mostOfMesh(first) ?? 0);
  const verb = isTold && falls ? 'falls from' : 'goes from';
  return `${isOneFiner ? 'One level finer' : 'Level by level'}: the error of the mesh ${verb} ${wordsOf(first)} to ${finer.map(wordsOf).join(', to ')}.`;
}

/** The answer of a sweep so far. */
export function headline(rows: readonly BenchRow[], meshError: MeshError): string {
  return meshError === 'known' ? refinementSentence(rows) : ERRORS_OF_METHODS;
}

/** The method's error is much the larger part of the row's. */
function isOfMethod(row: BenchRow): boolean {
  const { method_error_m: method, position_error_m: error } = row;
  const mesh = mostOfMesh(row);
  return method !== null && error !== null && mesh !== null && method > MUCH * mesh;
}

/** Names the steppers whose errors a finer mesh leaves as they are, each in its longest steps. */
export function methodSentence(rows: readonly BenchRow[], meshError: MeshError): string {
  if (meshError !== 'known') return '';
  const words = STEPPERS.flatMap(({ name, title }) => {
    const own = rows.filter((row) => row.method.stepper === name && hasFinished(row));
    const stepOf = (row: BenchRow) => row.method.step_s / row.n_substeps;
    const longestS = Math.max(...own.map(stepOf));
    const taken = own.filter((row) => stepOf(row) === longestS).sort((a, b) => a.level - b.level);
    const errors = taken.map((row) => row.position_error_m ?? 0);
    const isSame = (errors.at(-1) ?? 0) > HARDLY_LESS * (errors[0] ?? 0);
    if (taken.length < 2 || !taken.every(isOfMethod) || !isSame) return [];
    const lengths = errors.map((metres) => digits(1000 * metres, 2)).join(' → ');
    return [`${title} at ${stepTitle(longestS)} ${lengths} mm`];
  });
  return words.length === 0
    ? ''
    : `Where the method, not the mesh, is what is wrong, a finer mesh gains nothing and shorter steps help: ${words.join(', ')}.`;
}
