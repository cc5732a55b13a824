import { describe, expect, it } from 'vitest';
import { USUAL_DEMANDS_MM } from '../../src/refinement/state/garment-frames';
import {
  decodeRefinementLink,
  encodeRefinementLink,
} from '../../src/refinement/state/refinement-link';
import { DEFAULT_LINK, type RefinementLink } from '../../src/refinement/state/refinement-state';

describe('refinement-link', () => {
  it('starts from the default for whoever comes without a wish', () => {
    expect(decodeRefinementLink('#view=refinement')).toEqual({ link: DEFAULT_LINK, problems: [] });
  });

  it('comes back as it went', () => {
    const link: RefinementLink = {
      garment: 'trousers',
      motion: 'squat',
      fabric: 'silk',
      further: ['squat', 'walk'],
      rule: 'budget',
      demand: USUAL_DEMANDS_MM.trousers,
      budget: 2500,
      rival: 'even',
      method: 'implicit',
      substeps: 8,
      useRecords: false,
      computeFine: false,
      fineCloth: true,
      colour: 'distance',
      edges: false,
      hanging: true,
      speed: 0.25,
      startS: 1.233,
    };
    expect(decodeRefinementLink(`#${encodeRefinementLink(link)}`)).toEqual({ link, problems: [] });
    const demand = { ...link, rule: 'demand' as const, budget: null, demand: 2.7 };
    expect(decodeRefinementLink(encodeRefinementLink(demand))).toEqual({
      link: demand,
      problems: [],
    });
  });

  it('takes position-based steps for a skirt, and for trousers says why not', () => {
    const link: RefinementLink = { ...DEFAULT_LINK, method: 'multigrid' };
    expect(encodeRefinementLink(link)).toContain('method=multigrid');
    expect(decodeRefinementLink(encodeRefinementLink(link))).toEqual({ link, problems: [] });
    const trousers = decodeRefinementLink('#view=refinement&garment=trousers&method=multigrid');
    expect(trousers.link.method).toBe('implicit');
    expect(trousers.problems).toEqual(['method: expected implicit, found "multigrid"']);
  });

  it('says what it cannot read and goes on with the rest', () => {
    const { link, problems } = decodeRefinementLink(
      '#view=refinement&garment=hat&motion=turn&examples=squat,hat&lost-mm=8&vertices=-3&start=late&hat=1',
    );
    expect(link).toEqual({ ...DEFAULT_LINK, motion: 'turn' });
    expect(problems).toEqual([
      'garment: expected skirt, trousers, slim_trousers, found "hat"',
      'examples: expected some of walk, fast_walk, turn, squat, found "squat,hat"',
      'lost-mm: expected 0.5 to 4 in tenths, found "8"',
      'vertices: expected a number of vertices, found "-3"',
      'start: expected a time in seconds, found "late"',
      'hat: not a known part',
    ]);
  });
});
