// The colours on the stage: what each means, with its unit.
import { element, setText } from '../../shared/panels/element';
import { digits, smallLength } from '../../shared/panels/quantity';
import { MAGNITUDE_MAP } from '../../shared/stage/colormap';
import { type Store, watch } from '../../shared/state/store';
import { planStory } from '../state/plan-file';
import type { RefinementState } from '../state/refinement-state';
import { fromTo } from './garment-words';
import { LEVEL_COLOURS, PATTERN_COLOURS } from './paints';

function swatches(colours: readonly string[], words: readonly string[]): HTMLElement {
  const items = words.map((word, index) => {
    const key = element('span', { class: 'legend-key' });
    key.style.background = colours[index] ?? '';
    return element('li', {}, key, word);
  });
  return element('ul', { class: 'legend-keys' }, ...items);
}

function levelWords({ plan }: RefinementState): string[] {
  const cap = plan?.level_cap ?? 2;
  return Array.from({ length: cap + 1 }, (_, level) => {
    if (level === 0) return '0: a coarse face';
    return `${level}: 1/${4 ** level} of one`;
  });
}

function patternWords({ plan }: RefinementState): string[] {
  if (!plan) return [];
  return planStory(plan).patterns.map(({ meansPerM, deviationsPerM }, pattern) => {
    if (meansPerM.length > 1) return `${pattern}: ${fromTo(meansPerM)} 1/m`;
    return `${pattern}: ${fromTo(meansPerM)} ± ${fromTo(deviationsPerM)} 1/m`;
  });
}

export function createGarmentLegend(parent: HTMLElement, store: Store<RefinementState>): void {
  const title = element('p', { class: 'legend-title' });
  const keys = element('div');
  const bar = element('span', { class: 'legend-bar', 'aria-hidden': 'true' });
  const high = element('span');
  const scale = element('p', { class: 'legend-scale' }, element('span', {}, '0'), bar, high);
  bar.style.background = MAGNITUDE_MAP.gradient;
  const legend = element(
    'div',
    { class: 'garment-legend', role: 'group', 'aria-label': 'Colours' },
    title,
    keys,
    scale,
  );
  parent.append(legend);
  watch(store, ['colour', 'ranges', 'plan'], (state) => {
    const { colour, ranges } = state;
    legend.hidden = colour === 'material';
    const isScale = colour === 'curvature' || colour === 'distance';
    scale.hidden = !isScale;
    keys.hidden = isScale;
    if (colour === 'level') {
      setText(title, 'Level of a face');
      keys.replaceChildren(swatches(LEVEL_COLOURS, levelWords(state)));
    } else if (colour === 'pattern') {
      const isOne = state.plan === null || state.plan.examples.length < 2;
      const what = isOne ? 'curvature, mean ± deviation' : 'mean curvature in the examples';
      setText(title, `Pattern: ${what}`);
      keys.replaceChildren(swatches(PATTERN_COLOURS, patternWords(state)));
    } else if (colour === 'curvature') {
      setText(title, 'Curvature now');
      setText(high, `${digits(ranges.curvature, 2)} 1/m and more`);
    } else if (colour === 'distance') {
      setText(title, 'How far each face is off the fine cloth (grey)');
      setText(high, `${smallLength(ranges.distance)} and more`);
    }
  });
}
