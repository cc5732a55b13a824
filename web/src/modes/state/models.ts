// The bodies whose modes are offered, and where the module has them from.
import cornersMeet from '../../../../assets/scenes/corners_meet.json?raw';

const MESHES = import.meta.glob<string>('../../../../assets/meshes/{skirt,t_shirt}.obj', {
  query: '?url',
  import: 'default',
  eager: true,
});

/** The model of the visitor's own mesh. */
export const OWN = 'own';

/** Source of a body. */
export type Source =
  | { kind: 'box' }
  /** A cloth where its scene begins; with `drapes` where it has come to rest. */
  | { kind: 'scene'; text: string; drapes: boolean }
  | { kind: 'obj'; url: string };

export interface Model {
  id: string;
  title: string;
  caption: string;
  source: Source;
  /** The fabric's id in its file, for its look alone. */
  lookId: number;
}

/** Sides of the bar [m]: whole numbers of cubes for two, three and four of them through the thinnest side. */
export const BAR_SIDES_M: readonly [number, number, number] = [1.2, 0.12, 0.24];
export const BAR_CELLS = [2, 3, 4] as const;
export type BarCells = (typeof BAR_CELLS)[number];

/** Edge of the bar's cubes [m]. */
export function barEdge(cells: BarCells): number {
  return Math.min(...BAR_SIDES_M) / cells;
}

/** The scene on a mesh that is quick to look at. */
function coarser(text: string): string {
  const { $schema: _, ...scene } = JSON.parse(text) as Record<string, unknown>;
  return JSON.stringify({ ...scene, refinement: { level: 1 } });
}

const SHEET = JSON.stringify({
  name: 'sheet',
  cloth: {
    sheet: {
      width_m: 1,
      height_m: 0.6,
      columns: 20,
      rows: 12,
      origin_m: [-0.5, 0, -0.3],
      warp_direction: [0, 0, 1],
      weft_direction: [1, 0, 0],
    },
  },
  fabric: { name: 'linen' },
});

function meshUrl(name: string): string {
  const url = MESHES[`../../../../assets/meshes/${name}.obj`];
  if (!url) throw new Error(`the page has no mesh ${name}`);
  return url;
}

/** Models in the order in which they are offered; the first one is shown to begin with. */
export const MODELS: readonly Model[] = [
  {
    id: 'bar',
    title: 'Bar of rubber',
    caption:
      'A bar 120 cm long, 24 cm wide and 12 cm thick, of soft rubber (Young’s modulus 1 MPa, 1000 kg/m³) that floats freely.',
    source: { kind: 'box' },
    lookId: 10,
  },
  {
    id: 'sheet',
    title: 'Flat sheet',
    caption:
      'A flat sheet that nothing holds. Bending costs it least, so its lowest modes bend it.',
    source: { kind: 'scene', text: SHEET, drapes: false },
    lookId: 3,
  },
  {
    id: 'cloth',
    title: 'Draped cloth',
    caption:
      'A square metre of fine cotton hangs by two corners that came together. How its own fabric makes it swing about this shape, with its corners held.',
    source: { kind: 'scene', text: coarser(cornersMeet), drapes: true },
    lookId: 0,
  },
  {
    id: 'skirt',
    title: 'Skirt',
    caption: 'A skirt that nobody wears: its rim opens and closes before anything else bends.',
    source: { kind: 'obj', url: meshUrl('skirt') },
    lookId: 13,
  },
  {
    id: 't-shirt',
    title: 'T-shirt',
    caption:
      'A T-shirt that nobody wears: its second mode flattens the body and leaves the sleeves alone.',
    source: { kind: 'obj', url: meshUrl('t_shirt') },
    lookId: 9,
  },
];

export function modelOf(id: string): Model | undefined {
  return MODELS.find((model) => model.id === id);
}
