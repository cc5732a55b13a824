// A visitor's OBJ file before a module reads it: whether it is small enough, how large its mesh is, and in
// which unit. OBJ says nothing of units.
import type { Triple } from '../bindings/geometry';

/** Bounds beyond which a browser is busy for minutes, or out of memory. */
export const MOST_MEGABYTES = 20;
export const MOST_VERTICES = 200_000;

export const OBJ_UNITS = [
  { value: 'm', title: 'metres', one: 'the metre', metres: 1 },
  { value: 'cm', title: 'centimetres', one: 'the centimetre', metres: 0.01 },
  { value: 'mm', title: 'millimetres', one: 'the millimetre', metres: 0.001 },
  { value: 'inch', title: 'inches', one: 'the inch', metres: 0.0254 },
] as const;
export type ObjUnit = (typeof OBJ_UNITS)[number]['value'];

/** Cloth larger or smaller than this is odd [m]. */
const ODDLY_LARGE_M = 10;
const ODDLY_SMALL_M = 0.01;

export interface ObjFile {
  name: string;
  text: string;
  /** Ends of the mesh, in the unit of the file. */
  low: Triple;
  high: Triple;
}

/** Digits of a scaled number: as many as a factor like 0.001 leaves right. */
const DIGITS = 15;

/** A vertex with its three coordinates; what follows them, as a colour, is left. */
const VERTEX = /^([ \t]*v[ \t]+)(\S+)[ \t]+(\S+)[ \t]+(\S+)/gm;

function count(number: number): string {
  return number.toLocaleString('en').replaceAll(',', '\u202f');
}

/** The mesh's ends, or one sentence why it is too large. */
function measured(name: string, text: string): ObjFile | string {
  const low: Triple = [Infinity, Infinity, Infinity];
  const high: Triple = [-Infinity, -Infinity, -Infinity];
  let nVertices = 0;
  for (const [, , ...coordinates] of text.matchAll(VERTEX)) {
    nVertices += 1;
    coordinates.forEach((word, index) => {
      const axis = index as 0 | 1 | 2;
      low[axis] = Math.min(low[axis], Number(word));
      high[axis] = Math.max(high[axis], Number(word));
    });
  }
  if (nVertices <= MOST_VERTICES) return { name, text, low, high };
  return `${name} has ${count(nVertices)} vertices, and ${count(MOST_VERTICES)} are taken at most: thin it out first.`;
}

/** The file, or one sentence why it is not taken. */
export async function openObjFile(file: File): Promise<ObjFile | string> {
  const { name, size } = file;
  if (!/\.obj$/i.test(name)) return `${name} is no OBJ file: the name does not end in .obj.`;
  if (size > 1e6 * MOST_MEGABYTES)
    return `${name} has ${Math.ceil(size / 1e6)} MB, and ${MOST_MEGABYTES} MB are taken at most: thin it out first.`;
  const text = await file.text().catch(() => null);
  return text === null ? `${name} could not be read.` : measured(name, text);
}

function metresOf(unit: ObjUnit): number {
  return OBJ_UNITS.find(({ value }) => value === unit)?.metres ?? 1;
}

/** The text with its vertices in metres. */
export function textInMetres({ text }: ObjFile, unit: ObjUnit): string {
  const metres = metresOf(unit);
  if (metres === 1) return text;
  const whole = text.replaceAll(/\\\r?\n/g, ' '); // a line may go on in the next
  return whole.replaceAll(
    VERTEX,
    (_, start: string, ...words: string[]) =>
      start +
      words
        .slice(0, 3)
        .map((word) => Number((Number(word) * metres).toPrecision(DIGITS)))
        .join(' '),
  );
}

function lengthText(metres: number): string {
  if (metres >= 1) return `${Number(metres.toPrecision(3))} m`;
  return `${Number((1000 * metres).toPrecision(2))} mm`;
}

/** Words on what is odd about the size of a mesh, and the unit that would explain it; null when nothing is. */
export function oddSize(
  { low, high }: Pick<ObjFile, 'low' | 'high'>,
  unit: ObjUnit,
): string | null {
  const size = Math.max(...low.map((least, axis) => (high[axis] ?? 0) - least));
  const across = size * metresOf(unit);
  if (!(size > 0) || (across <= ODDLY_LARGE_M && across >= ODDLY_SMALL_M)) return null;
  // The unit in which it is nearest to a metre.
  const away = (metres: number) => Math.abs(Math.log(size * metres));
  const [likely] = [...OBJ_UNITS].sort((a, b) => away(a.metres) - away(b.metres));
  const odd = `It is ${lengthText(across)} across, which is odd for cloth.`;
  if (!likely || likely.value === unit) return odd;
  return `${odd} Its unit is probably ${likely.one}: choose that as the unit of the file.`;
}

/** The visitor's mesh, in the unit that it is taken in. */
export interface OwnMesh {
  file: ObjFile;
  unit: ObjUnit;
}

/** Sentences of a view about it. */
export function ownMeshState({ file, unit }: OwnMesh) {
  return { objName: file.name, objUnit: unit, objOdd: oddSize(file, unit) };
}
