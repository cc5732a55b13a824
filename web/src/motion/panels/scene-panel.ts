// Which scene, and the visitor's mesh.
import { choice, element, field } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { AT_START, type MotionState } from '../state/motion-state';
import { PRESET_IDS, PRESETS, presetSetting } from '../state/setting';
import { createObjPanel, type ObjActions } from './obj-panel';

export function createScenePanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: ObjActions,
): () => void {
  const presets = choice(
    PRESET_IDS.map((value) => ({ value, title: PRESETS[value].title })),
    (preset) => store.set({ ...AT_START, setting: presetSetting(preset) }),
  );
  const section = element('section', { 'aria-label': 'Scene' }, field('Scene', presets.control));
  parent.append(section);
  const closeObjPanel = createObjPanel(section, store, actions);
  const stop = watch(store, ['setting'], ({ setting }) => presets.select(setting.preset));
  return () => {
    stop();
    closeObjPanel();
  };
}
