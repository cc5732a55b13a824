// The one sentence that says what to notice in the scene, above its picture.
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';
import { PRESETS } from '../state/setting';

export function createCaption(parent: HTMLElement, store: Store<MotionState>): () => void {
  const caption = element('p', { class: 'caption' });
  parent.append(caption);
  return watch(store, ['setting'], ({ setting }) =>
    setText(caption, PRESETS[setting.preset].caption),
  );
}
