// The way from a warning to the case of the view of failures that shows what it tells of.
import type { RunWarning } from '../bindings/run-warning';
import './why-link.css';
import { element } from './element';

/** Cases by the warnings that their naive sides show. */
export const CASE_OF: Partial<Record<RunWarning['kind'], string>> = {
  stretch: 'gathered_curtain',
  soft: 'gathered_curtain',
  speed: 'long_step',
  unsolved: 'heavy_bead',
};

/** A link that is hidden where no case shows the warning. */
export function createWhyLink(words = 'See why') {
  const link = element('a', { class: 'why', hidden: true }, words);
  return {
    link,
    show(kind: RunWarning['kind'] | undefined) {
      const id = kind && CASE_OF[kind];
      link.hidden = !id;
      if (id) link.href = `#view=failures&case=${id}`;
    },
  };
}
