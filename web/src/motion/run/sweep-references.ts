// Plans a sweep with the references that are shipped for it, where they are, so that the error of the mesh
// is known: on the spot a reference on a finer mesh takes minutes to hours.
import { Refused } from '../../shared/bindings/answers';
import { fabricsText } from '../../shared/fabric/fabric-data';
import { fetchedBytes } from '../../shared/page/fetched';
import { BrokenWorker } from '../../shared/workers/asked';
import type { ReferenceKind, SweepPlan } from '../state/sweep-plan';
import type { MeshError } from '../state/sweep-state';
import type { SweepClient } from './measuring-client';

type Worker = Pick<SweepClient, 'ask'>;
type PlanOf = (reference: ReferenceKind) => SweepPlan;

/** Answers with the ids of what the rows are compared with. Rejects as the worker does. */
async function plan(worker: Worker, planned: SweepPlan): Promise<string[]> {
  const message = { type: 'plan', fabricsText, planText: JSON.stringify(planned) } as const;
  return (await worker.ask(message)).references;
}

/** Plans what may be no plan for this cloth: so much finer, it may have too many vertices. */
async function planIfPossible(worker: Worker, planned: SweepPlan): Promise<string[]> {
  try {
    return await plan(worker, planned);
  } catch (error) {
    if (error instanceof Refused) return [];
    throw error;
  }
}

/** Addresses by id; null when not even these could be fetched. */
async function ladderFiles(): Promise<ReadonlyMap<string, string> | null> {
  try {
    return (await import('./ladder-files')).LADDER_FILES;
  } catch {
    return null;
  }
}

/** Fetches files and hands them over. False when that failed: what is missing is computed. */
async function handOver(worker: Worker, urls: readonly string[]): Promise<boolean> {
  try {
    const references = await Promise.all(urls.map(fetchedBytes));
    await worker.ask({ type: 'keep', references }, references);
    return true;
  } catch (error) {
    if (error instanceof BrokenWorker) throw error;
    return false;
  }
}

/**
 * Plans a sweep against references on a finer mesh, else against the exact motion of each setting's own
 * mesh. Rejects with Refused when the scene cannot be measured, and with BrokenWorker.
 */
export async function planSweep(worker: Worker, planOf: PlanOf): Promise<MeshError> {
  const files = await ladderFiles();
  const urlsOf = (ids: readonly string[]) => ids.flatMap((id) => files?.get(id) ?? []);
  const ids = await planIfPossible(worker, planOf('converged'));
  const urls = urlsOf(ids);
  const isShipped = urls.length > 0 && urls.length === ids.length;
  if (isShipped && (await handOver(worker, urls))) return 'known';
  await handOver(worker, urlsOf(await plan(worker, planOf('same_mesh'))));
  return isShipped || files === null ? 'unfetched' : 'unshipped';
}
