import { beforeAll, describe, expect, it } from 'vitest';
import { FIRST_PICTURE } from '../../src/refinement/state/garment-frames';
import { DEFAULT_LINK } from '../../src/refinement/state/refinement-state';
import { firstPicture, type ShownMesh } from '../support/first-picture';

/** A smaller distance nobody sees [m]. */
const SEEN_M = 0.001;

const PATIENCE_MS = 60000;

let panes: ShownMesh[] = [];
beforeAll(async () => {
  panes = await firstPicture();
}, PATIENCE_MS);

describe('the first picture of refinement', () => {
  it('shows a planned mesh at most half as far off the fine cloth as the coarse one', () => {
    const [coarse, planned, fine] = panes.map(({ off_m: off }) => off);
    expect(panes.map(({ mesh }) => mesh)).toEqual(['coarse', 'planned', 'fine']);
    expect(fine).toBe(0);
    expect(coarse).toBeGreaterThan(SEEN_M);
    expect((planned ?? 1) / (coarse ?? 0)).toBeLessThanOrEqual(0.5);
  });

  it('shows no cloth that passes through itself', () => {
    expect(panes.map(({ n_crossings: n }) => n)).toEqual([0, 0, 0]);
  });

  it('is what a link without a word on it leads to, recorded and as each mesh ran', () => {
    expect(DEFAULT_LINK).toMatchObject({ ...FIRST_PICTURE, rival: 'coarse', fineCloth: false });
    expect(DEFAULT_LINK).toMatchObject({ method: 'implicit', useRecords: true, substeps: null });
  });
});
