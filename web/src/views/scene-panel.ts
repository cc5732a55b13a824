// Which scene, and what to notice in it.
import type { AppState } from '../state/app-state';
import { PRESET_IDS, PRESETS, presetSetting } from '../state/setting';
import { type Store, watch } from '../state/store';
import { choice, element, field, setText } from './element';

export function createScenePanel(parent: HTMLElement, store: Store<AppState>): () => void {
  const presets = choice(
    PRESET_IDS.map((value) => ({ value, title: PRESETS[value].title })),
    (preset) =>
      store.set({ setting: presetSetting(preset), startS: 0, playing: false, invited: true }),
  );
  const caption = element('p', { class: 'caption' });
  parent.append(
    element('section', { 'aria-label': 'Scene' }, field('Scene', presets.control), caption),
  );
  return watch(store, ['setting'], ({ setting }) => {
    presets.select(setting.preset);
    setText(caption, PRESETS[setting.preset].caption);
  });
}
