// A fabric's physical numbers with confidence, and where each comes from.

import {
  confidenceMeaning,
  type FabricQuantity,
  type FabricRecord,
  inRun,
  type OwnQuantities,
  sources,
} from '../fabric/fabric-data';
import { element } from './element';
import { digits } from './quantity';
import { numberCell } from './table-parts';

/** The badge of a number that is not the fabric's. */
const SCENE = 'this scene';

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
    meaning:
      'Moment at rest of a metre of width for a curvature of one per metre, bending the warp.',
  },
  {
    key: 'bend_weft_n_m',
    title: 'Bending, weft',
    unit: 'µN·m',
    factor: 1e6,
    meaning: 'The same along the weft.',
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

/** A quantity of a fabric with its unit: "45 µN·m". */
export function quantityText(fabric: FabricRecord, key: FabricQuantity): string {
  const line = LINES.find((one) => one.key === key);
  return line ? shownText(inRun(fabric, key).value, line) : '';
}

function shownText(value: number, { factor, unit }: Line): string {
  return `${digits(value * factor, 2)} ${unit}`.trim();
}

interface Reading {
  shown: string;
  badge: string;
  /** Why it is this number. */
  origin: string;
}

function reading(fabric: FabricRecord, line: Line, own: OwnQuantities): Reading {
  const { value, confidence, source } = inRun(fabric, line.key);
  const ofFabric = shownText(value, line);
  const ofScene = own[line.key];
  if (ofScene !== undefined) {
    const origin = `Set by this scene; ${fabric.name_en} has ${ofFabric}, ${confidence}.`;
    return { shown: shownText(ofScene, line), badge: SCENE, origin };
  }
  const origin = `${confidenceMeaning[confidence]}. Sources: ${source.join(', ')}`;
  return { shown: ofFabric, badge: confidence, origin };
}

/** Readings of each quantity, by its title. */
export function quantityReadings(fabric: FabricRecord, own: OwnQuantities): Map<string, Reading> {
  return new Map(LINES.map((line) => [line.title, reading(fabric, line, own)]));
}

function row(fabric: FabricRecord, line: Line, own: OwnQuantities): HTMLElement {
  const [from, to] = inRun(fabric, line.key).range;
  const { shown, badge, origin } = reading(fabric, line, own);
  const span = `${digits(from * line.factor, 2)} to ${digits(to * line.factor, 2)} ${line.unit}`;
  const kind = badge === SCENE ? 'scene' : badge;
  return element(
    'tr',
    { title: `${line.meaning} Reported range: ${span.trim()}.` },
    element('th', { scope: 'row' }, line.title),
    numberCell(shown),
    element('td', {}, element('span', { class: `badge badge-${kind}`, title: origin }, badge)),
  );
}

/** Every source that some shown number of this fabric names, with its full reference. */
export function sourceList(fabric: FabricRecord): HTMLElement {
  const list = element('dl', { class: 'sources' });
  const named = new Map<string, string[]>();
  for (const line of LINES) {
    for (const key of inRun(fabric, line.key).source) {
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

export function quantityMeanings(): HTMLElement {
  const list = element('dl', { class: 'sources' });
  for (const line of LINES) {
    list.append(element('dt', {}, line.title), element('dd', {}, line.meaning));
  }
  for (const [word, meaning] of Object.entries(confidenceMeaning)) {
    list.append(element('dt', {}, word), element('dd', {}, `${meaning}.`));
  }
  return list;
}

/** The rows of a table of class `quantities`. */
export function quantityRows(fabric: FabricRecord, own: OwnQuantities = {}): HTMLElement[] {
  return LINES.map((line) => row(fabric, line, own));
}
