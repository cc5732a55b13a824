// A straight axis, with round values to write beside it.

export interface SpanScale {
  /** 0 at the first tick, 1 at the last. */
  part(value: number): number;
  ticks: number[];
}

/** Begins at zero. */
export interface LinearScale extends SpanScale {
  high: number;
}

/** The round number (1, 2 or 5 times a power of ten) next above. */
function roundStep(atLeast: number): number {
  const power = 10 ** Math.floor(Math.log10(atLeast));
  const factor = [1, 2, 5].find((one) => one * power >= atLeast * (1 - 1e-9)) ?? 10;
  return factor * power;
}

/** A scale from the tick at or below the least value to the one at or above the largest. */
export function spanScale(values: readonly number[], nTicks = 5): SpanScale {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const step = roundStep((most - least || 1) / nTicks);
  const first = Math.floor(least / step + 1e-9);
  const n = Math.max(1, Math.ceil(most / step - 1e-9) - first);
  const rounded = (index: number) => Number(((first + index) * step).toPrecision(12));
  return {
    part: (value) => (value / step - first) / n,
    ticks: Array.from({ length: n + 1 }, (_, index) => rounded(index)),
  };
}

/** A scale from zero to a tick at or above the largest value; up to 1 when none is positive. */
export function linearScale(values: readonly number[], nTicks = 5): LinearScale {
  const usable = values.filter((value) => value > 0 && Number.isFinite(value));
  const scale = spanScale([0, usable.length > 0 ? Math.max(...usable) : 1], nTicks);
  return { ...scale, high: scale.ticks.at(-1) ?? 1 };
}
