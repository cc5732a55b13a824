import { describe, expect, it } from 'vitest';
import { decodeMotionLink } from '../../src/motion/state/motion-link';
import { presetSetting } from '../../src/motion/state/setting';
import { garmentSentence } from '../../src/refinement/panels/garment-sentence';
import {
  costWords,
  errorWords,
  fromTo,
  levelsSentence,
  lossSentence,
  noticeSentence,
  ONE_MORE_LEVEL,
  sourceSentence,
  storySentences,
} from '../../src/refinement/panels/garment-words';
import { NEUTRAL_COLOUR, paintOf, upperEnd } from '../../src/refinement/panels/paints';
import type { Fit } from '../../src/refinement/state/fit';
import type { PlanFile, PlanStory } from '../../src/refinement/state/plan-file';
import {
  DEFAULT_LINK,
  EMPTY_PANE,
  type GarmentPane,
  initialRefinementState,
  shownPanes,
} from '../../src/refinement/state/refinement-state';
import type { GarmentMesh } from '../../src/refinement/worker/garment-protocol';
import { objText } from '../../src/shared/panels/saving';
import { linearColour, MAGNITUDE_MAP } from '../../src/shared/stage/colormap';

const STORY: PlanStory = {
  examples: ['skirt_walk'],
  patterns: [
    { meansPerM: [5], deviationsPerM: [2], nVertices: 10 },
    { meansPerM: [15], deviationsPerM: [6], nVertices: 5 },
  ],
  nVertices: 900,
  hasLimits: true,
  nSplits: 30,
  nForBalance: 4,
  isByShape: true,
  rule: { kind: 'demand', value: 3 },
};

const PLAN: PlanFile = {
  format: 'pleat plan 1',
  base_mesh: { vertices: 4, fingerprint: '0000000000000000' },
  examples: [
    { name: 'skirt_walk', centres_per_m: [[2, 1]], low_per_m: [0, 0], high_per_m: [1, 1] },
  ],
  patterns: 1,
  patterns_of_vertices: [[0, 4]],
  detail_demand: 3,
  level_cap: 2,
  vertices: 4,
  curvature_limits_per_m: [5],
  splits: [],
};

const FIT: Fit = {
  share: 0.01,
  worst_share: 0.03,
  lasting_share: 0.01,
  n_in_a_row: 0,
  n_frames: 30,
  fires: false,
  first_fired: null,
};

const STATE = initialRefinementState(DEFAULT_LINK, []);

/** All but the fine one alike. */
const panesOf = (other: GarmentPane, fine: GarmentPane) => ({
  coarse: other,
  even: other,
  planned: other,
  fine,
});

describe('garment-words', () => {
  it('says where a cost was found out', () => {
    const pane = { ...EMPTY_PANE, nVertices: 5, msPerFrame: 12.34 };
    expect(costWords({ ...pane, source: 'recorded' }, false)).toBe('12 ms a frame, recorded');
    expect(costWords({ ...pane, source: 'computed' }, false)).toBe('12 ms a frame here');
    expect(costWords({ ...pane, source: 'computed', msPerFrame: null }, false)).toBe(
      'computed here',
    );
    expect(costWords({ ...pane, source: 'recorded' }, true)).toBe('fine’s shape on this mesh');
    expect(errorWords('coarse', { ...pane, distanceM: 0.0123 })).toBe('12 mm off fine');
    expect(errorWords('fine', { ...pane, source: 'resting' })).toBe('');
  });

  it('tells splits that were asked for from those for balance', () => {
    const text = storySentences(STORY);
    expect(text).toContain('2 patterns');
    expect(text).toContain('30 faces were split: 26 where a vertex saves most');
    expect(text).toContain('the other 4 only to keep neighbours');
    expect(storySentences({ ...STORY, nForBalance: 0 })).toContain('none only to keep');
  });

  it('names every example that a plan is made of', () => {
    expect(storySentences(STORY)).toContain('The example walk sorted the coarse');
    const two = { ...STORY, examples: ['skirt_walk', 'skirt_fast_walk in silk'] };
    expect(storySentences(two)).toContain('The examples walk and fast walk in silk each sorted');
    expect(fromTo([1.23, 4.56])).toBe('1.2–4.6');
    expect(fromTo([1.23, 1.231])).toBe('1.2');
  });

  it('says who is computed where, and who waits', () => {
    const computed = { ...EMPTY_PANE, source: 'computed' as const };
    const recorded = { ...EMPTY_PANE, source: 'recorded' as const };
    const mixed = { ...STATE, panes: panesOf(computed, recorded) };
    expect(sourceSentence(mixed)).toContain('come with the page: fine.');
    expect(sourceSentence(mixed)).toContain('on this device: coarse, multi-resolution.');
    const slow = { ...STATE, panes: panesOf(computed, computed) };
    expect(sourceSentence(slow)).toContain('wait for the fine mesh');
    const rest = { ...slow, panes: { ...slow.panes, fine: EMPTY_PANE } };
    expect(sourceSentence(rest)).toContain('rests');
    expect(sourceSentence({ ...slow, method: 'multigrid' })).toContain('position-based');
  });

  it('says what the levels cost, and compares no times of two machines', () => {
    const coarse = { ...EMPTY_PANE, nVertices: 700, msPerFrame: 5, source: 'recorded' as const };
    const fine = { ...coarse, nVertices: 10500, msPerFrame: 100 };
    const panes = panesOf(coarse, fine);
    expect(levelsSentence({ panes })).toContain('15 times the vertices and 20 times the time');
    const here = { ...coarse, source: 'computed' as const };
    expect(levelsSentence({ panes: { ...panes, coarse: here } })).not.toContain('the time');
    expect(levelsSentence({ panes: STATE.panes })).toBe('');
  });

  it('says what faces lose, and how far chance puts the folds of two fine runs', () => {
    const off = { ...EMPTY_PANE, lostM: 0.006 };
    const panes = { ...panesOf(off, EMPTY_PANE), planned: { ...off, lostM: 0.003 } };
    const state = { ...STATE, panes };
    expect(lossSentence(state)).toMatch(
      /The coarse mesh cannot show details smaller than 6\.0 mm, the multi-resolution one none smaller than 3\.0 mm\.$/,
    );
    expect(lossSentence({ ...state, rival: 'even' })).toContain('The even mesh');
    const folded = { ...off, foldsM: 0.0021 };
    const all = { ...state, panes: panesOf(folded, EMPTY_PANE) };
    expect(lossSentence(all)).toContain('some of which is chance');
    const floor = { foldsM: 0.0014, surfaceM: 0.01 };
    expect(lossSentence({ ...all, floor })).toContain('two equally fine runs differ by 1.4 mm too');
    expect(lossSentence(STATE)).toBe('');
  });

  it('leads to the sheet whose errors are known level by level', () => {
    const { link, problems } = decodeMotionLink(ONE_MORE_LEVEL.hash);
    expect(problems).toEqual([]);
    expect(link.setting).toEqual(presetSetting('swinging-sheet'));
  });

  it('names a mesh as its pane does, and not by its place', () => {
    const pane = { ...EMPTY_PANE, nVertices: 1000 };
    const panes = panesOf(pane, { ...pane, nVertices: 5000 });
    const notice = noticeSentence({ ...STATE, panes, plan: PLAN });
    expect(notice).toContain('The multi-resolution mesh has 20 % of the fine');
    expect(notice).not.toContain('middle');
    expect(noticeSentence(STATE)).toContain('a multi-resolution and a fine mesh');
  });

  it('gives the stage to what moves, and to two panes where it is narrow', () => {
    const computed = { ...EMPTY_PANE, nVertices: 700, source: 'computed' as const };
    const resting = { ...EMPTY_PANE, nVertices: 10500 };
    const panes = panesOf(computed, resting);
    expect(shownPanes({ ...STATE, panes, computeFine: false })).toEqual(['coarse', 'planned']);
    expect(shownPanes({ ...STATE, panes: { ...panes, fine: computed } })).toEqual([
      'coarse',
      'planned',
      'fine',
    ]);
    const even = { ...STATE, rival: 'even' as const };
    expect(shownPanes(even)).toEqual(['even', 'planned', 'fine']);
    expect(shownPanes({ ...even, isNarrow: true })).toEqual(['planned', 'fine']);
    expect(shownPanes({ ...even, isNarrow: true, beside: 'rival' })).toEqual(['even', 'fine']);
  });

  it('paints faces by their distance, grey where there is none', () => {
    const mesh = { faces: new Int32Array(14) } as GarmentMesh;
    const shown = { colour: 'distance' as const, ranges: { curvature: 0, distance: 0.01 } };
    const grey = linearColour(NEUTRAL_COLOUR);
    expect(paintOf(shown, mesh, null, 'none')).toEqual({
      kind: 'faces',
      colours: Float32Array.from([...grey, ...grey]),
    });
    const { table } = MAGNITUDE_MAP;
    expect(paintOf(shown, mesh, null, Float32Array.of(0, 0.02))).toEqual({
      kind: 'faces',
      colours: Float32Array.from([...table.slice(0, 3), ...table.slice(-3)]),
    });
    expect(paintOf(shown, mesh, null, null).kind).toBe('vertices');
  });

  it('announces events, not numbers', () => {
    const ready = { ...STATE, phase: 'ready' as const };
    expect(garmentSentence(ready, STATE)).toContain('Ready');
    expect(garmentSentence({ ...ready, timeS: 1 }, ready)).toBeNull();
    const fired = { ...ready, fit: { ...FIT, fires: true, first_fired: 3 } };
    expect(garmentSentence(fired, ready)).toContain('does not fit');
    expect(garmentSentence({ ...fired, timeS: 2 }, fired)).toBeNull();
    expect(garmentSentence(ready, { ...ready, playing: true })).toBe('Paused at 0.0 seconds.');
  });
});

describe('what is saved and painted', () => {
  it('leaves a fiftieth of the values beyond the scale, and unknown ones out', () => {
    const values = Float32Array.from({ length: 101 }, (_, k) => (k === 100 ? 1e6 : k));
    expect(upperEnd(values)).toBe(98);
    expect(upperEnd(Float32Array.of(Number.NaN))).toBe(0);
  });

  it('writes an OBJ with vertices counted from one', () => {
    const text = objText(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), Uint32Array.of(0, 1, 2));
    expect(text).toBe(
      'v 0.00000 0.00000 0.00000\nv 1.00000 0.00000 0.00000\nv 0.00000 1.00000 0.00000\nf 1 2 3\n',
    );
  });
});
