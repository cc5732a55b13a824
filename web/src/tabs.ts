// The views of the page, each with the question that it answers.
import { element } from './shared/panels/element';

export type ViewId = 'refinement' | 'fabrics' | 'modes' | 'failures' | 'motion';

export const VIEWS: readonly { id: ViewId; title: string; question: string }[] = [
  { id: 'refinement', title: 'Refinement', question: 'What does refinement buy?' },
  { id: 'fabrics', title: 'Fabrics', question: 'What makes silk silk?' },
  { id: 'modes', title: 'Modes', question: 'Which shapes does it like?' },
  { id: 'failures', title: 'Failures', question: 'What breaks cloth?' },
  { id: 'motion', title: 'Speed and error', question: 'How fast, how wrong?' },
];

export interface Tabs {
  select(id: ViewId): void;
}

/** `link` is the address at which a view is as it is. */
export function createTabs(
  parent: HTMLElement,
  actions: { link(id: ViewId): string; open(id: ViewId): void },
): Tabs {
  const tabs = VIEWS.map(({ id, title, question }) => {
    const tab = element(
      'a',
      {
        class: 'tab',
        href: '#',
        pointerdown: () => tab.setAttribute('href', actions.link(id)),
        focus: () => tab.setAttribute('href', actions.link(id)),
        click(event) {
          const { ctrlKey, metaKey, shiftKey } = event as MouseEvent;
          if (ctrlKey || metaKey || shiftKey) return; // another window
          event.preventDefault();
          actions.open(id);
        },
      },
      element('b', {}, title),
      element('span', {}, question),
    );
    return tab;
  });
  parent.append(...tabs);
  return {
    select(id) {
      VIEWS.forEach((view, index) => {
        if (view.id === id) tabs[index]?.setAttribute('aria-current', 'page');
        else tabs[index]?.removeAttribute('aria-current');
      });
    },
  };
}
