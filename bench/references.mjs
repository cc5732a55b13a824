// ./pleat bench references (--help tells the options)
// References of all other errors, held against something of their own: a closed form, half the
// step, finer meshes; the cost of the exact method; and a sweep that is killed.
import { asset, readJson } from './parts/assets.mjs';
import { tell } from './parts/bench-options.mjs';
import { runParts } from './parts/bench-parts.mjs';
import { atMost, described, measure, millimetres, rowsOf, short } from './parts/bench-rows.mjs';
import { cantilever } from './parts/cantilever.mjs';
import { ask, nativeRun, reference } from './parts/command.mjs';
import { contestant as contestantOf } from './parts/contestants.mjs';
import { killedSweep } from './parts/killed-sweep.mjs';
import { by, kStep } from './parts/sheets.mjs';

const kModels = ['springs', 'membrane']; // each with the bending that goes with it
const swinging = readJson(asset('scenes', 'swinging_sheet.json'));

const sheet = (level, elasticity, method) =>
  by({ ...swinging, refinement: { level }, model: { elasticity } }, method);
const cells = (level) => swinging.cloth.sheet.columns << level;
const size = (level) => `${cells(level) + 1}x${cells(level) + 1}`;
const newton = (stepsPerSecond) => ({
  stepper: 'newton',
  rule: 'midpoint',
  step_s: 1 / stepsPerSecond,
});

function contestant(level, elasticity, label, method, frames, target = 'native') {
  const scene = sheet(level, elasticity, method);
  return contestantOf(target, `${size(level)}, ${elasticity}, ${label}`, scene, frames);
}

/** `newton` with the midpoint rule on the same mesh, and how far halving its step moved it. */
function halvedReference(level, elasticity, stepsPerSecond, times) {
  tell(`reference ${size(level)}, ${elasticity}, step 1/${stepsPerSecond} s`);
  return reference(sheet(level, elasticity, newton(stepsPerSecond)), 'run', times, ['--halved']);
}

/** Errors of time steps alone on 33x33 vertices. */
async function time({ repeat }) {
  const kMostRounds = 3; // minutes each; no goal is about their speed
  const kTimes = [0.5, 1]; // [s]
  const kStepsPerSecond = { springs: 3840, membrane: 7680 };
  const kLevel = 2;
  const kLargestShare = 0.25; // share of an error that its reference may be wrong by
  const exact = (stepper, substeps) => ({ stepper, substeps, solver: 'cholmod' });
  const methods = {
    'implicit x1': exact('implicit', 1),
    'implicit x4': exact('implicit', 4),
    'implicit x16': exact('implicit', 16),
    'newton x4': { ...exact('newton', 4), rule: 'midpoint' },
    'newton x8': { ...exact('newton', 8), rule: 'midpoint' },
  };
  const forSprings = {
    'projective 4x5': { ...exact('projective', 4), iterations: 5 },
    'xpbd x30': { stepper: 'xpbd', substeps: 30 },
    'xpbd x100': { stepper: 'xpbd', substeps: 100 },
  };
  const rows = [];
  const goals = [];
  for (const model of kModels) {
    const against = halvedReference(kLevel, model, kStepsPerSecond[model], kTimes);
    const shown = model === 'springs' ? { ...methods, ...forSprings } : methods;
    const contestants = Object.entries(shown).map(([label, method]) =>
      contestant(kLevel, model, label, method, 60),
    );
    const rounds = Math.min(repeat, kMostRounds);
    const found = await measure(contestants, { repeat: rounds, times: kTimes, against });
    const shareAt = (row) => (at, t) =>
      against.samples[t].halving_changed_m / row.position_errors_m[`${at} s`];
    const shares = found.map((row) => Math.max(...kTimes.map(shareAt(row))));
    for (const [i, row] of found.entries())
      row.reference = { ...row.reference, converged: shares[i] <= kLargestShare };
    const name = `time_reference_change_over_smallest_error_${model}`;
    goals.push(atMost(name, Math.max(...shares), kLargestShare, found));
    rows.push(...found);
  }
  return { rows, goals };
}

/**
 * Errors of meshes alone, at a step whose error is far below: against where three meshes lead. At
 * the later time the free edge whips, and meshes this coarse lead nowhere.
 */
async function mesh() {
  const kTimes = [0.4, 0.5]; // [s]
  const kLevels = [1, 2, 3];
  const kStepsPerSecond = 960;
  const rows = [];
  const lines = [];
  for (const model of kModels) {
    const runs = kLevels.map((level) => {
      tell(`mesh ${size(level)}, ${model}`);
      const scene = sheet(level, model, newton(kStepsPerSecond));
      return nativeRun(scene, kTimes.at(-1) / kStep, kTimes);
    });
    const [{ masses_kg, core }] = runs; // masses of the vertices that all three have
    const meshes = runs.map((run) => run.samples);
    const { samples } = ask('bench', 'limit', { masses_kg, meshes });
    const against = {
      reference: {
        id: `limit-of-meshes-${model}-${core}`,
        description: `where ${model} on ${kLevels.map(size).join(', ')} lead at their observed rate`,
        converged: false,
        uncertainty_m: null,
      },
      samples,
      rest_diagonal_m: Math.hypot(swinging.cloth.sheet.width_m, swinging.cloth.sheet.height_m),
    };
    const label = `newton, step 1/${kStepsPerSecond} s`;
    const method = newton(kStepsPerSecond);
    const contestants = kLevels.map((level) => contestant(level, model, label, method, 0));
    const each = runs.map((run) => [run]);
    rows.push(...rowsOf(contestants, each, { times: kTimes, against, masses: masses_kg }));
    const halved = halvedReference(2, model, 2 * kStepsPerSecond, kTimes).samples;
    lines.push(
      ...kTimes.map((at, t) => {
        const { rate, distances_m } = samples[t];
        const apart = `successive meshes ${millimetres(distances_m)} mm apart`;
        const steps = `halving the step moves ${size(2)} by ${millimetres([halved[t].halving_changed_m])} mm`;
        return `shown mesh_error_rate_${model}_${at}_s ${short(rate)} (${apart}; ${steps})`;
      }),
    );
  }
  return { rows, goals: [], text: `${described(rows)}\n\n${lines.join('\n')}` };
}

/** Cost of a step of the exact method at the length that references take. */
async function step({ repeat, scale }) {
  const kLevel = 3;
  const kStepsPerSecond = 960;
  const kFrames = 6;
  const kTimes = [kFrames * kStep]; // [s]
  const method = newton(kStepsPerSecond);
  tell(`reference ${size(kLevel)}, step 1/${2 * kStepsPerSecond} s`);
  const against = reference(sheet(kLevel, 'membrane', newton(2 * kStepsPerSecond)), 'run', kTimes);
  const label = `newton, step 1/${kStepsPerSecond} s`;
  const found = [];
  for (const [target, rounds] of Object.entries({ native: repeat, wasm: 1 })) {
    const one = contestant(kLevel, 'membrane', label, method, kFrames, target);
    const settings = { repeat: rounds, times: kTimes, against, frames: kFrames };
    found.push(...(await measure([one], settings)));
  }
  const rows = found.map((row) => ({
    ...row,
    ms_per_step: row.ms_per_frame / (kStep * kStepsPerSecond),
  }));
  const [native] = rows;
  const steps = rows.map((row) => `${short(row.ms_per_step)} ms (${row.target})`).join(', ');
  return {
    rows,
    goals: [atMost('newton_65x65_ms_per_step', native.ms_per_step, 600 * scale, [native])],
    text: `${described(rows)}\n\na step takes ${steps}`,
  };
}

const sweep = () => killedSweep({ ...swinging, refinement: { level: 0 } });

const purpose = 'what references are held against, and the goals they have to meet';
await runParts('references', purpose, { cantilever, time, mesh, step, sweep });
