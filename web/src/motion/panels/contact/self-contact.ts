// The choice whether a cloth meets itself or passes through.
import { checkBox, setText } from '../../../shared/panels/element';
import { noteLine } from '../../../shared/panels/section';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';

const MEANING = 'Layers rest on each other, and none passes through. Steps take longer.';
const NEED = 'This cloth is particles without faces: there is nothing to meet.';

/** Words on the choice: what it does, or why there is none. */
export function selfContactWords({ summary }: Pick<MotionState, 'summary'>): string {
  return summary?.n_triangles === 0 ? NEED : MEANING;
}

export function createSelfContact(parent: HTMLElement, store: Store<MotionState>): void {
  const note = noteLine();
  note.id = 'self-contact-note';
  const { input, label } = checkBox('Cloth meets itself', (isOn) => {
    const { setting } = store.get();
    store.set({ setting: { ...setting, meetsItself: isOn || undefined } });
  });
  input.setAttribute('aria-describedby', note.id);
  parent.append(label, note);
  watch(store, ['setting', 'summary'], (state) => {
    input.checked = state.setting.meetsItself === true;
    input.disabled = state.summary?.n_triangles === 0;
    setText(note, selfContactWords(state));
  });
}
