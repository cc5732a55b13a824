import { describe, expect, it } from 'vitest';
import { BORNE, reachOf, restEdges, startRefusal } from '../../src/fabrics/state/edge-reach';

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

  it('lets a motion start from what woven cloth bears, and says why not from more', () => {
    expect(startRefusal({ longest: BORNE, shortest: 1 })).toBeNull();
    expect(startRefusal({ longest: 4.21, shortest: 1 })).toMatch(
      /^Stretched to 4\.2 times .* at most 1\.1 times/,
    );
    expect(startRefusal({ longest: 1.104, shortest: 1 })).toMatch(/^Stretched to 1\.104 times/);
    expect(startRefusal({ longest: 1, shortest: 0.5 })).toMatch(/^Pushed together to 0\.50/);
  });
});
