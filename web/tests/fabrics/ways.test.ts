import { describe, expect, it } from 'vitest';
import { decodePairLink, encodePairLink } from '../../src/fabrics/state/pair';
import { wayIn } from '../../src/fabrics/state/ways';

describe('ways of looking at fabrics', () => {
  it.each([
    ['#view=fabrics', 'strips'],
    ['', 'strips'],
    ['#view=fabrics&show=moon', 'strips'],
    ['#view=fabrics&scene=ball', 'shapes'],
    ['#view=fabrics&gallery=on', 'shapes'],
    ['#view=fabrics&show=shapes', 'shapes'],
    ['#view=fabrics&show=pair&scene=flag', 'pair'],
  ])('has %j show %s', (hash, way) => {
    expect(wayIn(hash)).toBe(way);
  });

  it('has two fabrics and their scene in a link and back', () => {
    const link = { scene: 'flag', pair: ['coarse cotton (denim)', 'silk'] } as const;
    expect(decodePairLink(`#${encodePairLink(link)}`)).toEqual({ link, problems: [] });
  });

  it('says what of a link for two is not known', () => {
    const { link, problems } = decodePairLink('#view=fabrics&show=pair&scene=moon&fabrics=silk');
    expect(link).toEqual({ scene: 'swags', pair: ['silk', 'canvas'] });
    expect(problems.map((sentence) => sentence.split(':')[0])).toEqual(['scene', 'fabrics']);
  });
});
