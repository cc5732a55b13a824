// Cloth that comes to lie on itself, with self-contact and without: edges that go through faces,
// counted after every step by code that the guard does not share; what the guard took from the
// motion, and what it cost.
import { join } from 'node:path';

import { BadInput, tell } from './bench-options.mjs';
import { atMost, hasFinished, largest, mean, sideBySide, table } from './bench-rows.mjs';
import { commit, inFolder, ran } from './command.mjs';
import { kStretches, kTimes } from './contact-columns.mjs';
import { kForAll, kForSome, kOfMeshes, kTakeMeshes, withContact } from './contact-scenes.mjs';
import { contestant } from './contestants.mjs';
import { explicitOnes, steppers } from './same-cloth-runs.mjs';
import { kStep } from './sheets.mjs';

const kInEveryScene = ['implicit', 'projective', 'xpbd', 'multigrid'];
const kCoarse = 8; // cells along a side, for steppers of hundreds of substeps a frame
const kTurnFrames = 8;
const kMostHeldBack = 0.01; // share of the vertices, on average
const kMostLostMm = 0.2; // mm lost in a frame

/** The run's metrics. Crossings are counted of runs that write into a folder. */
const metricsOf = (scene) =>
  inFolder((folder) => {
    const words = ['run', scene, '--json', '--out', join(folder, 'frames')];
    return JSON.parse(ran(words, 'pipe').stdout);
  });

/** Mean milliseconds of a frame of each scene, which take turns. */
async function frameTimes(scenes) {
  const frames = Math.round(scenes[0].duration_s / kStep);
  const contestants = scenes.map((scene) => contestant('native', 'native', scene, frames));
  const runs = await sideBySide(contestants, { repeat: 1, frames, turnFrames: kTurnFrames });
  return runs.map(([{ ms }]) => (ms.length ? mean(ms) : Number.NaN));
}

/** Status of a run and kinds of its warnings, each once. */
const toldOf = ({ status, warnings }) => [
  ...new Set([...(status === 'ok' ? [] : [status]), ...warnings.map(({ kind }) => kind)]),
];

async function rowOf(scene, stepper) {
  const about = { scene: scene.name, stepper, commit };
  const both = [true, false].map((self_contact) => withContact(scene, { stepper }, self_contact));
  tell(`${scene.name}, ${stepper}`);
  try {
    const [guarded, free] = both.map(metricsOf);
    const [ms, ms_without] = await frameTimes(both);
    const contact = guarded.cloth_contact;
    return {
      ...about,
      status: guarded.status,
      method: guarded.method,
      n_substeps: guarded.n_substeps,
      n_faces: guarded.n_triangles,
      cloth_contact: contact,
      // RMS of a frame, were all substeps of it held back alike.
      lost_mm_per_frame: 1e3 * contact.rms_motion_lost_m * guarded.n_substeps,
      ms_per_frame: ms,
      ms_per_frame_without: ms_without,
      us_per_face: (1e3 * (ms - ms_without)) / guarded.n_triangles,
      crossings: guarded.largest_crossings,
      crossings_at_end: guarded.crossings_at_end,
      crossings_without: free.largest_crossings,
      largest_stretch: guarded.largest_stretch,
      largest_stretch_without: free.largest_stretch,
      told: toldOf(guarded),
      told_without: toldOf(free),
      reference: { id: 'crossings', description: 'no edge goes through a face' },
      core: guarded.core,
    };
  } catch (error) {
    if (!(error instanceof BadInput)) throw error;
    return { ...about, status: 'refused', told: [error.message], told_without: [] };
  }
}

const kColumns = {
  scene: 'scene',
  stepper: 'stepper',
  faces: 'n_faces',
  pairs: (row) => row.cloth_contact?.n_pairs,
  touching: (row) => row.cloth_contact?.n_touching,
  'held back %': (row) => 100 * row.cloth_contact?.held_back_share,
  'lost mm': 'lost_mm_per_frame',
  blocked: (row) => row.cloth_contact?.n_blocked_substeps,
  ...kTimes,
  crossings: 'crossings',
  'crossings without': 'crossings_without',
  ...kStretches,
  told: (row) => row.told.join(', '),
  'told without': (row) => row.told_without.join(', '),
};

/** Goals of rows that were run: none crosses, and garments that walk are hardly held back. */
export function crossingGoals(rows) {
  const walking = rows.filter(({ scene }) => scene.endsWith('walking'));
  const heldBack = walking.map(({ cloth_contact: contact }) => contact?.held_back_share);
  const lost = walking.map(({ lost_mm_per_frame: mm }) => mm);
  const sum = rows.reduce((all, { crossings }) => all + (crossings ?? Number.NaN), 0);
  return [
    atMost('crossings_with_guard', sum, 0, rows),
    atMost('unfinished_runs', rows.filter((row) => !hasFinished(row)).length, 0),
    atMost('held_back_walking', largest(heldBack), kMostHeldBack, walking),
    atMost('motion_lost_walking_mm', largest(lost), kMostLostMm, walking),
  ];
}

/** Every scene with the steppers that it is for. */
export async function crossings() {
  const rows = [];
  const runAll = async (scenes, names) => {
    for (const make of Object.values(scenes))
      for (const stepper of names) {
        const scene = explicitOnes.includes(stepper) ? make(kCoarse) : make();
        rows.push(await rowOf(scene, stepper));
      }
  };
  await runAll(kForAll, steppers());
  await runAll(kForSome, kInEveryScene);
  await runAll(kOfMeshes, kTakeMeshes);
  return { rows, goals: crossingGoals(rows), text: table(rows, kColumns) };
}
