// Choice of the scene, and the visitor's mesh or the form of a knit.
import { choice, field } from '../../../shared/panels/element';
import { addSection } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import { later } from '../../run/later';
import { AT_START, type MotionState } from '../../state/motion-state';
import { PRESET_IDS, PRESETS, presetSetting } from '../../state/setting';
import type { ObjActions } from './obj-panel';

export function createScenePanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: ObjActions,
): void {
  const presets = choice(
    PRESET_IDS.map((value) => ({ value, title: PRESETS[value].title })),
    (preset) => store.set({ ...AT_START, setting: presetSetting(preset) }),
  );
  const section = addSection(parent, 'Scene', field('Scene', presets.control));
  const makeObjPanel = later(store, 'The panel of your OBJ', async () => {
    const { createObjPanel } = await import('./obj-panel');
    createObjPanel(section, store, actions);
  });
  const makeKnitForm = later(store, 'The form of the knit', async () => {
    const { createKnitForm } = await import('./knit-form');
    createKnitForm(section, store);
  });
  watch(store, ['setting', 'reading'], ({ setting, reading }) => {
    presets.select(setting.preset);
    if (setting.preset === 'obj' || reading !== null) void makeObjPanel();
    if (setting.knit) void makeKnitForm();
  });
}
