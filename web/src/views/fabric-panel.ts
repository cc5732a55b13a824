// Which fabric, its measured numbers, and where each comes from.
import { lookOf } from '../stage/fabric-look';
import type { AppState } from '../state/app-state';
import {
  confidenceMeaning,
  type FabricQuantity,
  type FabricRecord,
  fabricNamed,
  fabrics,
  sources,
} from '../state/fabric-data';
import { type Store, watch } from '../state/store';
import { choice, element, field } from './element';
import { digits } from './quantity';

interface Line {
  key: FabricQuantity;
  title: string;
  unit: string;
  /** Shown number for one SI unit. */
  factor: number;
  meaning: string;
}

const LINES: readonly Line[] = [
  {
    key: 'areal_density_kg_per_m2',
    title: 'Weight',
    unit: 'g/m²',
    factor: 1000,
    meaning: 'Mass of one square metre.',
  },
  {
    key: 'stretch_warp_n_per_m',
    title: 'Stretch, warp',
    unit: 'N/m',
    factor: 1,
    meaning:
      'Force a metre of width needs to double the length, along the warp (lengthwise yarns).',
  },
  {
    key: 'stretch_weft_n_per_m',
    title: 'Stretch, weft',
    unit: 'N/m',
    factor: 1,
    meaning: 'The same along the weft (crosswise yarns).',
  },
  {
    key: 'shear_n_per_m',
    title: 'Shear',
    unit: 'N/m',
    factor: 1,
    meaning: 'Resistance to turning squares of yarn into lozenges.',
  },
  {
    key: 'bend_warp_n_m',
    title: 'Bending, warp',
    unit: 'µN·m',
    factor: 1e6,
    meaning: 'Moment a metre of width needs for a curvature of one per metre, bending the warp.',
  },
  {
    key: 'bend_weft_n_m',
    title: 'Bending, weft',
    unit: 'µN·m',
    factor: 1e6,
    meaning: 'The same, bending the weft.',
  },
  {
    key: 'thickness_m',
    title: 'Thickness',
    unit: 'mm',
    factor: 1000,
    meaning: 'Under light pressure.',
  },
  {
    key: 'friction_fabric_solid',
    title: 'Friction',
    unit: '',
    factor: 1,
    meaning: 'Coulomb coefficient on a smooth dry body.',
  },
];

function row(fabric: FabricRecord, line: Line): HTMLElement {
  const { value, range, confidence, source } = fabric[line.key];
  const [from, to] = range;
  const shown = `${digits(value * line.factor, 2)} ${line.unit}`.trim();
  const span = `${digits(from * line.factor, 2)} to ${digits(to * line.factor, 2)} ${line.unit}`;
  const badge = element(
    'span',
    {
      class: `badge badge-${confidence}`,
      title: `${confidenceMeaning[confidence]}. Sources: ${source.join(', ')}`,
    },
    confidence,
  );
  return element(
    'tr',
    { title: `${line.meaning} Reported range: ${span.trim()}.` },
    element('th', { scope: 'row' }, line.title),
    element('td', { class: 'number' }, shown),
    element('td', {}, badge),
  );
}

/** Every source that some shown number of this fabric names, with its full reference. */
function sourceList(fabric: FabricRecord): HTMLElement {
  const list = element('dl', { class: 'sources' });
  const named = new Map<string, string[]>();
  for (const line of LINES) {
    for (const key of fabric[line.key].source) {
      named.set(key, [...(named.get(key) ?? []), line.title.toLowerCase()]);
    }
  }
  for (const [key, titles] of named) {
    list.append(
      element('dt', {}, `${key}: ${titles.join('; ')}`),
      element('dd', {}, sources[key] ?? 'no reference in the fabric file'),
    );
  }
  return list;
}

function meanings(): HTMLElement {
  const list = element('dl', { class: 'sources' });
  for (const line of LINES) {
    list.append(element('dt', {}, line.title), element('dd', {}, line.meaning));
  }
  for (const [word, meaning] of Object.entries(confidenceMeaning)) {
    list.append(element('dt', {}, word), element('dd', {}, `${meaning}.`));
  }
  return list;
}

export function createFabricPanel(parent: HTMLElement, store: Store<AppState>): () => void {
  const names = choice(
    fabrics.map((fabric) => ({
      value: fabric.name_en,
      title: `${fabric.name_en} · ${fabric.use_en}`,
    })),
    (fabric) => store.set({ setting: { ...store.get().setting, fabric } }),
  );
  const swatch = element('span', { class: 'swatch', 'aria-hidden': 'true' });
  const construction = element('p', { class: 'note' });
  const sourceBody = element('div', {}, construction);
  const rows = element('tbody');
  const sourcesBox = element(
    'details',
    {},
    element('summary', {}, 'Where the numbers come from'),
    sourceBody,
  );
  const table = element(
    'table',
    { class: 'quantities' },
    element('caption', { class: 'unseen' }, 'Measured numbers of the fabric'),
    rows,
  );
  const meaningBox = element(
    'details',
    {},
    element('summary', {}, 'What the words mean'),
    meanings(),
  );
  parent.append(
    element(
      'section',
      { 'aria-label': 'Fabric' },
      field('Fabric', names.control, swatch),
      table,
      sourcesBox,
      meaningBox,
    ),
  );
  let shown = '';
  return watch(store, ['setting'], ({ setting }) => {
    if (setting.fabric === shown) return;
    shown = setting.fabric;
    const fabric = fabricNamed(shown);
    const { front, back } = lookOf(fabric.id);
    names.select(shown);
    swatch.style.background = `linear-gradient(135deg, ${front} 50%, ${back} 50%)`;
    construction.textContent = `Taken as: ${fabric.assumed_construction}.`;
    rows.replaceChildren(...LINES.map((line) => row(fabric, line)));
    sourceBody.replaceChildren(construction, sourceList(fabric));
  });
}
