// The colour scale on the stage: ends, unit, and the least and largest value now.
import { MAGNITUDE_MAP, SIGNED_MAP } from '../stage/colormap';
import type { AppState } from '../state/app-state';
import { type Store, watch } from '../state/store';
import { element, setText } from './element';
import { percent } from './quantity';

const LEGEND_MEANING =
  'Change of length over rest length, averaged over the threads that meet at each point: where one is longer and another shorter, they cancel.';

export function createHeatLegend(parent: HTMLElement, store: Store<AppState>): () => void {
  const title = element('p', { class: 'legend-title' });
  const bar = element('div', { class: 'legend-bar', 'aria-hidden': 'true' });
  const low = element('span');
  const high = element('span');
  const present = element('p', { class: 'legend-present' });
  const legend = element(
    'div',
    { class: 'legend', role: 'group', 'aria-label': 'Colour scale', title: LEGEND_MEANING },
    title,
    bar,
    element('p', { class: 'legend-ends' }, low, high),
    present,
    element('p', { class: 'legend-present' }, 'mean of the threads at a point'),
  );
  parent.append(legend);
  return watch(store, ['heatScale', 'heatRange'], ({ heatScale: scale, heatRange }) => {
    legend.hidden = !scale || scale.map === 'off';
    if (!scale) return;
    const isSigned = scale.map === 'signed';
    const range = heatRange === 'auto' ? 'automatic' : 'fixed';
    setText(title, `${isSigned ? 'Change of length' : 'Stretch'}, ${range} scale`);
    bar.style.background = (isSigned ? SIGNED_MAP : MAGNITUDE_MAP).gradient;
    setText(low, percent(scale.low));
    setText(high, percent(scale.high));
    // Beside two digits of the largest value, less than a hundredth of it is zero.
    const isNoise = Math.abs(scale.least) < 1e-2 * Math.abs(scale.most);
    const least = isNoise ? '0 %' : percent(scale.least);
    setText(present, `now ${least} to ${percent(scale.most)}`);
  });
}
