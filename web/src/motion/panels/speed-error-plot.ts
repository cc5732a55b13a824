// Milliseconds against error, one mark and colour per stepper, the front as a line.
import { warningSentence } from '../../shared/bindings/run-warning';
import { logScale } from '../../shared/chart/log-scale';
import { svg } from '../../shared/panels/element';
import { digits, milliseconds, smallLength } from '../../shared/panels/quantity';
import { STEPPERS } from '../../shared/steppers/steppers';
import type { BenchRow } from '../bindings/sweep-module';
import { hasFinished } from '../state/sweep-plan';
import type { MeshError } from '../state/sweep-state';
import { boundOf, floorMarks, floorsOf } from './mesh-floors';

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
const LEFT = 62;
const RIGHT = 12;
const TOP = 12;
const BOTTOM = 46;
/** Radius that a finger or a pointer can hit. */
const HIT_RADIUS = 12;

/** The mark of a stepper about the origin, and a style with its colours; a plus for an unknown one. */
export function markOf(name: string): { path: string; style: string } {
  const row = STEPPERS.find((one) => one.name === name);
  if (!row) return { path: 'M-5 0H5M0-5V5', style: '' };
  return { path: row.mark, style: `--mark: ${row.colour}; --mark-dark: ${row.dark_colour}` };
}

/** A setting in words: "xpbd, level 2, 1/60 s, 30 substeps". */
export function titleOf(row: BenchRow): string {
  const { stepper, step_s, iterations } = row.method;
  const counts = [
    row.n_substeps > 1 ? `${row.n_substeps} substeps` : '',
    iterations !== undefined && iterations > 1 ? `${iterations} iterations` : '',
  ];
  const parts = [stepper, `level ${row.level}`, `1/${Math.round(1 / step_s)} s`, ...counts];
  return parts.filter((part) => part !== '').join(', ');
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

/** A row's numbers in words, and what is wrong with them. */
function labelOf(row: BenchRow): string {
  const numbers = `${milliseconds(row.ms_per_frame)} a frame, ${errorText(row)}`;
  const [warning] = row.warnings ?? [];
  return `${titleOf(row)}: ${numbers}${warning ? `. ${warningSentence(warning)}` : ''}`;
}

function axisTitles(): SVGElement[] {
  const middle = TOP + (HEIGHT - TOP - BOTTOM) / 2;
  return [
    svg(
      'text',
      { x: LEFT + (WIDTH - LEFT - RIGHT) / 2, y: HEIGHT - 8, class: 'axis' },
      'ms for a frame (1/60 s of motion)',
    ),
    svg(
      'text',
      { x: 14, y: middle, class: 'axis', transform: `rotate(-90 14 ${middle})` },
      'position error [mm]',
    ),
  ];
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
      class: row.position_error_m === null ? 'point untold' : 'point',
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
    if (isCurrent) group.append(svg('circle', { r: 9, class: 'point-ring' }));
    group.addEventListener('click', () => onChoice(index));
    group.addEventListener('keydown', (event) => {
      if (!(event instanceof KeyboardEvent) || !['Enter', ' '].includes(event.key)) return;
      event.preventDefault();
      onChoice(index);
    });
    return group;
  }

  function update({ rows, front, current }: PlotContent): void {
    const focused = document.activeElement?.getAttribute('data-row') ?? null;
    const hadFocus = focused !== null && root.contains(document.activeElement);
    const places = rows.map(placeOf);
    const placed = places.filter((place) => place !== null);
    const floors = floorsOf(rows);
    const across = logScale([...placed.map(([ms]) => ms), ...floors.flatMap(({ ms }) => ms)]);
    const upward = logScale([...placed.map(([, mm]) => mm), ...floors.map(({ mm }) => mm)]);
    const xOf = (ms: number) => LEFT + across.part(ms) * (WIDTH - LEFT - RIGHT);
    const yOf = (mm: number) => HEIGHT - BOTTOM - upward.part(mm) * (HEIGHT - TOP - BOTTOM);
    const parts: SVGElement[] = [];
    const line = (x1: number, y1: number, x2: number, y2: number, kind: string) =>
      parts.push(svg('line', { x1, y1, x2, y2, class: kind }));
    for (const ms of across.minorTicks) line(xOf(ms), TOP, xOf(ms), HEIGHT - BOTTOM, 'grid-minor');
    for (const mm of upward.minorTicks) line(LEFT, yOf(mm), WIDTH - RIGHT, yOf(mm), 'grid-minor');
    for (const ms of across.ticks) {
      line(xOf(ms), TOP, xOf(ms), HEIGHT - BOTTOM, 'grid');
      parts.push(
        svg('text', { x: xOf(ms), y: HEIGHT - BOTTOM + 17, class: 'tick tick-x' }, digits(ms, 1)),
      );
    }
    for (const mm of upward.ticks) {
      line(LEFT, yOf(mm), WIDTH - RIGHT, yOf(mm), 'grid');
      parts.push(svg('text', { x: LEFT - 8, y: yOf(mm) + 4, class: 'tick tick-y' }, digits(mm, 1)));
    }
    parts.push(...axisTitles());
    parts.push(...floorMarks(floors, xOf, yOf));
    const corners = front
      .map((index) => places[index] ?? null)
      .filter((place) => place !== null)
      .sort((a, b) => a[0] - b[0])
      .map(([ms, mm]) => `${xOf(ms)},${yOf(mm)}`);
    parts.push(svg('polyline', { points: corners.join(' '), class: 'front' }));
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
