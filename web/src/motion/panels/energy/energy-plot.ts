// Energies over time, as lines about zero.

import type { EnergyNumbers } from '../../../shared/bindings/pleat-module';
import { energyUnit } from '../../../shared/panels/quantity';
import type { TimeChart } from '../chart/time-plot';
import type { EnergyLine } from './energy-lines';

/** Look of a line, in the chart and in its legend. */
export function lineClass(kind: EnergyLine['kind']): string {
  return `time-line energy-${kind}`;
}

export function energyChart(
  samples: readonly EnergyNumbers[],
  lines: readonly EnergyLine[],
): TimeChart {
  const heights = lines.map(({ joules }) => samples.map(joules));
  const { unit, perJoule } = energyUnit(Math.max(0, ...heights.flat().map(Math.abs)));
  return {
    timeTitle: 'time [s]',
    valueTitle: `energy [${unit}]`,
    times: samples.map(({ time_s }) => time_s),
    lines: lines.map(({ kind }, index) => ({
      class: lineClass(kind),
      values: (heights[index] ?? []).map((joules) => perJoule * joules),
    })),
  };
}
