import { describe, expect, it } from 'vitest';
import type { BenchRow } from '../../src/motion/bindings/sweep-module';
import { errorWords } from '../../src/motion/panels/numbers/error-words';
import { presetSetting, type Setting, withStepper } from '../../src/motion/state/setting';
import { NO_SWEEP, sweptScene } from '../../src/motion/state/sweep-state';
import type { ReferenceNumbers, RunNumbers } from '../../src/shared/bindings/pleat-module';

const own = presetSetting('curtain');
const reference: ReferenceNumbers = {
  distance_m: 0.012,
  uncertainty_m: 0.003,
  end_s: 2,
  description: 'newton',
  disturbed: false,
};
const running: RunNumbers = {
  time_s: 1,
  step: 60,
  largest_stretch: 0.003,
  rms_stretch: 0.001,
  asked_stretch: null,
  residual: 0.0002,
  iterations: 9,
  parts_ms: {},
  steps_ms: 0,
  steps_timed: 0,
  warnings: [],
  reference: null,
};

const asked = {
  reference: 'here',
  compare: true,
  heat: 'off',
  sweep: NO_SWEEP,
  mesh: null,
} as const;

function wordsOf(numbers: Partial<RunNumbers>, setting: Setting = own) {
  return errorWords({ ...asked, numbers: { ...running, ...numbers }, setting });
}

const against = (patch: Partial<ReferenceNumbers>, setting?: Setting) =>
  wordsOf({ reference: { ...reference, ...patch } }, setting);

describe('error words', () => {
  it('name the distance, and how well the reference is known', () => {
    expect(against({})).toMatchObject({
      value: '12 mm',
      sentence: '12 mm from the reference (known to 3.0 mm).',
    });
  });

  it('give no number that the reference is not known four times better than', () => {
    const { value, sentence } = against({ distance_m: 0.0119 });
    expect(value).not.toMatch(/\d/);
    expect(sentence).toBe('Too close to the reference to tell how far: it is known to 3.0 mm.');
    expect(against({ uncertainty_m: null }).value).toBe('unknown');
    expect(against({ uncertainty_m: null }).sentence).toContain('did not converge');
  });

  it('say that the reference ended, and that a hand led the cloth away from it', () => {
    const ended = against({ distance_m: null, uncertainty_m: null });
    expect(ended.sentence).toContain('the reference ends at 2.0 s');
    const pulled = against({ distance_m: null, uncertainty_m: null, disturbed: true });
    expect(pulled.sentence).toContain('reset to compare');
  });

  it('say nothing of the start, where every method is right', () => {
    const state = { step: 0, reference: { ...reference, distance_m: 0 } };
    expect(wordsOf(state)).toMatchObject({ value: '–', detail: 'play to see' });
  });

  it('say that another mesh has its share, and give no number once folds differ by chance', () => {
    const sheet = presetSetting('swinging-sheet');
    const finer = { ...sheet, level: sheet.level + 1 };
    const early = wordsOf({ time_s: 0.3, reference }, finer);
    expect(early.sentence).toContain('the other mesh');
    for (const words of [
      wordsOf({ time_s: 0.5, reference }, finer),
      against({}, { ...own, level: own.level + 1 }),
    ]) {
      expect(words.value).not.toMatch(/\d/);
      expect(words.sentence).toContain(`Choose level ${own.level} to compare`);
    }
  });

  it('name what is left of the equations and of the length where there is no reference', () => {
    expect(wordsOf({}).sentence).toBe(
      'How wrong this is, nobody has measured. The sums are right to 0.020 %; threads are stretched by 0.30 % at most.',
    );
    expect(wordsOf({ residual: 0 }).sentence).toContain('right exactly');
    expect(wordsOf({ residual: 0 }, withStepper(own, 'rk4')).sentence).toContain('no sums');
    expect(wordsOf({ step: 0 }).sentence).toBe('How wrong this is, nobody has measured.');
  });

  it('name what the sweep found for the very same setting', () => {
    const row = {
      level: own.level,
      method: { stepper: own.stepper, step_s: own.stepS, substeps: own.substeps },
      position_error_m: 0.02,
      reference: { id: 'x', converged: false, description: '' },
      status: 'ok',
    } as unknown as BenchRow;
    const sweep = { ...NO_SWEEP, rows: [row], scene: sweptScene(own, null) };
    const words = errorWords({ ...asked, numbers: running, setting: own, sweep });
    expect(words.value).toBe('20 mm');
    expect(words.sentence).toContain('no converged reference on its own mesh');
    const unasked = { reference: 'unasked', compare: false } as const;
    expect(
      errorWords({ ...asked, ...unasked, numbers: running, setting: own, sweep }),
    ).toMatchObject({ value: '20 mm', action: 'Compare' });
  });
});
