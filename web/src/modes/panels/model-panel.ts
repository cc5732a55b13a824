// The body that is shown, what to notice in it, how its volume is made, and the visitor's mesh.
import { choice, element, field, setText } from '../../shared/panels/element';
import { createObjPicker } from '../../shared/panels/obj-picker';
import { createObjUnit, ownMeshWords } from '../../shared/panels/obj-unit';
import { addSection, folded, noteLine } from '../../shared/panels/section';
import type { ObjUnit } from '../../shared/state/obj-file';
import { type Store, watch } from '../../shared/state/store';
import type { VolumeChoice } from '../bindings/modal-module';
import { BAR_CELLS, type BarCells, MODELS, modelOf, OWN } from '../state/models';
import type { ModesState } from '../state/modes-state';

export interface ModelActions {
  openModel(id: string): void;
  openObj(file: File): void;
  setUnit(unit: ObjUnit): void;
  setCells(cells: BarCells): void;
  setVolume(volume: VolumeChoice): void;
}

const VOLUMES: readonly { value: VolumeChoice; title: string }[] = [
  { value: 'auto', title: 'As it fits' },
  { value: 'lattice', title: 'Cubes inside' },
  { value: 'shell', title: 'Surface thickened' },
];

function captionOf({ model, objName }: ModesState): string {
  return modelOf(model)?.caption ?? `${objName ?? 'Your mesh'}: its softest ways to move.`;
}

function meshWords(state: ModesState): string {
  const { surface, model } = state;
  if (!surface) return '';
  const kind = surface.closed ? 'closed' : 'open';
  const size = `${surface.n_vertices} vertices, ${surface.n_triangles} triangles, ${kind}`;
  return model === OWN ? ownMeshWords(size, state, surface.skipped) : `${size}.`;
}

export function createModelPanel(
  parent: HTMLElement,
  store: Store<ModesState>,
  actions: ModelActions,
): void {
  const options = [
    ...MODELS.map(({ id, title }) => ({ value: id, title })),
    { value: OWN, title: 'Your OBJ' },
  ];
  const chosen = choice(options, actions.openModel);
  const caption = element('p', { class: 'caption' });
  const size = noteLine();
  const cells = choice(
    BAR_CELLS.map((value) => ({ value, title: `${value} cubes through its thickness` })),
    actions.setCells,
  );
  const cellBox = field('How fine', cells.control);
  const volume = choice(VOLUMES, actions.setVolume);
  const volumeBox = folded(
    'The volume that carries it',
    {},
    noteLine(
      'A closed surface is filled with cubes of six tetrahedra each; an open one is thickened by half the mean edge to each side.',
    ),
    field('Volume', volume.control),
  );
  const unit = createObjUnit(actions.setUnit);
  const section = addSection(
    parent,
    'Model',
    field('Model', chosen.control),
    caption,
    size,
    cellBox,
    volumeBox,
    unit.box,
  );
  createObjPicker(section, actions);
  const keys: (keyof ModesState)[] = ['model', 'surface', 'objName', 'cells', 'volume', 'phase'];
  watch(store, keys, (state) => {
    chosen.select(state.model);
    chosen.limit((id) => (id === OWN && !state.objName ? 'choose a file below' : null));
    setText(caption, captionOf(state));
    setText(size, meshWords(state));
    cellBox.hidden = state.model !== 'bar';
    cells.select(state.cells);
    volume.select(state.volume);
    unit.box.hidden = state.model !== OWN;
    unit.select(state.objUnit);
  });
}
