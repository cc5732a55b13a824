// The answer of the picture, above it.
import { element, setText } from '../../shared/panels/element';
import { unbroken } from '../../shared/panels/unbroken';
import { type Store, watch } from '../../shared/state/store';
import type { RefinementState } from '../state/refinement-state';
import { answerSentence, tangleSentence } from './answer-words';

export function createAnswer(parent: HTMLElement, store: Store<RefinementState>): void {
  const answer = element('p', { class: 'garment-answer' });
  parent.append(answer);
  watch(
    store,
    ['panes', 'garment', 'fabric', 'rival', 'fineCloth', 'phase', 'playing'],
    (state) => {
      answer.classList.toggle('tangled', tangleSentence(state) !== null);
      setText(answer, unbroken(answerSentence(state)));
    },
  );
}
