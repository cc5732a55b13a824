// Names under the strips: fabric, bending length, and by how much it droops.
import { fabricNamed } from '../../shared/fabric/fabric-data';
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import { type StripsState, sortedStrips } from '../state/strips-state';
import { bendingLengthWords, droopWords } from './marked-words';

/** Strips on one shelf, for a stage of that shape: as large as they come. */
export function stripsToAShelf(width: number, height: number, n: number): number {
  return Math.ceil(n / (width > height ? 2 : 3));
}

/** "denim" of "coarse cotton (denim)". */
export function shortName(fabric: string): string {
  return /\((.+)\)/.exec(fabric)?.[1] ?? fabric;
}

/** They say what the table beside says, and are left out for who hears that. */
export function createStripNames(parent: HTMLElement, store: Store<StripsState>) {
  const box = element('div', { class: 'strip-names', 'aria-hidden': 'true' });
  parent.append(box);
  const names = sortedStrips(store.get()).map(() => {
    const [name, length, droop] = [element('b'), element('span'), element('span')];
    const root = element('div', { class: 'strip-name' }, name, length, droop);
    box.append(root);
    return { root, name, length, droop };
  });
  watch(store, ['droops', 'chosen'], (state) => {
    sortedStrips(state).forEach((name, index) => {
      const one = names[index];
      if (!one) return;
      const fabric = fabricNamed(name);
      setText(one.name, shortName(name));
      setText(one.length, bendingLengthWords(fabric));
      setText(one.droop, droopWords(fabric, state.droops[name]));
      one.root.classList.toggle('chosen', name === state.chosen);
    });
  });
  return {
    /** Puts them there, in pixels from the stage's upper left corner; a name is as wide as its strip has room. */
    place(places: readonly { x: number; y: number }[]): void {
      const [first, second] = places;
      const room = first && second ? Math.abs(second.x - first.x) : 0;
      box.style.setProperty('--room', `${room.toFixed(1)}px`);
      names.forEach(({ root }, index) => {
        const at = places[index];
        if (!at) return;
        const shift = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
        root.style.transform = `${shift} translate(-50%, 0)`;
      });
    },
  };
}
