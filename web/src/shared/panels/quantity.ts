// Numbers as people read them: two or three significant digits, and a unit.

const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

function superscript(exponent: number): string {
  const digits = [...String(Math.abs(exponent))].map((digit) => SUPERSCRIPTS[Number(digit)]);
  return (exponent < 0 ? '⁻' : '') + digits.join('');
}

/** Sizes below this say no more than that there is next to nothing. */
const NEXT_TO_NOTHING = 1e-9;

/** Null is a dash. 1234.5 → "1230", 0.01234 → "0.0123", 3e-7 → "3·10⁻⁷", 8e-66 → "< 10⁻⁹". */
export function digits(value: number | null, significant = 3): string {
  if (value === null || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  if (Math.abs(value) < NEXT_TO_NOTHING) return '< 10⁻⁹';
  const rounded = Number(value.toPrecision(significant));
  const exponent = Math.floor(Math.log10(Math.abs(rounded)));
  if (exponent < -3 || exponent > 5) {
    const mantissa = Number((rounded / 10 ** exponent).toPrecision(significant));
    return `${mantissa}·10${superscript(exponent)}`;
  }
  return rounded.toFixed(Math.max(0, Math.min(significant - 1 - exponent, 6)));
}

/** A ratio as per cent. */
export function percent(ratio: number | null, significant = 2): string {
  if (ratio === null) return '–';
  return `${digits(100 * ratio, significant)} %`;
}

/** A length of the size of an error: millimetres, micrometres below a tenth of one. */
export function smallLength(metres: number | null): string {
  if (metres === null) return '–';
  const millimetres = 1000 * metres;
  if (millimetres !== 0 && Math.abs(millimetres) < 0.1)
    return `${digits(1000 * millimetres, 2)} µm`;
  return `${digits(millimetres, 2)} mm`;
}

/** The unit in which energies of this size are written, and how many of it a joule is. */
export function energyUnit(joules: number): { unit: string; perJoule: number } {
  const size = Math.abs(joules);
  if (size >= 0.1 || size === 0) return { unit: 'J', perJoule: 1 };
  return size >= 1e-4 ? { unit: 'mJ', perJoule: 1e3 } : { unit: 'µJ', perJoule: 1e6 };
}

/** An energy of any size: "1.2 J", "34 mJ"; no line ends before the unit. */
export function energyText(joules: number): string {
  const { unit, perJoule } = energyUnit(joules);
  return `${digits(perJoule * joules, 2)}\u00a0${unit}`;
}

export function milliseconds(ms: number | null): string {
  if (ms === null) return '–';
  return `${digits(ms, 2)} ms`;
}

/** A time of any size, where there is little room: "13 ms", "0.2 s", "40 s", "5 min". */
export function shortTime(ms: number, significant = 2): string {
  if (ms < 100) return `${digits(ms, significant)} ms`;
  if (ms < 100000) return `${digits(ms / 1000, ms < 1000 ? 1 : significant)} s`;
  return `${digits(ms / 60000, significant)} min`;
}

/** A step as the fraction of a second it is. */
export function stepTitle(stepS: number): string {
  return `1/${Math.round(1 / stepS)} s`;
}
