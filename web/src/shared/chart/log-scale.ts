// A logarithmic axis: where a value lies, and which values to write beside it.

/** A wide axis of fewer decades than this has room for labels at 2 and 5 too. */
const FEW_DECADES = 3;

function multiples(factors: readonly number[], low: number, high: number): number[] {
  const found: number[] = [];
  const last = Math.ceil(Math.log10(high));
  for (let power = Math.floor(Math.log10(low)); power <= last; ++power) {
    for (const factor of factors) {
      const value = Number(`${factor}e${power}`);
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) found.push(value);
    }
  }
  return found;
}

/**
 * A scale that holds every positive finite value with some room on both sides; one decade about 1
 * when there is none. `few`: so many decades have labels at 2 and 5 too.
 */
export function logScale(values: readonly number[], few = FEW_DECADES) {
  const usable = values.filter((value) => value > 0 && Number.isFinite(value));
  const room = 1.35;
  let low = usable.length > 0 ? Math.min(...usable) / room : 0.3;
  let high = usable.length > 0 ? Math.max(...usable) * room : 3;
  if (high / low < 10) {
    const middle = Math.sqrt(low * high);
    low = middle / Math.sqrt(10);
    high = middle * Math.sqrt(10);
  }
  const decades = Math.log10(high / low);
  return {
    low,
    high,
    /** 0 at `low`, 1 at `high`; values outside lie outside. */
    part: (value: number) => Math.log10(value / low) / decades,
    /** Labelled values: decades, with 2 and 5 when there are few. */
    ticks: multiples(decades < few ? [1, 2, 5] : [1], low, high),
    /** Unlabelled lines between them. */
    minorTicks: multiples([2, 3, 4, 5, 6, 7, 8, 9], low, high),
  };
}

export type LogScale = ReturnType<typeof logScale>;
