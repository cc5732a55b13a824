// Errors of the mesh of each level alone, of a sweep's rows and as lines in their chart.
import { svg } from '../../../shared/panels/element';
import type { BenchRow } from '../../bindings/sweep-module';
import { hasFinished, SURER } from '../../state/sweep-plan';

/** The error of a level's mesh [mm], and the milliseconds between which its rows lie. */
export interface Floor {
  level: number;
  mm: number;
  ms: [number, number];
}

/** Least error that the reference of a row tells [m]; null where there is none. */
export function boundOf({ reference }: BenchRow): number | null {
  return reference.uncertainty_m === null ? null : SURER * reference.uncertainty_m;
}

/** Length by which a line goes beyond the points of its level. */
const ROOM = 10;

/** The floors of the levels whose mesh error is known. */
export function floorsOf(rows: readonly BenchRow[]): Floor[] {
  const floors = new Map<number, Floor>();
  for (const row of rows) {
    const { level, ms_per_frame: ms, mesh_error_m: metres } = row;
    if (!hasFinished(row) || ms === null || metres === null) continue;
    const {
      ms: [low, high],
    } = floors.get(level) ?? { ms: [ms, ms] };
    floors.set(level, { level, mm: 1000 * metres, ms: [Math.min(low, ms), Math.max(high, ms)] });
  }
  return [...floors.values()];
}

/** A line for each floor, at places in the chart. */
export function floorMarks(
  floors: readonly Floor[],
  xOf: (ms: number) => number,
  yOf: (mm: number) => number,
): SVGElement[] {
  return floors.flatMap(({ level, mm, ms }) => {
    const [x1, x2, y] = [xOf(ms[0]) - ROOM, xOf(ms[1]) + ROOM, yOf(mm)];
    return [
      svg('line', { x1, y1: y, x2, y2: y, class: 'floor' }),
      svg('text', { x: x1, y: y - 5, class: 'floor-word' }, `mesh ${level}`),
    ];
  });
}
