// What a sweep's errors are made of, and what refinement buys, in words.
import { digits } from '../../shared/panels/quantity';
import type { BenchRow } from '../bindings/sweep-module';
import { hasFinished, REFERENCE_LEVEL } from '../state/sweep-plan';
import type { MeshError } from '../state/sweep-state';
import { meshText } from './speed-error-table';

const OWN_MESH =
  'is what a method does wrong on its own mesh. What the mesh does wrong is not in it, and not known here:';

const WHAT_ERRORS_ARE: Record<MeshError, string> = {
  known: `is the distance from the exact motion on the finer mesh of level ${REFERENCE_LEVEL}: the method and its mesh both have their share. A line marks what each level’s mesh does wrong alone; a method gets below it by luck at most.`,
  unshipped: `${OWN_MESH} the finer motion to compare with comes with the swinging sheet as it is, of springs. Others take from minutes to hours, and cloth that folds finds other folds on every mesh.`,
  unfetched: `${OWN_MESH} the finer motion to compare with could not be fetched. Check the connection.`,
};

/** What the errors of a sweep over so long [s] are. */
export function errorSentence(meshError: MeshError, durationS: number): string {
  return `The error, over ${digits(durationS, 1)} s, ${WHAT_ERRORS_ARE[meshError]}`;
}

/** What the mesh does wrong from level to level; empty for fewer than two. */
export function refinementSentence(rows: readonly BenchRow[]): string {
  const ofLevels = new Map(rows.filter(hasFinished).map((row) => [row.level, row]));
  const words = [...ofLevels.values()]
    .sort((a, b) => a.level - b.level)
    .map((row) => `${meshText(row, 'known')} at level ${row.level}`);
  return words.length < 2 ? '' : `What the mesh does wrong: ${words.join(', ')}.`;
}
