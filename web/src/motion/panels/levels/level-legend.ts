// Legend of a coarser level: its marks and lines, and how many.
import './level-legend.css';
import { element, setText } from '../../../shared/panels/element';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';
import { levelCounts, levelName } from './level-words';

/** A mark with words, of which `of` is left out where there is no room. */
function key(kind: 'kept' | 'out' | 'edge') {
  const [what, of, count] = [
    element('span'),
    element('span', { class: 'level-of' }),
    element('span'),
  ];
  const text = element('span', {}, what, of, count);
  return {
    line: element('li', {}, element('span', { class: `level-key level-${kind}` }), text),
    tell(words: string, n: number, among = '') {
      setText(what, words);
      setText(of, among);
      setText(count, `: ${n}`);
    },
  };
}

export function createLevelLegend(parent: HTMLElement, store: Store<MotionState>): void {
  const title = element('p', { class: 'legend-title' });
  const [kept, out, edge] = [key('kept'), key('out'), key('edge')];
  const legend = element(
    'div',
    { class: 'legend legend-levels', role: 'group', 'aria-label': 'Coarser level' },
    title,
    element('ul', { class: 'marks' }, kept.line, out.line, edge.line),
  );
  parent.append(legend);
  watch(store, ['coarse', 'coarseLevels', 'phase'], (state) => {
    const { coarse, coarseLevels, summary, phase } = state;
    const counts =
      coarse > 0 && coarseLevels && levelCounts(coarseLevels, coarse, summary?.n_vertices ?? 0);
    legend.hidden = !counts || phase !== 'ready';
    if (!counts) return;
    setText(title, `Level ${counts.level}`);
    kept.tell('kept', counts.n);
    out.tell('left out', counts.nOut, ` of ${levelName(counts.level - 1)}`);
    edge.tell('lengths', counts.nEdges);
  });
}
