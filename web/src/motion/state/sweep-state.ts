// A sweep as far as it has come, and which of its rows are of the shown cloth.
import type { BenchRow } from '../bindings/sweep-module';
import type { ObjMesh } from './obj-mesh';
import { isSameMethod, presetSetting, type Setting } from './setting';
import { hasFinished, settingOf } from './sweep-plan';

/**
 * Says that errors have what the mesh does wrong in them; else that no reference on a finer mesh is shipped for
 * the scene, or none could be fetched.
 */
export type MeshError = 'known' | 'unshipped' | 'unfetched';

export interface SweepState {
  phase: 'none' | 'running' | 'done' | 'cancelled' | 'failed';
  /** Share of its time that has passed, 0 to 1; null while nobody knows. */
  progress: number | null;
  message: string;
  /** Time that the rest of it is expected to take [s]; null as well. */
  leftS: number | null;
  meshError: MeshError;
  rows: BenchRow[];
  /** Indices into `rows`. */
  front: number[];
  /** The scene the rows are of. */
  scene: SweptScene | null;
  /** The cloth was running at the same time, so that the times are too long. */
  disturbed: boolean;
}

export const NO_SWEEP: SweepState = {
  phase: 'none',
  progress: null,
  message: '',
  leftS: null,
  meshError: 'unshipped',
  rows: [],
  front: [],
  scene: null,
  disturbed: false,
};

/** The scene that a sweep measures: rows of another scene, fabric or model say nothing of it. */
export interface SweptScene
  extends Pick<Setting, 'preset' | 'fabric' | 'model' | 'hold' | 'knit' | 'meetsItself'> {
  mesh: ObjMesh | null;
}

export function sweptScene(setting: Setting, mesh: ObjMesh | null): SweptScene {
  const { preset, fabric, model, hold, knit, meetsItself } = setting;
  return { preset, fabric, model, hold, knit, meetsItself, mesh: preset === 'obj' ? mesh : null };
}

function isOf(swept: SweptScene | null, shown: SweptScene): boolean {
  return (
    swept !== null &&
    (Object.keys(shown) as (keyof SweptScene)[]).every((key) => swept[key] === shown[key])
  );
}

/** The setting of a row of that scene; what the row does not name stays as it is in the shown one. */
export function settingIn(scene: SweptScene, row: BenchRow, shown: Setting): Setting {
  const { mesh: _mesh, ...swept } = scene;
  const rest = swept.preset === shown.preset ? shown : presetSetting(swept.preset);
  return settingOf(row, { ...rest, ...swept });
}

/** The row of the last sweep that was measured with just the shown setting, if there is one. */
export function rowOfSetting({
  sweep,
  setting,
  mesh,
}: {
  sweep: SweepState;
  setting: Setting;
  mesh: ObjMesh | null;
}): BenchRow | null {
  if (!isOf(sweep.scene, sweptScene(setting, mesh))) return null;
  const found = sweep.rows.find((row) => {
    const measured = settingOf(row, setting);
    return measured.level === setting.level && isSameMethod(measured, setting);
  });
  return found && hasFinished(found) ? found : null;
}
