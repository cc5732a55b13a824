// Which scene, what to notice in it, and the visitor's mesh.
import { choice, element, field, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';
import { PRESET_IDS, PRESETS, presetSetting } from '../state/setting';
import { createObjPanel, type ObjActions } from './obj-panel';

export function createScenePanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: ObjActions,
): () => void {
  const presets = choice(
    PRESET_IDS.map((value) => ({ value, title: PRESETS[value].title })),
    (preset) =>
      store.set({ setting: presetSetting(preset), startS: 0, playing: false, invited: true }),
  );
  const caption = element('p', { class: 'caption' });
  const section = element(
    'section',
    { 'aria-label': 'Scene' },
    field('Scene', presets.control),
    caption,
  );
  parent.append(section);
  const closeObjPanel = createObjPanel(section, store, actions);
  const stop = watch(store, ['setting'], ({ setting }) => {
    presets.select(setting.preset);
    setText(caption, PRESETS[setting.preset].caption);
  });
  return () => {
    stop();
    closeObjPanel();
  };
}
