// Chooses what is painted on the cloth: its material, stretch or distance; and the lines over it.
import { checkBox, choice, element, field } from '../../shared/panels/element';
import { addSection } from '../../shared/panels/section';
import type { HeatMap } from '../../shared/stage/heat-map';
import { type Store, watch } from '../../shared/state/store';
import { referenceUrl } from '../run/references';
import { HEAT_RANGES } from '../state/motion-link';
import { type MotionState, shownHeat } from '../state/motion-state';

const HEAT_TITLES: readonly { value: HeatMap; title: string }[] = [
  { value: 'off', title: 'Fabric' },
  { value: 'magnitude', title: 'Stretch' },
  { value: 'signed', title: 'Stretch with sign' },
  { value: 'distance', title: 'Distance to reference' },
];

export function createDrawingPanel(parent: HTMLElement, store: Store<MotionState>): void {
  const heat = choice(HEAT_TITLES, (value) => store.set({ heat: value }));
  const range = choice<string>(
    [
      { value: 'auto', title: 'Automatic' },
      ...HEAT_RANGES.map((percent) => ({ value: String(percent), title: `up to ${percent} %` })),
    ],
    (value) => store.set({ heatRange: value === 'auto' ? 'auto' : Number(value) }),
  );
  const rangeField = field('Scale', range.control);
  const edges = checkBox('Edges of the mesh', (isOn) => store.set({ edges: isOn }));
  const springs = checkBox('Springs: explicit or implicit', (isOn) => store.set({ springs: isOn }));
  addSection(
    parent,
    'Drawing',
    element('div', { class: 'pair' }, field('Colour shows', heat.control), rangeField),
    edges.label,
    springs.label,
  );
  watch(store, ['heat', 'heatRange', 'edges', 'springs', 'numbers', 'setting'], (state) => {
    const hasReference = referenceUrl(state.setting) !== null;
    heat.limit((value) => (value === 'distance' && !hasReference ? 'none of this scene' : null));
    heat.select(hasReference ? state.heat : shownHeat(state));
    range.select(String(state.heatRange));
    rangeField.hidden = !['magnitude', 'signed'].includes(shownHeat(state));
    edges.input.checked = state.edges;
    springs.input.checked = state.springs;
  });
}
