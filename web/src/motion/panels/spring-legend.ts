// Legend of implicit springs: the two colours on the stage, and the share in a sentence.

import type { SpringSplit } from '../../shared/bindings/pleat-module';
import { element, setText } from '../../shared/panels/element';
import { percent } from '../../shared/panels/quantity';
import { type Store, watch } from '../../shared/state/store';
import { stepperRow } from '../../shared/steppers/steppers';
import type { MotionState } from '../state/motion-state';

/** "180 of 686 springs are implicit at this step: 26 %." */
export function springWords({ ends, isImplicit }: SpringSplit, stepperTitle: string): string {
  const n = ends.length / 2;
  if (n === 0) return 'This model has no springs.';
  if (isImplicit.length === 0) return `${stepperTitle}: all ${n} springs are taken alike.`;
  const nImplicit = isImplicit.reduce((sum, one) => sum + one, 0);
  const share = percent(nImplicit / n).replace(' ', '\u00a0');
  return `${nImplicit} of ${n} springs are implicit at this step: ${share}.`;
}

function key(kind: 'explicit' | 'implicit', title: string): HTMLElement {
  return element('li', {}, element('span', { class: `spring-key spring-${kind}` }), title);
}

export function createSpringLegend(parent: HTMLElement, store: Store<MotionState>): void {
  const keys = element(
    'ul',
    { class: 'marks' },
    key('explicit', 'explicit'),
    key('implicit', 'implicit'),
  );
  const words = element('p', { class: 'legend-present' });
  const legend = element(
    'div',
    { class: 'legend legend-springs', role: 'group', 'aria-label': 'Explicit or implicit' },
    element('p', { class: 'legend-title' }, 'Springs'),
    keys,
    words,
  );
  parent.append(legend);
  watch(store, ['springs', 'springSplit', 'phase'], (state) => {
    const { springs, springSplit: split, phase, setting } = state;
    legend.hidden = !springs || !split || phase !== 'ready';
    if (!split) return;
    keys.hidden = split.isImplicit.length === 0;
    setText(words, springWords(split, stepperRow(setting.stepper).title));
  });
}
