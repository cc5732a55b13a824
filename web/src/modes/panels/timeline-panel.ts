// The timeline: keys on it, the present time, and what makes, changes and removes keys.

import { button, element, setText } from '../../shared/panels/element';
import { filePicker } from '../../shared/panels/obj-picker';
import { noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import { type KeyOrigin, keyTitle } from '../state/key-shapes';
import { hasUnlinkedKeys } from '../state/modes-link';
import type { ModesState } from '../state/modes-state';
import { MOST_KEYS } from '../state/timeline';

export interface TimelineActions {
  keep(): void;
  replace(): void;
  delete(): void;
  openFiles(files: readonly File[]): void;
  /** The keys that the model starts with. */
  example(): void;
}

/** Steps of the timeline between two keys. */
const STEP = 0.01;

function exampleTitle(model: string): string {
  if (model === 'cloth') return 'Keys of its drape';
  return model === 'bar' || model === 'sheet' ? 'Bent by 180°' : 'First keys';
}

function createButtons(actions: TimelineActions) {
  const picker = filePicker('OBJ files of keys', actions.openFiles, true);
  const keep = button('Keep as key', actions.keep, {
    title: 'The mix of modes becomes the next key',
  });
  const replace = button('Replace', actions.replace, {
    title: 'The mix takes the place of the chosen key',
  });
  const remove = button('Delete', actions.delete, { title: 'Removes the chosen key' });
  const files = button('From OBJ files', () => picker.click(), {
    title: 'Keys with the vertices of the model',
  });
  const example = button('', actions.example, { title: 'The keys that the model starts with' });
  return {
    row: element('div', { class: 'key-tools' }, keep, replace, remove, files, example, picker),
    show({ keys, phase, model, found }: ModesState) {
      const isReady = phase === 'ready';
      keep.disabled = !isReady || !found || keys.length >= MOST_KEYS;
      replace.disabled = !isReady || !found || keys.length === 0;
      remove.disabled = !isReady || keys.length <= 2;
      files.disabled = !isReady || keys.length >= MOST_KEYS;
      example.disabled = !isReady;
      setText(example, exampleTitle(model));
    },
  };
}

/** The state at a key. */
function shownKey(index: number): Partial<ModesState> {
  return { chosenKey: index, time: index, playing: false, showing: 'keys' };
}

/** The sliders as they made a key, so that it can be changed and replaced. */
function mixOf(origin: KeyOrigin, { energy }: ModesState): Partial<ModesState> {
  const isOfThis = origin.kind === 'mix' && origin.energy === energy;
  return isOfThis ? { amplitudes: origin.amplitudes } : {};
}

/** Buttons of the keys, each above its time. */
function createKeyMarks(store: Store<ModesState>) {
  const marks = element('div', { class: 'key-marks', role: 'group', 'aria-label': 'Keys' });
  return {
    marks,
    show({ keys, chosenKey }: ModesState) {
      marks.replaceChildren(
        ...keys.map(({ origin }, index) =>
          element(
            'button',
            {
              type: 'button',
              class: 'key-mark',
              title: keyTitle(origin),
              'aria-pressed': String(index === chosenKey),
              click: () => store.set({ ...mixOf(origin, store.get()), ...shownKey(index) }),
            },
            element('b', {}, String(index + 1)),
            element('span', {}, keyTitle(origin)),
          ),
        ),
      );
    },
    /** Renames the buttons that are there, so that one keeps the focus. */
    choose({ chosenKey }: ModesState) {
      [...marks.children].forEach((mark, index) => {
        mark.setAttribute('aria-pressed', String(index === chosenKey));
      });
    },
  };
}

export function createTimelinePanel(
  parent: HTMLElement,
  store: Store<ModesState>,
  actions: TimelineActions,
): void {
  const { marks, show: showMarks, choose } = createKeyMarks(store);
  const slider = element('input', {
    type: 'range',
    min: 0,
    step: STEP,
    class: 'time-slider',
    'aria-label': 'Time, in keys',
    input: () =>
      store.set({
        time: Number(slider.value),
        playing: false,
        showing: 'keys',
      }),
  });
  const buttons = createButtons(actions);
  const note = noteLine();
  parent.append(marks, slider, buttons.row, note);
  watch(store, ['keys', 'phase', 'model', 'found'], (state) => {
    buttons.show(state);
    setText(
      note,
      hasUnlinkedKeys(state) ? 'Keys from files stay on this machine: no link carries them.' : '',
    );
  });
  watch(store, ['keys'], showMarks);
  watch(store, ['chosenKey'], choose);
  watch(store, ['time', 'keys'], ({ time, keys }) => {
    slider.max = String(Math.max(1, keys.length - 1));
    if (Number(slider.value) !== time) slider.value = String(time);
    slider.setAttribute(
      'aria-valuetext',
      `${(time + 1).toFixed(2)} of ${Math.max(1, keys.length)} keys`,
    );
  });
}
