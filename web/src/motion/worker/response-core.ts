// Studies what a cloth does after its first contact, as a function of the module. Deletes what it makes.
import { granted } from '../../shared/bindings/answers';
import type { PleatModule, ResponseStudy } from '../../shared/bindings/pleat-module';
import { type Refusal, refusalOf } from '../../shared/bindings/refusals';
import type { StudiedMessage, ToStudy } from './measuring-protocol';

export function studyResponse(
  module: Pick<PleatModule, 'Scene'>,
  { fabricsText, sceneText, windowS }: ToStudy,
): StudiedMessage | Refusal {
  const scene = new module.Scene(fabricsText);
  try {
    const study = granted<ResponseStudy>(scene.studyResponse(sceneText, windowS));
    return { type: 'studied', study };
  } catch (error) {
    return refusalOf(error);
  } finally {
    scene.delete();
  }
}
