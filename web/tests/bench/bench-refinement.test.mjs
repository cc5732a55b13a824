import { describe, expect, it } from 'vitest';
import { savingsFigure, ticks } from '../../../bench/parts/charts.mjs';
import {
  buildRow,
  buildTable,
  comparisonGoals,
  faultTable,
  foldFault,
  foldFloor,
  framesToPay,
  frictionGoals,
  insideGoals,
  monitorGoals,
  restartFaults,
  runRow,
  runTable,
  stretchGoals,
  wasmGoals,
} from '../../../bench/parts/refinement-goals.mjs';

const run = {
  scene: 'skirt',
  method: {},
  n_vertices: 1000,
  ms_per_frame: 20,
  dynamics_ms: 16,
  contact_ms: 4,
  refinement_ms: 0,
  n_timed_frames: 3,
  reference: { id: 'fine', description: 'the fine mesh' },
  errors: {
    bend_per_m: 1,
    surface_m: 0.01,
    position_m: 0.02,
    sampling_m: 0.0018,
    sampling_rad: 0.1,
  },
  folds_m: [[0.01, 0.02]],
  rms_stretch: 0.01,
  longest_edge: 0.1,
  inside: { n_frames: 0, most: 0, deepest_m: 0 },
  unpinned_inside: { n_frames: 0, most: 0, deepest_m: 0 },
  fit: { share_outside: 0.004, worst_share: 0.02, n_frames: 9, first_fired: null },
  status: 'ok',
  message: '',
};
const about = { garment: 'skirt', commit: 'c' };
const row = (more = {}) => runRow('a', { ...run, ...more }, about);
const lines = (goals) => goals.map(({ line }) => line);

describe('rows of refinement', () => {
  it('of a run that ended before anything was timed have no milliseconds', () => {
    const early = row({ ms_per_frame: null, status: 'not_finite', errors: { bend_per_m: null } });
    expect(runTable([row(), early])).toMatch(/\| - .* not_finite/);
    expect(early.reference.id).toBe('fine');
  });
});

describe('goals of refinement', () => {
  const fine = row({ n_vertices: 3000, ms_per_frame: 100 });
  const multi = row({ n_vertices: 900, ms_per_frame: 29 });
  const same = row({ errors: { sampling_m: 0.002, sampling_rad: 0.2 } });
  const fold = (pooled) => ({ pooled, least: pooled / 2, most: 2 * pooled });
  const faults = {
    folds: { multi: fold(0.003), same: fold(0.004) },
    floor: 0.001,
    restarts: { multi: 0.0019, same: 0.002, twin: 0.0001 },
  };

  it('hold time to the smaller of 0.3 and 1.15 times the share of vertices', () => {
    expect(lines(comparisonGoals('skirt', { fine, multi, same, faults }))).toEqual([
      'goal skirt_vertices_share 0.3 at-most 0.333 ok',
      'goal skirt_vertices_from_uniform 0.1 at-most 0.03 short',
      'goal skirt_time_share 0.29 at-most 0.3 ok',
      'goal skirt_sampling_to_uniform 0.9 at-most 0.9 ok',
      'goal skirt_sampled_normals_to_uniform 0.5 at-most 0.9 ok',
      'goal skirt_restarts_to_uniform 0.95 at-most 0.9 short',
      'goal skirt_folds_to_uniform 0.75 at-most 0.9 ok',
      'goal skirt_refinement_ms_per_frame 0 at-most 0 ok',
    ]);
    const small = { ...multi, n_vertices: 600 };
    expect(lines(comparisonGoals('trousers', { fine, multi: small, same, faults }))[2]).toBe(
      'goal trousers_time_share 0.29 at-most 0.23 short',
    );
  });

  it('are short when the uniform mesh did not reach its end', () => {
    const ended = { ...same, status: 'not_finite' };
    for (const { ok, name } of comparisonGoals('skirt', { fine, multi, same: ended, faults }))
      expect(ok).toBe(name === 'skirt_refinement_ms_per_frame');
  });

  it('want a monitor that fires on the squat alone', () => {
    const fired = row({ fit: { ...run.fit, first_fired: 70 } });
    const verdicts = (example, test, squat, turn = row()) =>
      monitorGoals('skirt', { example, test, squat, turn }).map(({ ok }) => ok);
    expect(verdicts(row(), row(), fired)).toEqual([true, true, true, true]);
    expect(verdicts(row(), fired, row())).toEqual([true, false, true, false]);
    const first = row({ fit: { ...run.fit, first_fired: 0 } });
    expect(verdicts(row(), first, first, fired)).toEqual([true, false, false, true]);
  });

  it('hold friction to half of the distance without it, in the mean of pairs', () => {
    const apart = (position_m) => row({ errors: { position_m } });
    const { goals, text } = frictionGoals({
      without: [apart(0.04), apart(0.03)],
      withFriction: [apart(0.018), apart(0.0135)],
    });
    expect(lines(goals)).toEqual(['goal skirt_twins_with_friction_to_without 0.45 at-most 0.5 ok']);
    expect(text).toBe('mm apart without friction 40, 30; with it 18, 13.5');
  });

  it('hold the largest stretch of trousers in all motions, and none of a skirt', () => {
    const rows = [row({ longest_edge: 0.12 }), row({ longest_edge: 0.2 })];
    expect(lines(stretchGoals('trousers', rows))).toEqual([
      'goal trousers_longest_edge_stretch 0.2 at-most 0.15 short',
    ]);
    expect(stretchGoals('skirt', rows)).toEqual([]);
  });

  it('count frames with any vertex inside', () => {
    const inside = row({ inside: { n_frames: 2, most: 1, deepest_m: 1e-4 } });
    expect(lines(insideGoals('skirt', [row(), inside]))).toEqual([
      'goal skirt_frames_with_a_vertex_inside_a 0 at-most 0 ok',
      'goal skirt_frames_with_a_vertex_inside_a 2 at-most 0 short',
    ]);
  });

  it('pay for an example in the frames that save its time, or never', () => {
    const plans = { example_s: 7, planning_s: 0.1 };
    expect(framesToPay(plans, fine, multi)).toBe(100);
    expect(framesToPay(plans, multi, fine)).toBeNaN();
  });
});

describe('faults of several runs', () => {
  const runs = [[[0.003, 0.004]], [[0.003, 0.004]]];

  it('pool amplitudes by their squares and tell how far single runs are', () => {
    const fault = foldFault([[[0, 0.004]], [[0.003 * Math.SQRT2, 0.004]]], runs);
    expect(fault.pooled).toBeCloseTo(0, 12);
    expect(fault.least).toBeCloseTo(0.003 * (Math.SQRT2 - 1), 12);
    expect(fault.most).toBeCloseTo(0.003, 12);
  });

  it('take the halves of the fine runs for what chance makes', () => {
    expect(foldFloor(runs)).toBe(0);
    expect(foldFloor([...runs, [[0.003, 0.006]], [[0.003, 0.006]]])).toBeCloseTo(0.002, 12);
  });

  it('have no number where a restart did not reach its end', () => {
    const [whole, ended] = restartFaults([
      { errors_m: [0.003, 0.004] },
      { errors_m: [0.003, null] },
    ]);
    expect(whole).toBeCloseTo(Math.sqrt(12.5e-6), 12);
    expect(ended).toBeNaN();
  });

  it('stand in one table with their floors', () => {
    const fold = { pooled: 0.003, least: 0.002, most: 0.005 };
    const restarts = { multi: 0.001, same: 0.002, twin: 1e-5 };
    const table = faultTable({ folds: { multi: fold, same: fold }, floor: 1e-4, restarts });
    expect(table).toMatch(/\| multi .* 3 .* 2 .* 5 .* 1 /);
    expect(table).toMatch(/the floor .* 0.1 .* - .* - .* 0.01 /);
  });
});

describe('both builds', () => {
  const { errors, reference } = run;
  const settings = { ...about, scene: { name: 'skirt', method: {} }, errors, reference };
  const built = (target, ...times) =>
    buildRow(
      times.map((ms_per_frame) => ({ ...run, ms_per_frame, target })),
      settings,
    );

  it('have the median of their runs and the same errors', () => {
    const wasm = built('wasm', 40, 20, 60);
    expect(wasm).toMatchObject({ ms_per_frame: 40, spread_ms: 40, n_runs: 3, target: 'wasm' });
    const table = buildTable({ wasm, native: built('native', 20) });
    expect(table.match(/\| wasm .*/)[0]).toMatch(/ 40 .* 2 .* 1 .* 10 .* 20 .* ok/);
  });

  it('hold a frame in WebAssembly to the time that it shows, on this machine', () => {
    const verdict = (ms, scale) => lines(wasmGoals('skirt', built('wasm', ms), scale))[0];
    expect(verdict(33, 1)).toBe('goal skirt_multi_ms_per_frame_wasm 33 at-most 33.3 ok');
    expect(verdict(34, 1)).toBe('goal skirt_multi_ms_per_frame_wasm 34 at-most 33.3 short');
    expect(verdict(34, 2)).toBe('goal skirt_multi_ms_per_frame_wasm 34 at-most 66.7 ok');
    expect(verdict(Number.NaN, 1)).toBe('goal skirt_multi_ms_per_frame_wasm - at-most 33.3 short');
  });
});

describe('the figure of savings', () => {
  it('has ticks at round numbers that reach beyond all values', () => {
    expect(ticks(100)).toEqual([0, 20, 40, 60, 80, 100]);
    expect(ticks(9)).toEqual([0, 2, 4, 6, 8, 10]);
    expect(ticks(0.7).at(-1)).toBeGreaterThanOrEqual(0.7);
  });

  it('marks every point with an error twice and names what was published', () => {
    const point = { garment: 'skirt', kind: 'plan', removed: 70, faster: 4, lostMm: 0.5 };
    const none = savingsFigure([point], []).match(/<circle/g).length;
    const more = savingsFigure([point, point, { ...point, lostMm: Number.NaN }], ['7 s < 9 s']);
    expect(more.match(/<circle/g).length).toBe(none + 2);
    expect(more).toContain('73.8 %');
    expect(more).toContain('76.2 %');
    expect(more).toContain('7 s &lt; 9 s');
    expect(more).not.toMatch(/NaN|undefined|Infinity/);
  });
});
