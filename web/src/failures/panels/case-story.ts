// Why the naive way breaks, what holds, and what told of it.
import { button, checkBox, element, setText } from '../../shared/panels/element';
import { save } from '../../shared/panels/saving';
import { addSection, folded, noteLine } from '../../shared/panels/section';
import { unbroken } from '../../shared/panels/unbroken';
import { type Store, watch } from '../../shared/state/store';
import { caseNamed, SIDES, sceneTextOf } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';
import { signsOf } from './sign-words';

/** The scene as a file, with the method of either side. */
function createSceneFiles(store: Store<FailuresState>): HTMLElement {
  const command = element('code');
  const buttons = SIDES.map((side) =>
    button(side === 'naive' ? 'Save naive' : 'Save ours', () => {
      const one = caseNamed(store.get().caseId);
      const text = new Blob([sceneTextOf(one, side)], { type: 'application/json' });
      save(`${one.id}_${side}.json`, text);
    }),
  );
  watch(store, ['caseId'], ({ caseId }) => setText(command, `./pleat run ${caseId}_naive.json`));
  return folded(
    'On a command line',
    {},
    noteLine('Its scene as a file runs there as well: ', command),
    element('div', { class: 'row' }, ...buttons),
  );
}

export function createCaseStory(parent: HTMLElement, store: Store<FailuresState>): void {
  const title = element('h2');
  const lesson = element('p');
  const remedy = element('p');
  const signs = element('ul', { class: 'signs', 'aria-live': 'polite' });
  const edges = checkBox('Mesh', (isOn) => store.set({ edges: isOn }));
  addSection(
    parent,
    'The case',
    title,
    lesson,
    remedy,
    element('h3', {}, 'What told of it'),
    signs,
    edges.label,
    createSceneFiles(store),
  );
  watch(store, ['caseId'], ({ caseId }) => {
    const one = caseNamed(caseId);
    setText(title, unbroken(one.title));
    setText(lesson, unbroken(one.lesson));
    setText(remedy, unbroken(`What holds: ${one.remedy}`));
  });
  watch(store, ['edges'], (state) => {
    edges.input.checked = state.edges;
  });
  watch(store, ['sides'], (state) => {
    const sentences = [
      ...signsOf(state, 'naive').map(({ sentence }) => `Naive: ${sentence}`),
      ...signsOf(state, 'ours').map(({ sentence }) => `Ours: ${sentence}`),
    ];
    const shown = sentences.length > 0 ? sentences.map(unbroken) : ['Nothing yet: press Play.'];
    if (shown.join() === [...signs.children].map((item) => item.textContent).join()) return;
    signs.replaceChildren(...shown.map((sentence) => element('li', {}, sentence)));
  });
}
