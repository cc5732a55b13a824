// The knitted cloth of a setting, in the units of its form: from a scene and back, to a link and back.

/** Its numbers, by their places in the section "knit" of a scene. */
export const KNIT_PLACES = [
  'columns',
  'rows',
  'particle_mass_kg',
  'structural/stiffness_n_per_m',
  'structural/damping_n_s_per_m',
  'shear/stiffness_n_per_m',
  'shear/damping_n_s_per_m',
  'bending/stiffness_n_per_m',
  'bending/damping_n_s_per_m',
  'pattern/plain_columns',
  'pattern/lace_columns',
  'pattern/lace_stiffness',
] as const;

export type KnitPlace = (typeof KNIT_PLACES)[number];

/** Damping is given per metre, as it is most likely meant, or per millimetre, as it is printed. */
export type DampingPer = 'm' | 'mm';

export type Knit = Readonly<Record<KnitPlace, number>> & { readonly dampingPer: DampingPer };

/** Most columns, and most rows: more particles do not move while one watches. */
export const MOST_PER_SIDE = 128;

/** Digits that a number keeps from one unit to another. */
const DIGITS = 12;

/** The unit in the form and that of the scene, and how many of the scene's the form's is. */
export function unitOf(
  place: KnitPlace,
  dampingPer: DampingPer,
): { form: string; scene: string; factor: number } {
  if (place.endsWith('_kg')) return { form: 'g', scene: 'kg', factor: 1e-3 };
  if (place.endsWith('stiffness_n_per_m')) return { form: 'N/mm', scene: 'N/m', factor: 1e3 };
  if (place.endsWith('damping_n_s_per_m'))
    return {
      form: `N\u00a0s/${dampingPer}`,
      scene: 'N s/m',
      factor: dampingPer === 'mm' ? 1e3 : 1,
    };
  return { form: '', scene: '', factor: 1 };
}

/** "structural/stiffness_n_per_m" is the "Structural stiffness". */
export function knitTitle(place: KnitPlace): string {
  const words = place
    .replace('pattern/', '')
    .replace(/_(kg|n_.*)$/, '')
    .replace(/[/_]/g, ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

function partsOf(place: KnitPlace): { part: string; key: string | undefined } {
  const [part = '', key] = place.split('/');
  return { part, key };
}

function knitFrom(numberAt: (place: KnitPlace) => number, dampingPer: DampingPer): Knit {
  const numbers = KNIT_PLACES.map((place) => [place, numberAt(place)]);
  return { ...(Object.fromEntries(numbers) as Record<KnitPlace, number>), dampingPer };
}

/** The knit of a section that has all its numbers. */
export function knitOf(section: Readonly<Record<string, unknown>>): Knit {
  const numberAt = (place: KnitPlace) => {
    const { part, key } = partsOf(place);
    const value = key ? (section[part] as Record<string, number>)[key] : section[part];
    return Number((Number(value) / unitOf(place, 'm').factor).toPrecision(DIGITS));
  };
  return knitFrom(numberAt, 'm');
}

/** The section with the numbers of the form. */
export function knitSection(own: Readonly<Record<string, unknown>>, knit: Knit): object {
  const section: Record<string, unknown> = { ...own };
  for (const place of KNIT_PLACES) {
    const { part, key } = partsOf(place);
    const value = knit[place] * unitOf(place, knit.dampingPer).factor;
    const number = Number(value.toPrecision(DIGITS));
    section[part] = key ? { ...(section[part] as object), [key]: number } : number;
  }
  return section;
}

/** The part of a link. */
export function knitText(knit: Knit): string {
  return [...KNIT_PLACES.map((place) => knit[place]), knit.dampingPer].join(',');
}

/** Takes any numbers, as the scene's reader says which can be; but not more particles than a page moves. */
export function knitIn(text: string): Knit | undefined {
  const words = text.split(',');
  const dampingPer = words.pop();
  if (dampingPer !== 'm' && dampingPer !== 'mm') return undefined;
  const isNumber = (word: string) => word !== '' && Number.isFinite(Number(word));
  if (words.length !== KNIT_PLACES.length || !words.every(isNumber)) return undefined;
  const knit = knitFrom((place) => Number(words[KNIT_PLACES.indexOf(place)]), dampingPer);
  return Math.max(knit.columns, knit.rows) <= MOST_PER_SIDE ? knit : undefined;
}
