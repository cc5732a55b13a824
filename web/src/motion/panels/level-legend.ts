// What is drawn of a coarser level: its marks and lines, and how many.
import './level-legend.css';
import { element, setText } from '../../shared/panels/element';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';
import { levelCounts, levelName } from './level-words';

function key(kind: 'kept' | 'out' | 'edge') {
  const text = element('span');
  return {
    line: element('li', {}, element('span', { class: `level-key level-${kind}` }), text),
    text,
  };
}

export function createLevelLegend(parent: HTMLElement, store: Store<MotionState>): () => void {
  const title = element('p', { class: 'legend-title' });
  const [kept, out, edge] = [key('kept'), key('out'), key('edge')];
  const legend = element(
    'div',
    { class: 'legend legend-levels', role: 'group', 'aria-label': 'Coarser level' },
    title,
    element('ul', { class: 'marks' }, kept.line, out.line, edge.line),
  );
  parent.append(legend);
  return watch(store, ['coarse', 'coarseLevels', 'phase'], (state) => {
    const { coarse, coarseLevels, summary, phase } = state;
    const counts =
      coarse > 0 && coarseLevels && levelCounts(coarseLevels, coarse, summary?.n_vertices ?? 0);
    legend.hidden = !counts || phase !== 'ready';
    if (!counts) return;
    setText(title, `Level ${counts.level}`);
    setText(kept.text, `kept: ${counts.n}`);
    setText(out.text, `left out of ${levelName(counts.level - 1)}: ${counts.nOut}`);
    setText(edge.text, `lengths: ${counts.nEdges}`);
  });
}
