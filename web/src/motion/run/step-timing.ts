// Milliseconds of one step, in parts, from the running totals of the module.
import type { RunNumbers } from '../../shared/bindings/pleat-module';
import type { StepTiming } from '../state/motion-state';

/** Browsers round their clocks to as much as 0.1 ms: over this much work that is below 1 %. */
const SHORTEST_BATCH_MS = 50;

/** Parts that are told apart, as many as the read-out has room for; the others join the rest. */
const NAMED_PARTS = 2;

type Totals = Pick<RunNumbers, 'parts_ms' | 'steps_ms' | 'steps_timed'>;

/** Feed it each set of numbers; it answers when enough work lies between two of them. */
export function createStepTimer(): { feed(numbers: Totals): StepTiming | null; clear(): void } {
  let mark: Totals | null = null;
  return {
    feed(numbers) {
      if (!mark || numbers.steps_timed < mark.steps_timed) {
        mark = numbers;
        return null;
      }
      const steps = numbers.steps_timed - mark.steps_timed;
      const work = numbers.steps_ms - mark.steps_ms;
      if (steps === 0 || work < SHORTEST_BATCH_MS) return null;
      const before = mark.parts_ms;
      mark = numbers;
      const totalMs = work / steps;
      const all = Object.entries(numbers.parts_ms)
        .map(([name, ms]) => ({ name, ms: (ms - (before[name] ?? 0)) / steps }))
        .sort((a, b) => b.ms - a.ms);
      const parts = all.slice(0, NAMED_PARTS);
      const restMs = parts.reduce((left, part) => left - part.ms, totalMs);
      parts.push({ name: 'other', ms: Math.max(0, restMs) });
      const clothContactMs = all.find(({ name }) => name === 'cloth contact')?.ms;
      return { totalMs, parts, clothContactMs };
    },
    clear() {
      mark = null;
    },
  };
}
