import { describe, expect, it } from 'vitest';
import {
  BORNE,
  BORNE_SHORT,
  type EdgeReach,
  easedSentence,
  easedShape,
  easedWords,
  reachOf,
  restEdges,
} from '../../src/fabrics/state/edge-reach';

/** Two triangles of a unit square. */
const SQUARE = Float64Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]);
const edges = restEdges(Uint32Array.from([0, 1, 2, 1, 3, 2]), SQUARE);

describe('the reach of edges', () => {
  it('is one at rest, wherever the cloth is', () => {
    const elsewhere = SQUARE.map((metres) => metres + 7);
    for (const ratio of Object.values(reachOf(edges, elsewhere))) expect(ratio).toBeCloseTo(1, 12);
  });

  it('is that of the longest and of the shortest edge', () => {
    const pulled = Float64Array.from(SQUARE);
    pulled.set([3, 1, 0], 9); // the last corner, two metres along
    const { longest, shortest } = reachOf(edges, pulled);
    expect(longest).toBeCloseTo(3, 12);
    expect(shortest).toBeCloseTo(1, 12);
    pulled.set([1, 0.4, 0], 9);
    expect(reachOf(edges, pulled).shortest).toBeCloseTo(0.4, 12);
  });

  it('eases a shape in as far as cloth bears it, and no less', () => {
    const pulled = Float64Array.from(SQUARE);
    pulled.set([3, 1, 0], 9);
    pulled.set([0.3, 0, 0.2], 0);
    const { share } = reachOf(edges, pulled);
    expect(share).toBeGreaterThan(0);
    expect(share).toBeLessThan(1);
    const at = (part: number) => reachOf(edges, easedShape(SQUARE, pulled, part));
    const isBorne = ({ longest, shortest }: EdgeReach) =>
      longest <= BORNE + 1e-9 && shortest >= BORNE_SHORT - 1e-9;
    for (const part of [0, 0.2, 0.5, 0.9, 1]) expect(isBorne(at(part * share))).toBe(true);
    expect(isBorne(at(1.001 * share))).toBe(false);
  });

  it('stops where an edge would be short on its way, whatever its end', () => {
    const turned = SQUARE.map((metres) => -metres); // half a turn: halfway all is one point
    expect(reachOf(edges, turned).longest).toBeCloseTo(1, 12);
    expect(reachOf(edges, turned).share).toBeCloseTo((1 - BORNE_SHORT) / 2, 12);
  });

  it('starts a motion from a shape that cloth bears as it is', () => {
    const lifted = Float64Array.from(SQUARE);
    lifted.set([1.02, 1.03, 0.1], 9);
    expect(reachOf(edges, lifted).share).toBe(1);
    expect(easedShape(SQUARE, lifted, 1)).toEqual(lifted);
    expect(easedWords({ share: 1 })).toBe('');
    expect(easedSentence({ longest: BORNE, shortest: 1, share: 1 })).toBeNull();
  });

  it('says how far it is eased in, and why no farther', () => {
    expect(easedWords({ share: 0.6 })).toBe('eased in by 60 %');
    expect(easedSentence({ longest: 4.21, shortest: 1, share: 0.12 })).toMatch(
      /eased in by 12 % of the way .* stretched to 4\.2 times .* about 1\.1\.$/,
    );
    expect(easedSentence({ longest: 1.104, shortest: 1, share: 0.9 })).toContain('1.104 times');
    expect(easedSentence({ longest: 1, shortest: 0.5, share: 0.2 })).toMatch(
      /eased in by 20 % .* pushed together to 0\.50/,
    );
    expect(easedSentence({ longest: 1, shortest: 1, share: 0.3 })).toContain('eased in by 30 %');
  });
});
