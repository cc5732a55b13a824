// The cloth that is pulled, what to notice in it, and the visitor's mesh.
import { choice, element, field, setText } from '../../shared/panels/element';
import { createObjPicker } from '../../shared/panels/obj-picker';
import { createObjUnit, ownMeshWords } from '../../shared/panels/obj-unit';
import { createReading } from '../../shared/panels/reading';
import { addSection, noteLine } from '../../shared/panels/section';
import type { ObjUnit } from '../../shared/state/obj-file';
import { type Store, watch } from '../../shared/state/store';
import { EXPERIMENTS, OWN } from '../state/experiments';
import type { FabricsState } from '../state/fabrics-state';

const WAITING = 'Drop an OBJ file anywhere on this page, or choose one.';

function captionOf({ experiment, cloth, objName }: FabricsState): string {
  const known = EXPERIMENTS.find(({ id }) => id === experiment);
  if (known) return known.caption;
  return objName && cloth ? `${objName}: pull it anywhere, or pin it first.` : WAITING;
}

function meshWords(state: FabricsState): string {
  const { cloth, experiment } = state;
  if (!cloth) return '';
  const size = `${cloth.n_vertices} vertices, ${cloth.n_triangles} triangles`;
  return experiment === OWN ? ownMeshWords(size, state, cloth.skipped) : `${size}.`;
}

export function createExperimentPanel(
  parent: HTMLElement,
  store: Store<FabricsState>,
  actions: {
    openExperiment(id: string): void;
    openObj(file: File): void;
    setUnit(unit: ObjUnit): void;
    /** Gives up the file that is being read. */
    cancel(): void;
  },
): void {
  const options = [
    ...EXPERIMENTS.map(({ id, title }) => ({ value: id, title })),
    { value: OWN, title: 'Your OBJ' },
  ];
  const chosen = choice(options, (id) => actions.openExperiment(id));
  const caption = element('p', { class: 'caption' });
  const size = noteLine();
  const section = addSection(
    parent,
    'Experiment',
    field('Experiment', chosen.control),
    caption,
    size,
  );
  const unit = createObjUnit((value) => actions.setUnit(value));
  const reading = createReading(() => actions.cancel());
  section.append(unit.box);
  createObjPicker(section, actions);
  section.append(reading.box);
  watch(store, ['experiment', 'cloth', 'objName', 'reading'], (state) => {
    chosen.select(state.experiment);
    chosen.limit((id) => (id === OWN && !state.objName ? 'choose a file below' : null));
    setText(caption, captionOf(state));
    setText(size, meshWords(state));
    unit.box.hidden = state.experiment !== OWN;
    unit.select(state.objUnit);
    reading.show(state.reading);
  });
}
