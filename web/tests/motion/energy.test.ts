import { describe, expect, it } from 'vitest';
import { spread } from '../../src/motion/panels/energy/energy-chart';
import { linesOf } from '../../src/motion/panels/energy/energy-lines';
import { energyWords } from '../../src/motion/panels/energy/energy-words';
import { withSample } from '../../src/motion/state/energy-samples';
import { ENERGY_NUMBERS, type EnergyNumbers } from '../../src/shared/bindings/pleat-module';

function numbers(patch: Partial<EnergyNumbers>): EnergyNumbers {
  const none = Object.fromEntries(ENERGY_NUMBERS.map((name) => [name, 0])) as EnergyNumbers;
  return { ...none, ...patch };
}

const begin = numbers({ time_s: 0.5, elastic: 0.01, start: 0.01 });
const fallen = numbers({
  time_s: 1.5,
  kinetic: 0.2,
  elastic: 0.03,
  gravity: -0.28,
  damping: -0.05,
  drift: -0.01,
  start: 0.01,
});

describe('energy samples', () => {
  it('keeps one of each time, the newest', () => {
    const twice = withSample([begin, fallen], numbers({ time_s: 1.5, kinetic: 7 }));
    expect(twice.map(({ kinetic }) => kinetic)).toEqual([0, 7]);
  });

  it('thins out a long run evenly, and keeps its first and last moment', () => {
    let samples: readonly EnergyNumbers[] = [];
    for (let step = 0; step <= 5000; ++step)
      samples = withSample(samples, numbers({ time_s: step }));
    expect(samples.length).toBeLessThan(600);
    expect(samples.length).toBeGreaterThan(200);
    expect(samples[0]?.time_s).toBe(0);
    expect(samples.at(-1)?.time_s).toBe(5000);
    const gaps = samples
      .slice(1)
      .map(({ time_s }, index) => time_s - (samples[index]?.time_s ?? 0));
    expect(Math.max(...gaps)).toBeLessThan(50);
  });
});

describe('energy lines', () => {
  it('leaves out what takes no part, and adds up to what there was', () => {
    const lines = linesOf([begin, fallen]);
    const kinds = lines.map(({ kind }) => kind);
    expect(kinds).toEqual(['kinetic', 'elastic', 'gravity', 'damping', 'drift', 'sum']);
    for (const sample of [begin, fallen])
      expect(lines.at(-1)?.joules(sample)).toBeCloseTo(0.01, 12);
  });

  it('draws a loss upwards', () => {
    const damping = linesOf([begin, fallen]).find(({ kind }) => kind === 'damping');
    expect(damping?.joules(fallen)).toBeCloseTo(0.05, 12);
  });

  it('has the first and the last moment in its table', () => {
    const samples = Array.from({ length: 100 }, (_, time_s) => numbers({ time_s }));
    expect(spread(samples).map(({ time_s }) => time_s)).toEqual([
      0, 12, 25, 37, 50, 62, 74, 87, 99,
    ]);
    expect(spread([begin, fallen])).toEqual([begin, fallen]);
  });
});

/** The words, with plain spaces. */
const plain = (samples: EnergyNumbers[]) => energyWords(samples).replaceAll('\u00a0', ' ');

describe('energy in words', () => {
  it('says what the cloth has, what took energy, and what the method lost', () => {
    const words = plain([begin, fallen]);
    expect(words).toContain('At 1.50 s the cloth moves with 0.20 J');
    expect(words).toContain('bent by 30 mJ, and has 0.28 J less by height than at 0.50 s');
    expect(words).toContain('damping took 50 mJ.');
    expect(words).toContain('The method itself lost 10 mJ, 5.0 % of the most energy of motion');
  });

  it('says what gave energy, and that nothing did', () => {
    const pulled = { ...fallen, pins: 0.4, drift: 0.1, gravity: 0.1 };
    expect(plain([begin, pulled])).toContain('has 0.10 J more by height');
    expect(plain([begin, pulled])).toContain('pins and hand gave 0.40 J');
    expect(plain([begin, pulled])).toContain('The method itself added 0.10 J');
    expect(plain([begin, { ...fallen, damping: 0 }])).toContain('no force took any');
    expect(plain([begin, { ...fallen, tears: -0.02 }])).toContain('tears took 20 mJ');
  });

  it('waits for a second moment', () => {
    expect(energyWords([begin])).toBe('The lines begin with the next step.');
  });
});
