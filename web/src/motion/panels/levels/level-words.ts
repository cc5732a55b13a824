// Words on what a coarser level is.
import type { MeshLevels } from '../../../shared/bindings/pleat-module';
import { digits } from '../../../shared/panels/quantity';

/** The level that is shown of those that are there, with what it has of the one before; null: none. */
export function levelCounts({ levels }: MeshLevels, coarse: number, nMesh: number) {
  const level = Math.min(coarse, levels.length);
  const [own, before] = [levels[level - 1], levels[level - 2]];
  if (!own) return null;
  const [n, nBefore] = [own.vertices.length, before?.vertices.length ?? nMesh];
  return { level, n, nBefore, nOut: nBefore - n, nEdges: own.edges.length / 2 };
}

/** So near to two that it is called "every other one". */
const NEARLY_TWO = 0.2;

/** Words for this many of so many: "every other one", "one in 4". */
function shareText(n: number, of: number): string {
  if (Math.abs(of / n - 2) < NEARLY_TWO) return 'every other one';
  return `one in ${digits(of / n, 2).replace(/\.0$/, '')}`;
}

export function levelName(level: number): string {
  return level === 0 ? 'the mesh' : `level ${level}`;
}

/** How many vertices the shown level keeps, and why there are no more levels. */
export function levelWords(found: MeshLevels, coarse: number, nMesh: number): string {
  const counts = levelCounts(found, coarse, nMesh);
  if (!counts) return `No coarser level: ${found.shortage}.`;
  const { level, n, nBefore } = counts;
  const of = level === 1 ? `the mesh’s ${nBefore}` : `the ${nBefore} of ${levelName(level - 1)}`;
  const all = level === 1 ? '' : `, and of the mesh’s ${nMesh} ${shareText(n, nMesh)}`;
  const end = found.shortage === '' ? '' : ' This mesh has no coarser ones.';
  return `Level ${level} keeps ${n} vertices: of ${of} ${shareText(n, nBefore)}${all}.${end}`;
}
