import { describe, expect, it } from 'vitest';
import { springWords } from '../../src/motion/panels/spring-legend';
import { endsOf } from '../../src/shared/stage/spring-lines';

const split = {
  ends: Uint32Array.from([0, 1, 1, 2, 2, 3, 3, 0]),
  isImplicit: Int8Array.from([0, 1, 0, 0]),
};
const alike = { ...split, isImplicit: new Int8Array(0) };

describe('springs', () => {
  it('are drawn in two kinds, each spring in one', () => {
    expect(endsOf(split, true)).toEqual([1, 2]);
    expect(endsOf(split, false)).toEqual([0, 1, 2, 3, 3, 0]);
  });

  it('are not drawn where the stepper takes all alike', () => {
    expect([...endsOf(alike, true), ...endsOf(alike, false)]).toEqual([]);
  });

  it('are counted in a sentence', () => {
    expect(springWords(split, 'IMEX')).toBe('1 of 4 springs are implicit at this step: 25\u00a0%.');
    expect(springWords(alike, 'XPBD')).toBe('XPBD: all 4 springs are taken alike.');
    const none = { ends: new Uint32Array(0), isImplicit: new Int8Array(0) };
    expect(springWords(none, 'Implicit')).toBe('This model has no springs.');
  });
});
