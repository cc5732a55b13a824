// The colour scale on the stage: ends, unit, and the least and largest value now.
import { element, setText } from '../../shared/panels/element';
import { percent, smallLength } from '../../shared/panels/quantity';
import { MAGNITUDE_MAP, SIGNED_MAP } from '../../shared/stage/colormap';
import type { HeatMap, HeatScale } from '../../shared/stage/heat-map';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';

const STRETCH_MEANING =
  'Change of length over rest length, averaged over the threads that meet at each point: where one is longer and another shorter, they cancel.';

const DISTANCE_MEANING = 'How far each point is from where the reference has it at the same time.';

const TITLES: Record<HeatMap, string> = {
  off: '',
  magnitude: 'Stretch',
  signed: 'Change of length',
  distance: 'Distance to reference',
};

/** The range of the present frame, in the unit of the scale. */
function presentText({ least, most }: HeatScale, text: (value: number) => string): string {
  if (Number.isNaN(most)) return 'no reference at this time';
  // Less than a hundredth of the largest value is zero beside its two digits.
  const isNoise = Math.abs(least) < 1e-2 * Math.abs(most);
  return `now ${text(isNoise ? 0 : least)} to ${text(most)}`;
}

export function createHeatLegend(parent: HTMLElement, store: Store<MotionState>): void {
  const title = element('p', { class: 'legend-title' });
  const bar = element('div', { class: 'legend-bar', 'aria-hidden': 'true' });
  const low = element('span');
  const high = element('span');
  const present = element('p', { class: 'legend-present' });
  const means = element('p', { class: 'legend-present' }, 'mean of the threads at a point');
  const legend = element(
    'div',
    { class: 'legend', role: 'group', 'aria-label': 'Colour scale' },
    title,
    bar,
    element('p', { class: 'legend-ends' }, low, high),
    present,
    means,
  );
  parent.append(legend);
  watch(store, ['heatScale', 'heatRange'], ({ heatScale: scale, heatRange }) => {
    legend.hidden = !scale || scale.map === 'off';
    if (!scale) return;
    const isDistance = scale.map === 'distance';
    const text = isDistance ? smallLength : percent;
    const range = heatRange === 'auto' ? 'automatic' : 'fixed';
    legend.title = isDistance ? DISTANCE_MEANING : STRETCH_MEANING;
    setText(title, isDistance ? TITLES.distance : `${TITLES[scale.map]}, ${range} scale`);
    bar.style.background = (scale.map === 'signed' ? SIGNED_MAP : MAGNITUDE_MAP).gradient;
    setText(low, text(scale.low));
    setText(high, text(scale.high));
    setText(present, presentText(scale, text));
    means.hidden = isDistance;
  });
}
