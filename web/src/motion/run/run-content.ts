// The content of a load, and whether it can keep the motion of the one before.
import type { LoadMessage, SceneToLoad } from '../../shared/workers/motion-protocol';
import type { Way } from '../state/motion-state';
import type { ObjMesh } from '../state/obj-mesh';
import { type Setting, sceneOf } from '../state/setting';

export interface Content {
  setting: Setting;
  mesh: ObjMesh | null;
}

export function isSameScene(a: Content | null, b: Content): boolean {
  const isMesh = b.setting.preset === 'obj';
  return a?.setting.preset === b.setting.preset && (!isMesh || a.mesh === b.mesh);
}

/** A free mesh and a knit have no mesh lines to carry motion along, and tension is another in another model. */
export function canKeepMotion(a: Content | null, b: Content): boolean {
  const { preset, model, knit } = b.setting;
  return isSameScene(a, b) && preset !== 'obj' && !knit && a?.setting.model === model;
}

/** The scene, and where its vertices start when that is not where they rest. */
export function loadOf({ setting, mesh }: Content): SceneToLoad {
  const sceneText = JSON.stringify(sceneOf(setting, mesh));
  const isStarted = setting.preset === 'obj' && setting.level === 0 && mesh?.start !== undefined;
  return isStarted ? { sceneText, start: mesh.start } : { sceneText };
}

/** The steps of each scene that lead to a state. */
export function wayTo({ course, step }: Way): LoadMessage['way'] {
  return course.map((leg, index) => {
    const end = course[index + 1]?.fromStep ?? step;
    return { ...loadOf(leg), steps: end - leg.fromStep };
  });
}
