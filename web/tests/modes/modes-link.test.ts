import { describe, expect, it } from 'vitest';
import type { KeyShape } from '../../src/modes/state/key-shapes';
import {
  decodeModesLink,
  encodeModesLink,
  hasUnlinkedKeys,
} from '../../src/modes/state/modes-link';
import { initialModesState, usualLink } from '../../src/modes/state/modes-state';

function stateOf(hash: string) {
  const { link, problems } = decodeModesLink(hash);
  const keys = link.keys.map((origin): KeyShape => ({ origin, positions: new Float64Array(3) }));
  return { ...initialModesState(link, problems), keys };
}

describe('link of modes', () => {
  it('is of a mode of the bar when it says nothing', () => {
    const { link, problems } = decodeModesLink('#view=modes');
    expect(problems).toEqual([]);
    expect(link).toEqual(usualLink('bar'));
    expect(link.showing).toBe('modes');
  });

  it('comes back as it was written', () => {
    const hash =
      'view=modes&model=bar&cells=4&volume=lattice&energy=surface&both=on&count=20&mix=1:0.5_12:-1&show=modes&time=1.25&ghost=off&edges=on&keys=rest;bent-90;volume-2:0.3';
    const state = stateOf(`#${hash}`);
    expect(state.problem).toBe(null);
    expect(state.amplitudes).toEqual([0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1]);
    expect(encodeModesLink(state)).toBe(hash);
  });

  it('keeps frames of a drape for the cloth alone', () => {
    const keys = 'keys=frame-0;frame-60';
    expect(decodeModesLink(`#view=modes&model=cloth&${keys}`).problems).toEqual([]);
    const { link, problems } = decodeModesLink(`#view=modes&${keys}`);
    expect(problems).toHaveLength(1);
    expect(link.keys).toEqual(usualLink('bar').keys);
  });

  it.each([
    ['model=moon', 'model'],
    ['energy=cloth', 'energy'],
    ['cells=7', 'cells'],
    ['count=13', 'count'],
    ['mix=1:2', 'mix'],
    ['mix=99:0.5', 'mix'],
    ['time=1.5', 'time'],
    ['keys=rest', 'keys'],
    ['keys=rest;bent-999', 'keys'],
    ['keys=rest;rest;rest;rest;rest;rest;rest;rest;rest', 'keys'],
  ])('says of %s what it cannot be', (part, key) => {
    const { link, problems } = decodeModesLink(`#view=modes&${part}`);
    expect(problems).toHaveLength(1);
    expect(problems[0]).toMatch(new RegExp(`^${key}: expected`));
    expect(link).toEqual(usualLink('bar'));
  });

  it('leaves out keys from files, and says that it does', () => {
    const state = stateOf('#view=modes');
    expect(hasUnlinkedKeys(state)).toBe(false);
    const file: KeyShape = {
      origin: { kind: 'file', name: 'arm.obj' },
      positions: new Float64Array(3),
    };
    const withFile = { ...state, keys: [...state.keys, file] };
    expect(hasUnlinkedKeys(withFile)).toBe(true);
    expect(encodeModesLink(withFile)).toMatch(/keys=rest;bent-180$/);
    expect(encodeModesLink({ ...state, keys: [file, file] })).not.toMatch(/keys=/);
  });
});
