// A stepper is one row of a table: a made-up one, added there alone, is found wherever the page has steppers.
import { describe, expect, it, vi } from 'vitest';
import { markOf } from '../../src/motion/panels/chart/stepper-mark';
import { STEPPER_CHOICES } from '../../src/motion/panels/method/method-panel';
import { decodeMotionLink, encodeMotionLink } from '../../src/motion/state/motion-link';
import { presetSetting, sceneOf, withModel, withStepper } from '../../src/motion/state/setting';
import { sweepPlan } from '../../src/motion/state/sweep-plan';

vi.mock('virtual:pleat-steppers', async (original) => {
  const { default: rows, details } = await original<{ default: object[]; details: object[] }>();
  const leapfrog = {
    name: 'leapfrog',
    title: 'Leapfrog',
    meaning: 'Velocities between positions.',
    needs_springs: true,
    solves: false,
    settings: { iterations: { start: 7, least: 2, meaning: 'Leaps.' } },
    details: {},
    sweep: [{ iterations: 3 }],
    solves_whole_substeps: false,
    substep_work: 2,
    models: ['springs'],
    finest_sweep_level: 0,
    mark: 'M0 0H1',
    colour: '#123456',
    dark_colour: '#abcdef',
  };
  return { default: [...rows, leapfrog], details };
});

const start = presetSetting('curtain');

describe('a row more in the table of steppers', () => {
  it('is a choice of the method panel', () => {
    expect(STEPPER_CHOICES.at(-1)).toEqual({ value: 'leapfrog', title: 'Leapfrog' });
  });

  it('takes part in the sweep of its models, up to its finest level', () => {
    const planned = sweepPlan(presetSetting('swinging-sheet'), {
      finest: 1,
      withSlow: true,
    }).settings.filter((one) => one['/method'].stepper === 'leapfrog');
    const method = { stepper: 'leapfrog', step_s: 1 / 60, iterations: 3 };
    expect(planned).toEqual([{ '/refinement/level': 0, '/method': method }]);
    const { settings } = sweepPlan(withModel(start, 'membrane'), { finest: 1, withSlow: true });
    expect(settings.filter((one) => one['/method'].stepper === 'leapfrog')).toEqual([]);
  });

  it('has its mark and both colours in the chart', () => {
    const { path, style } = markOf('leapfrog');
    expect(path).toBe('M0 0H1');
    expect(style).toBe('--mark: #123456; --mark-dark: #abcdef');
  });

  it('is read from a link and written to one, with its own counts alone', () => {
    const { link, problems } = decodeMotionLink('#scene=curtain&stepper=leapfrog&iterations=5');
    expect(problems).toEqual([]);
    expect(link.setting).toMatchObject({ stepper: 'leapfrog', iterations: 5 });
    expect(encodeMotionLink(link)).toContain('stepper=leapfrog');
    expect(decodeMotionLink('#stepper=leapfrog&iterations=1').problems.join()).toContain('2 to');
    const { method } = sceneOf(withStepper(start, 'leapfrog'));
    expect(method).toEqual({ stepper: 'leapfrog', step_s: start.stepS, iterations: 7 });
  });

  it('gives way to one that can run a membrane', () => {
    expect(withModel(withStepper(start, 'leapfrog'), 'membrane').stepper).toBe('implicit');
    expect(decodeMotionLink('#model=membrane&stepper=leapfrog').problems).toHaveLength(1);
  });
});
