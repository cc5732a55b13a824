import { describe, expect, it } from 'vitest';
import { answerSentence, tangleSentence } from '../../src/refinement/panels/answer-words';
import { errorWords } from '../../src/refinement/panels/garment-words';
import {
  DEFAULT_LINK,
  EMPTY_PANE,
  type GarmentPane,
  initialRefinementState,
  type RefinementState,
} from '../../src/refinement/state/refinement-state';

const NO_FAULTS = { n_inside: 0, deepest_m: 0, n_crossings: 0 };
const RECORDED: GarmentPane = { ...EMPTY_PANE, source: 'recorded', faults: NO_FAULTS };

const coarse = { ...RECORDED, nVertices: 714, distanceM: 0.0049, msPerFrame: 8 };
const planned = { ...RECORDED, nVertices: 1760, distanceM: 0.0021, msPerFrame: 40 };
const fine = { ...RECORDED, nVertices: 10920, msPerFrame: 400 };

const STATE: RefinementState = {
  ...initialRefinementState(DEFAULT_LINK, []),
  phase: 'ready',
  panes: { coarse, even: EMPTY_PANE, planned, fine },
};

const withPanes = (patch: Partial<RefinementState['panes']>): RefinementState => ({
  ...STATE,
  panes: { ...STATE.panes, ...patch },
});

describe('the answer of the picture', () => {
  it('says how far off each mesh is, and at what cost', () => {
    expect(answerSentence(STATE)).toBe(
      'The multi-resolution skirt is 2.1 mm off the fine one at 10 % of its time; the coarse one is 4.9 mm off.',
    );
    expect(answerSentence({ ...STATE, garment: 'trousers' })).toContain(
      'trousers are 2.1 mm off the fine ones at 10 % of their time; the coarse ones are 4.9 mm',
    );
    const here = withPanes({ planned: { ...planned, source: 'computed' } });
    expect(answerSentence(here)).toContain('with 16 % of its vertices');
    expect(answerSentence(withPanes({ planned: { ...planned, distanceM: null } }))).toBe('');
  });

  it('says of another fabric what is computed of it, and until then that it has to be', () => {
    const silk: RefinementState = { ...STATE, fabric: 'silk', phase: 'loading' };
    const empty = { coarse: EMPTY_PANE, even: EMPTY_PANE, planned: EMPTY_PANE, fine: EMPTY_PANE };
    // The numbers that are still there are of the fabric before.
    for (const panes of [empty, STATE.panes])
      expect(answerSentence({ ...silk, panes })).toBe(
        'How far off each mesh is, is known beforehand in fine cotton only: in silk it is computed here.',
      );
    expect(answerSentence({ ...STATE, phase: 'loading' })).toBe('');
    const here = (pane: GarmentPane): GarmentPane => ({
      ...pane,
      source: 'computed',
      faults: null,
    });
    const panes = { ...STATE.panes, planned: here(planned), coarse: here(coarse) };
    const playing: RefinementState = { ...silk, panes, phase: 'ready', playing: true };
    expect(answerSentence(playing)).toBe(
      'Computed now in silk: multi-resolution 2.1 mm off fine, coarse 4.9 mm. Pause to learn whether cloth passes through itself.',
    );
    expect(answerSentence({ ...playing, playing: false })).toContain('with 16 % of its vertices');
  });

  it('says that nobody knows where the fine mesh rests', () => {
    const resting = withPanes({
      planned: { ...planned, distanceM: null },
      fine: { ...fine, source: 'resting' },
    });
    expect(answerSentence(resting)).toMatch(/^The fine mesh rests/);
    expect(answerSentence({ ...resting, phase: 'loading' })).toBe('');
  });

  it('tells the numbers of the badges', () => {
    for (const id of ['coarse', 'planned'] as const) {
      const [length] = errorWords(id, STATE.panes[id]).split(' off');
      expect(answerSentence(STATE)).toContain(length);
    }
  });

  it('claims nothing where the planned mesh is not much nearer', () => {
    const still = withPanes({ planned: { ...planned, distanceM: 0.0048 } });
    expect(answerSentence(still)).not.toContain('Once they move');
    const astray = { ...still, timeS: 1 };
    expect(answerSentence(astray)).toMatch(
      /^Once they move, .* 4\.8 mm off the fine one, the coarse one 4\.9 mm\.$/,
    );
    expect(answerSentence(astray)).not.toContain('%');
  });

  it('claims nothing where cloth is through itself, and says where', () => {
    const tangled = withPanes({ fine: { ...fine, faults: { ...NO_FAULTS, n_crossings: 609 } } });
    expect(tangleSentence(STATE)).toBeNull();
    expect(answerSentence(tangled)).toBe(tangleSentence(tangled));
    expect(answerSentence(tangled)).toContain('coarse 0, multi-resolution 0, fine 609');
  });
});
