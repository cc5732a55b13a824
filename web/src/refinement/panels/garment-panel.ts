// Garment, motion, fabric; what to notice; what is coloured.
import { fabrics } from '../../shared/fabric/fabric-data';
import { checkBox, choice, element, field, setText } from '../../shared/panels/element';
import { addSection, noteLine } from '../../shared/panels/section';
import { type Store, watch } from '../../shared/state/store';
import { USUAL_DEMANDS_MM } from '../state/garment-frames';
import { GARMENTS, METHODS, MOTIONS, methodsOf, usualFabric } from '../state/garments';
import {
  type ColourId,
  type RefinementState,
  type RivalId,
  showsFineCloth,
} from '../state/refinement-state';
import { noticeSentence } from './garment-words';

const COLOUR_TITLES: readonly { value: ColourId; title: string }[] = [
  { value: 'material', title: 'Fabric' },
  { value: 'level', title: 'Level' },
  { value: 'pattern', title: 'Pattern' },
  { value: 'curvature', title: 'Curvature' },
  { value: 'distance', title: 'Distance from fine' },
];

const RIVAL_TITLES: readonly { value: RivalId; title: string }[] = [
  { value: 'coarse', title: 'Coarse' },
  { value: 'even', title: 'Even: as many vertices' },
];

/** Controls of what is shown of the cloth, and how. */
function createLook(store: Store<RefinementState>) {
  const colour = choice(COLOUR_TITLES, (value) => store.set({ colour: value }));
  const fineCloth = checkBox('The fine cloth on every mesh', (isOn) =>
    store.set({ fineCloth: isOn }),
  );
  const clothNote = noteLine(
    'Each mesh shows the fine run’s shape as well as its faces can: a fold that is missing now is too fine for them.',
  );
  const edges = checkBox('Edges of the faces', (isOn) => store.set({ edges: isOn }));
  const hanging = checkBox('Hanging vertices', (isOn) => store.set({ hanging: isOn }));
  const hangingNote = noteLine(
    'A hanging vertex lies in the middle of a larger face’s edge and stays there: it is no unknown.',
  );
  return {
    controls: [
      fineCloth.label,
      clothNote,
      field('Colour shows', colour.control),
      edges.label,
      hanging.label,
      hangingNote,
    ],
    show(state: RefinementState) {
      colour.select(state.colour);
      fineCloth.input.checked = showsFineCloth(state);
      fineCloth.input.disabled = state.panes.fine.source === 'resting';
      clothNote.hidden = !showsFineCloth(state);
      edges.input.checked = state.edges;
      hanging.input.checked = state.hanging;
      hangingNote.hidden = !state.hanging;
    },
  };
}

export function createGarmentPanel(parent: HTMLElement, store: Store<RefinementState>): void {
  const notice = element('p', { class: 'caption' });
  const garment = choice(GARMENTS, (value) =>
    store.set({
      garment: value,
      fabric: usualFabric(value),
      further: [],
      rule: 'demand',
      demand: USUAL_DEMANDS_MM[value],
      method: 'implicit',
      substeps: null,
    }),
  );
  const motion = choice(MOTIONS, (value) => store.set({ motion: value, substeps: null }));
  const fabric = choice(
    fabrics.map(({ name_en: name }) => ({ value: name, title: name })),
    (value) => store.set({ fabric: value, further: [], substeps: null }),
  );
  const method = choice(METHODS, (value) => store.set({ method: value, substeps: null }));
  const methodField = field('Steps', method.control);
  const rival = choice(RIVAL_TITLES, (value) =>
    store.set({ rival: value, startS: store.get().timeS }),
  );
  const look = createLook(store);
  addSection(
    parent,
    'Garment and motion',
    notice,
    element(
      'div',
      { class: 'garment-choices' },
      field('Garment', garment.control),
      field('Fabric', fabric.control),
    ),
    field('Motion', motion.control),
    methodField,
    field('Uniform mesh beside', rival.control),
    ...look.controls,
  );
  watch(
    store,
    [
      'garment',
      'motion',
      'fabric',
      'method',
      'rival',
      'further',
      'fineCloth',
      'colour',
      'edges',
      'hanging',
      'panes',
      'plan',
    ],
    (state) => {
      setText(notice, noticeSentence(state));
      garment.select(state.garment);
      motion.select(state.motion);
      fabric.select(state.fabric);
      method.select(state.method);
      rival.select(state.rival);
      methodField.hidden = methodsOf(state.garment).length < 2;
      look.show(state);
    },
  );
}
