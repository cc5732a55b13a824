// Milliseconds against error, one mark and colour per stepper, the front as a line.

import { svg } from '../../../shared/panels/element';
import { milliseconds, smallLength } from '../../../shared/panels/quantity';
import { warningSentence } from '../../../shared/panels/warning-words';
import type { BenchRow } from '../../bindings/sweep-module';
import { hasFinished } from '../../state/sweep-plan';
import type { MeshError } from '../../state/sweep-state';
import { type Axes, axisTitles, gridMarks, logAxes } from '../chart/log-plot';
import { markOf } from '../chart/stepper-mark';
import { boundOf, floorMarks, floorsOf } from './mesh-floors';
import { errorName } from './mesh-words';

export interface PlotContent {
  rows: BenchRow[];
  /** Indices into `rows`. */
  front: number[];
  /** Index of the row that the stage shows, or -1. */
  current: number;
  meshError: MeshError;
}

const WIDTH = 520;
const HEIGHT = 300;
const FIELD = { left: 62, right: WIDTH - 12, top: 12, bottom: HEIGHT - 46 };
/** Radius that a finger or a pointer can hit. */
const HIT_RADIUS = 12;
/** Strikes out the point of a run of nonsense. */
export const CROSS = 'M-7 -7L7 7M-7 7L7 -7';

/** A setting in words: "xpbd, level 2, 1/60 s, 30 substeps"; no line ends before the "s". */
export function titleOf(row: BenchRow): string {
  const { stepper, step_s, iterations } = row.method;
  const counts = [
    row.n_substeps > 1 ? `${row.n_substeps} substeps` : '',
    iterations !== undefined && iterations > 1 ? `${iterations} iterations` : '',
  ];
  const parts = [stepper, `level ${row.level}`, `1/${Math.round(1 / step_s)}\u00a0s`, ...counts];
  return parts.filter((part) => part !== '').join(', ');
}

/** Its run was not how cloth moves. */
export function isNonsense({ warnings = [] }: BenchRow): boolean {
  return warnings.some(({ is_nonsense }) => is_nonsense);
}

/** A row's place: [ms for a frame, position error or what it is below in mm]; null when it has none. */
function placeOf(row: BenchRow): [number, number] | null {
  const { ms_per_frame: ms } = row;
  const metres = row.position_error_m ?? boundOf(row);
  if (!hasFinished(row) || ms === null || metres === null) return null;
  return ms > 0 && metres > 0 ? [ms, 1000 * metres] : null;
}

function errorText(row: BenchRow): string {
  const { position_error_m: metres } = row;
  return metres === null
    ? `error below ${smallLength(boundOf(row))}`
    : `error ${smallLength(metres)}`;
}

/** The class of a row's point. */
export function pointKind(row: BenchRow): string {
  if (isNonsense(row)) return 'point nonsense';
  return row.position_error_m === null ? 'point untold' : 'point';
}

/** A row's numbers in words, and what is wrong with them. */
function labelOf(row: BenchRow): string {
  const numbers = `${milliseconds(row.ms_per_frame)} a frame, ${errorText(row)}`;
  const [warning] = row.warnings ?? [];
  return `${titleOf(row)}: ${numbers}${warning ? `. ${warningSentence(warning)}` : ''}`;
}

/** The rows of `front`, those that are compared with the same motion together. */
export function frontsOf(rows: readonly BenchRow[], front: readonly number[]): number[][] {
  const fronts = new Map<string, number[]>();
  for (const index of front) {
    const id = rows[index]?.reference.id ?? '';
    fronts.set(id, [...(fronts.get(id) ?? []), index]);
  }
  return [...fronts.values()];
}

/** The line through the places of a front, from the quickest on. */
function frontMark(places: readonly ([number, number] | null)[], { xOf, yOf }: Axes): SVGElement {
  const corners = places
    .filter((place) => place !== null)
    .sort((a, b) => a[0] - b[0])
    .map(([ms, mm]) => `${xOf(ms)},${yOf(mm)}`);
  return svg('polyline', { points: corners.join(' '), class: 'front' });
}

/** A chart that `update` draws anew; `onChoice` gets the index of a chosen row. */
export function createSpeedErrorPlot(
  parent: HTMLElement,
  onChoice: (index: number) => void,
): { update(content: PlotContent): void } {
  const root = svg('svg', {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    class: 'plot',
    role: 'group',
    'aria-label': 'Milliseconds for a frame against position error; points are buttons',
  });
  parent.append(root);

  function point(row: BenchRow, index: number, x: number, y: number, isCurrent: boolean) {
    const label = labelOf(row);
    const { path, style } = markOf(row.method.stepper);
    const group = svg('g', {
      transform: `translate(${x} ${y})`,
      class: pointKind(row),
      style,
      'data-stepper': row.method.stepper,
      role: 'button',
      tabindex: 0,
      'data-row': index,
      'aria-label': isCurrent ? `${label}, shown now` : label,
    });
    group.append(
      svg('title', {}, label),
      svg('circle', { r: HIT_RADIUS, class: 'point-hit' }),
      svg('path', { d: path, class: 'point-mark' }),
    );
    if (isNonsense(row)) group.append(svg('path', { d: CROSS, class: 'point-cross' }));
    if (isCurrent) group.append(svg('circle', { r: 9, class: 'point-ring' }));
    group.addEventListener('click', () => onChoice(index));
    group.addEventListener('keydown', (event) => {
      if (!(event instanceof KeyboardEvent) || !['Enter', ' '].includes(event.key)) return;
      event.preventDefault();
      onChoice(index);
    });
    return group;
  }

  function update({ rows, front, current, meshError }: PlotContent): void {
    const focused = document.activeElement?.getAttribute('data-row') ?? null;
    const hadFocus = focused !== null && root.contains(document.activeElement);
    const places = rows.map(placeOf);
    const floors = floorsOf(rows);
    const known = places.filter((place) => place !== null);
    const axes = logAxes(
      FIELD,
      [...known.map(([ms]) => ms), ...floors.flatMap(({ ms }) => ms)],
      [...known.map(([, mm]) => mm), ...floors.map(({ mm }) => mm)],
    );
    const { xOf, yOf } = axes;
    const parts = [
      ...gridMarks(axes),
      ...axisTitles(FIELD, 'ms for a frame (1/60 s of motion)', `${errorName(meshError)} [mm]`),
      ...floorMarks(floors, xOf, yOf),
    ];
    for (const indices of frontsOf(rows, front)) {
      const fronted = indices.map((index) => places[index] ?? null);
      parts.push(frontMark(fronted, axes));
    }
    rows.forEach((row, index) => {
      const place = places[index];
      if (!place) return;
      parts.push(point(row, index, xOf(place[0]), yOf(place[1]), index === current));
    });
    root.replaceChildren(...parts);
    if (hadFocus) root.querySelector<SVGElement>(`[data-row="${focused}"]`)?.focus();
  }

  return { update };
}
