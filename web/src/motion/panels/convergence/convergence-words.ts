// Words on what a comparison of methods on one step shows.
import { digits, milliseconds } from '../../../shared/panels/quantity';
import type { Constraints, ConvergencePoint } from '../../bindings/convergence-module';
import type { ConvergenceResult } from '../../state/convergence';

/** A method's way, with its title. */
export interface Way {
  title: string;
  isOwn: boolean;
  stepper: string;
  points: readonly WayPoint[];
}

export interface WayPoint {
  rounds: number;
  ms: number;
  /** Share that is left of what there was at the predicted places. */
  left: number;
}

const TARGETS = [0.1, 0.01, 0.001];

/** The measured error: compliant constraints single out one place, which all methods can be held against. */
export const MEASURES: Record<
  Constraints,
  { title: string; left(point: ConvergencePoint): number | null }
> = {
  rigid: { title: 'Error left', left: ({ relative_error }) => relative_error },
  compliant: { title: 'Distance left', left: ({ relative_distance }) => relative_distance },
};

/** A solve of fewer rounds takes no longer than one of more: where it did, something else was slow. */
function withinLater(points: readonly WayPoint[]): WayPoint[] {
  const times = points.map(({ ms }) => ms);
  return points.map((point, index) => ({ ...point, ms: Math.min(...times.slice(index)) }));
}

/** The ways of a finished comparison; none of a method of which nothing is known. */
export function waysOf({ study, methods, constraints }: ConvergenceResult): Way[] {
  const { left } = MEASURES[constraints];
  return study.series.map(({ method, points }, index) => ({
    title: methods[index]?.title ?? method.stepper,
    isOwn: methods[index]?.isOwn ?? false,
    stepper: method.stepper,
    points: withinLater(
      points.flatMap((point) => {
        const known = left(point);
        return known === null ? [] : [{ rounds: point.rounds, ms: point.ms, left: known }];
      }),
    ),
  }));
}

/** First point of a way at which no more than that is left. */
function reached({ points }: Way, target: number): WayPoint | undefined {
  return points.find(({ left }) => left <= target);
}

function titlesOf(ways: readonly Way[]): string {
  return ways.map(({ title }) => title).join(', ');
}

/** Who is first: "XPBD, after 0.85 ms"; null when none gets there. */
function firstOf(ways: readonly Way[], target: number): string | null {
  const there = ways.flatMap((way) => {
    const point = reached(way, target);
    return point ? [{ title: way.title, ms: point.ms }] : [];
  });
  const [first] = there.sort((a, b) => a.ms - b.ms);
  return first ? `${first.title}, after ${milliseconds(first.ms)}` : null;
}

/** One sentence: who is first to each target, and who, of those that got to the one before, never gets there. */
export function readingOf(ways: readonly Way[]): string {
  const parts: string[] = [];
  let there = ways;
  for (const target of TARGETS) {
    const first = firstOf(there, target);
    if (!first) {
      parts.push(`none gets to ${target}`);
      break;
    }
    const late = there.filter((way) => !reached(way, target));
    there = there.filter((way) => reached(way, target));
    const never = late.length > 0 ? ` (never: ${titlesOf(late)})` : '';
    parts.push(`first to ${target} is ${first}${never}`);
  }
  const words = parts.join('; ');
  return `${words[0]?.toUpperCase()}${words.slice(1)}.`;
}

/** A point in words: "XPBD after 17 rounds: 0.85 ms, 0.044 left". */
export function pointWords({ title }: Way, { rounds, ms, left }: WayPoint): string {
  const after = `${rounds} ${rounds === 1 ? 'round' : 'rounds'}`;
  return `${title} after ${after}: ${milliseconds(ms)}, ${digits(left, 2)} left`;
}
