// An axis from zero, with round values to write beside it.

export interface LinearScale {
  high: number;
  /** 0 at zero, 1 at `high`. */
  part(value: number): number;
  ticks: number[];
}

/** The round number (1, 2 or 5 times a power of ten) next above. */
function roundStep(atLeast: number): number {
  const power = 10 ** Math.floor(Math.log10(atLeast));
  const factor = [1, 2, 5].find((one) => one * power >= atLeast * (1 - 1e-9)) ?? 10;
  return factor * power;
}

/** A scale from zero to a tick at or above the largest value; up to 1 when none is positive. */
export function linearScale(values: readonly number[], nTicks = 5): LinearScale {
  const usable = values.filter((value) => value > 0 && Number.isFinite(value));
  const most = usable.length > 0 ? Math.max(...usable) : 1;
  const step = roundStep(most / nTicks);
  const n = Math.ceil(most / step - 1e-9);
  return {
    high: n * step,
    part: (value) => value / (n * step),
    ticks: Array.from({ length: n + 1 }, (_, index) => Number((index * step).toPrecision(12))),
  };
}
