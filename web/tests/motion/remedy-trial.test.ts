// Changes are tried in their order on copies, until one is known to hold or time is over.
import { afterEach, describe, expect, it, vi } from 'vitest';
import { changesFor } from '../../src/motion/run/remedy-changes';
import { cheapest, type Tried, tryChanges } from '../../src/motion/run/remedy-trial';
import type { Leg } from '../../src/motion/state/motion-state';
import { presetSetting, type Setting } from '../../src/motion/state/setting';
import { aWarning, type Behaviour, type Method, trialWorkers } from '../support/trial-worker';

const setting: Setting = {
  ...presetSetting('swinging-sheet'),
  stepper: 'xpbd',
  substeps: 1,
  level: 0,
};
/** Substeps and iterations of the first changes, of which the start's 30 substeps come first. */
const hints = { '/method/substeps': 4, '/method/iterations': 4 };

const substepsOf = ({ stepper, substeps = 0, iterations = 0 }: Method) =>
  `${stepper} ${substeps} ${iterations}`;

function tryWith(
  behaviourOf: (method: Method) => Behaviour,
  signal = new AbortController().signal,
  given: Record<string, unknown> = hints,
  course: readonly Leg[] = [],
) {
  const workers = trialWorkers(behaviourOf);
  const question = {
    changes: () => changesFor({ hints: given }, setting),
    mesh: null,
    course,
    warning: aWarning,
  };
  return { ...workers, tried: workers.tried, answer: tryChanges(workers.start, question, signal) };
}

const ends = (tried: readonly Tried[] | null) => tried?.map(({ end }) => end);

afterEach(() => vi.restoreAllMocks());

describe('a trial of changes', () => {
  it('takes them in their order, five at most, and ends its worker', async () => {
    const { answer, tried, alive } = tryWith(() => ({ stepMs: 1, warnedS: 0.2 }));
    expect(alive()).toBe(1);
    expect(ends(await answer)).toEqual(Array(5).fill('fails'));
    expect(tried.map(substepsOf)).toEqual([
      'xpbd 30 1',
      'xpbd 4 1',
      'xpbd 1 4',
      'xpbd 16 1',
      'xpbd 1 16',
    ]);
    expect(alive()).toBe(0);
  });

  it('sees a warning that comes later than the one of the run', async () => {
    const { answer } = tryWith(({ substeps = 0 }) =>
      substeps === 4 ? { stepMs: 1, warnedS: 2.5 } : { stepMs: 2 },
    );
    expect(ends(await answer)).toEqual(['holds', 'fails', 'holds', 'holds', 'holds']);
  });

  it('offers the cheapest that holds by time of a second of motion, and gives up what is dearer', async () => {
    const { answer } = tryWith(({ substeps = 0, iterations = 0 }) => ({
      stepMs: substeps * iterations === 4 ? 6 - iterations : 20,
    }));
    const tried = await answer;
    expect(ends(tried)).toEqual(['holds', 'holds', 'holds', 'dearer', 'dearer']);
    expect(cheapest(tried ?? [])?.change.setting).toEqual({ ...setting, iterations: 4 });
    expect(cheapest(tried ?? [])?.stepMs).toBeCloseTo(2, 9);
    expect(tried?.[3]?.seenS).toBeLessThan(1);
  });

  it('takes what is hinted at by now, when a warning grows worse meanwhile', async () => {
    const growing: Record<string, unknown> = { '/method/substeps': 4 };
    const behaviourOf = ({ substeps = 0 }: Method) => {
      growing['/method/substeps'] = 64;
      return substeps < 64 ? { stepMs: 1, warnedS: 0 } : { stepMs: 1 };
    };
    const { answer, tried } = tryWith(behaviourOf, undefined, growing);
    expect(ends(await answer)?.slice(0, 2)).toEqual(['fails', 'holds']);
    expect(tried.map(substepsOf).slice(0, 2)).toEqual(['xpbd 30 1', 'xpbd 64 1']);
  });

  describe('of a run whose course is known', () => {
    const leg = { setting, mesh: null, fromStep: 0 };
    const best = async (behaviourOf: (method: Method) => Behaviour, course: readonly Leg[]) => {
      const { answer, alive } = tryWith(behaviourOf, undefined, hints, course);
      const found = cheapest((await answer) ?? []);
      expect(alive()).toBe(0);
      return found?.from;
    };
    /** The run's own method is warned of at 0.4 s. */
    const mended = ({ substeps = 0 }: Method): Behaviour =>
      substeps < 30 ? { stepMs: 1, warnedS: 0.4 } : { stepMs: 1 };

    it('goes on a tenth of a second before what was wrong', async () => {
      const from = await best(mended, [leg]);
      expect(from).toMatchObject({ course: [leg], step: 18 });
      expect(from).toHaveProperty('time_s', expect.closeTo(0.3, 9));
    });

    it('goes on from before the setting that was wrong at once', async () => {
      const calm = { ...leg, setting: { ...setting, substeps: 40 } };
      const from = await best(mended, [calm, { ...leg, fromStep: 20 }]);
      expect(from).toMatchObject({ course: [calm], step: 20 });
    });

    it('goes on from an earlier setting where the later one was stretched at once', async () => {
      const calm = { ...leg, setting: { ...setting, substeps: 40 } };
      const stretched = (method: Method) => ({
        ...mended(method),
        ...(Number(method.substeps) < 30 && { stretch: 0.11 }),
      });
      const from = await best(stretched, [calm, { ...leg, fromStep: 12 }]);
      expect(from).toMatchObject({ course: [calm], step: 12 });
    });

    it('starts anew where each state is stretched, or the change fails on the way', async () => {
      const stretched = (method: Method) => ({ ...mended(method), stretch: 0.11 });
      expect(await best(stretched, [leg])).toBe('never sound');
      const onlyAnew = (method: Method) => ({ ...mended(method), isBadOnTheWay: true });
      expect(await best(onlyAnew, [leg])).toBe('fails again');
      const mesh = { ...leg, setting: presetSetting('obj') };
      expect(await best(mended, [mesh])).toBe('carries nothing');
    });
  });

  it('ends when time is over, and says how far it came', async () => {
    const began = performance.now();
    let late = 0;
    vi.spyOn(performance, 'now').mockImplementation(() => began + late);
    const { answer } = tryWith(() => {
      late = 11000;
      return { stepMs: 30 };
    });
    const [first, ...more] = (await answer) ?? [];
    expect(first).toMatchObject({ end: 'late' });
    expect(first?.seenS).toBeGreaterThan(0);
    expect(more).toEqual([]);
  });

  it('tells nothing once it was cut short', async () => {
    const end = new AbortController();
    const { answer, tried, alive } = tryWith(() => {
      end.abort();
      return { stepMs: 1 };
    }, end.signal);
    expect(await answer).toBeNull();
    expect(tried).toHaveLength(1);
    expect(alive()).toBe(0);
  });
});
