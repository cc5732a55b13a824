import { describe, expect, it } from 'vitest';
import { warningSentence } from '../../src/shared/panels/warning-words';
import { aWarning } from '../support/trial-worker';

describe('warnings of contact', () => {
  const words = (kind: 'held_back' | 'blocked', value: number) =>
    warningSentence({ ...aWarning, kind, value, is_nonsense: false });

  it('tell the share of the vertices that the guard held back', () => {
    expect(words('held_back', 0.12)).toBe(
      'The contact guard holds back 12 % of the vertices, from 0.40 s on: their motion is not the method’s.',
    );
  });

  it('tell in how many substeps pins stayed behind', () => {
    expect(words('blocked', 12)).toBe(
      'Pins or solids would pull cloth through itself, and stay behind: from 0.40 s on in 12 substeps.',
    );
    expect(words('blocked', 1)).toMatch(/in one substep\.$/);
  });
});
