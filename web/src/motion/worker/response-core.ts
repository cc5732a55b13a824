// Studies what a cloth does after its first contact, as a function of the module. Deletes what it makes.
import { describe, internalFailure, read } from '../../shared/bindings/answers';
import type { PleatModule, ResponseStudy } from '../../shared/bindings/pleat-module';
import type { MeasuringRefused, StudiedMessage, ToStudy } from './measuring-protocol';

export function studyResponse(
  module: Pick<PleatModule, 'Scene'>,
  { fabricsText, sceneText, windowS }: ToStudy,
): StudiedMessage | MeasuringRefused {
  const scene = new module.Scene(fabricsText);
  try {
    const answer = read<ResponseStudy>(scene.studyResponse(sceneText, windowS));
    if (!answer.ok) return { type: 'refused', failure: answer };
    const { ok: _, ...study } = answer;
    return { type: 'studied', study };
  } catch (error) {
    return { type: 'refused', failure: internalFailure(describe(error)) };
  } finally {
    scene.delete();
  }
}
