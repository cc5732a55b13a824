// Why the naive way breaks, what holds, and what told of it.
import { element, setText } from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import { caseNamed } from '../state/failure-cases';
import type { FailuresState } from '../state/failures-state';
import { signsOf } from './sign-words';

export function createCaseStory(parent: HTMLElement, store: Store<FailuresState>): void {
  const title = element('h2');
  const lesson = element('p');
  const remedy = element('p');
  const signs = element('ul', { class: 'signs', 'aria-live': 'polite' });
  const command = element('code');
  addSection(
    parent,
    'The case',
    title,
    lesson,
    remedy,
    element('h3', {}, 'What told of it'),
    signs,
    noteLine('With every method, on a command line: ', command),
  );
  watch(store, ['caseId'], ({ caseId }) => {
    const one = caseNamed(caseId);
    setText(title, one.title);
    setText(lesson, one.lesson);
    setText(remedy, `What holds: ${one.remedy}`);
    setText(command, `./pleat hard-cases ${one.id}`);
  });
  watch(store, ['sides'], ({ sides }) => {
    const sentences = [
      ...signsOf(sides.naive).map(({ sentence }) => `Naive: ${sentence}`),
      ...signsOf(sides.ours).map(({ sentence }) => `Ours: ${sentence}`),
    ];
    const shown = sentences.length > 0 ? sentences : ['Nothing yet: press Play.'];
    if (shown.join() === [...signs.children].map((item) => item.textContent).join()) return;
    signs.replaceChildren(...shown.map((sentence) => element('li', {}, sentence)));
  });
}
