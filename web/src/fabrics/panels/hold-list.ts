// Every pin and handle: by keys it is moved, and by a press let go.
import type { Triple } from '../../shared/bindings/geometry';
import { button, element } from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import type { FabricsState } from '../state/fabrics-state';
import type { Hold } from '../state/holds';

export interface HoldActions {
  /** A step as the viewer sees it: right, up, away. */
  nudge(name: string, direction: Triple): void;
  choose(name: string | null): void;
  release(name: string): void;
  resetHolds(): void;
}

const STEPS: Record<string, Triple> = {
  ArrowRight: [1, 0, 0],
  ArrowLeft: [-1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, 1],
  PageDown: [0, 0, -1],
};

function createRow({ name, kind }: Hold, actions: HoldActions): HTMLElement {
  const move = element(
    'button',
    {
      type: 'button',
      class: `hold hold-${kind}`,
      title: 'While it has the focus, arrows, Page Up and Page Down move it',
      'data-hold': name,
      focus: () => actions.choose(name),
      blur: () => actions.choose(null),
      keydown(event) {
        const step = STEPS[(event as KeyboardEvent).key];
        if (!step) return;
        event.preventDefault();
        actions.nudge(name, step);
      },
    },
    name,
  );
  const release = button('Release', () => actions.release(name), {
    'aria-label': `Release ${name}`,
    'data-release': '',
  });
  return element('li', {}, move, release);
}

export function createHoldList(
  parent: HTMLElement,
  store: Store<FabricsState>,
  actions: HoldActions,
): void {
  const lists = {
    handle: element('ul', { class: 'holds' }),
    pin: element('ul', { class: 'holds' }),
  };
  const heads = { handle: element('h3', {}, 'Handles'), pin: element('h3', {}, 'Pins') };
  const none = noteLine('Nothing holds the cloth: it lies as it rests.');
  const reset = button('Pins and handles as at first', actions.resetHolds, { class: 'wide' });
  const section = addSection(
    parent,
    'Pins and handles',
    noteLine(
      'A handle is what a hand pulls, a pin what stays. Each holds all cloth within 5 % of its size.',
    ),
    heads.handle,
    lists.handle,
    heads.pin,
    lists.pin,
    none,
    reset,
  );

  /** A list that is made anew would lose the focus: it goes to the button that took its place. */
  function remake(kind: Hold['kind'], rows: HTMLElement[]): void {
    const releases = () => [...section.querySelectorAll<HTMLElement>('[data-release]')];
    const index = releases().indexOf(document.activeElement as HTMLElement);
    lists[kind].replaceChildren(...rows);
    if (index >= 0 && !section.contains(document.activeElement))
      (releases()[index] ?? releases().at(-1) ?? reset).focus();
  }

  let listed = '';
  watch(store, ['pins', 'handles'], (state) => {
    const holds = state.holds;
    const names = holds.map(({ kind, name }) => `${kind} ${name}`).join('\n');
    if (names === listed) return; // a move is no reason to take the focus away
    listed = names;
    for (const kind of ['handle', 'pin'] as const) {
      const rows = holds.filter((hold) => hold.kind === kind);
      remake(
        kind,
        rows.map((hold) => createRow(hold, actions)),
      );
      heads[kind].hidden = rows.length === 0;
    }
    none.hidden = holds.length > 0;
  });
}
