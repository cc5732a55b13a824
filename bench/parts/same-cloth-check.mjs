// Cost of looking, after each step, whether cloth has come to rest where its model is in no
// equilibrium: as a share of the steps, of cloth that rests most of the time.
import { shippedScene } from './assets.mjs';
import { tell } from './bench-options.mjs';
import { atMost, largest, markdown } from './bench-rows.mjs';
import { printed } from './command.mjs';

const kFrames = 1500; // 25 s: looks come from rest on, each as dear as some steps
const kMostShare = 0.01;
const kScenes = ['tablecloth', 'curtain'];
const kLevel = 2;

const sum = (values) => values.reduce((all, value) => all + value, 0);

function rowOf(scene, stepper) {
  tell(`${scene}, ${stepper}`);
  const words = ['bench', 'run', shippedScene(scene), '--rest', '--stepper', stepper];
  const more = ['--level', kLevel, '--step', 1 / 60, '--frames', kFrames];
  const { ms, rest_ms, n_vertices, status, core } = JSON.parse(printed(...words, ...more));
  const looks = rest_ms.slice(1); // the first frame is on no clock
  return {
    case: scene,
    stepper,
    n_vertices,
    status,
    core,
    ms: sum(ms) / ms.length,
    look_ms: sum(looks) / looks.length,
    share: sum(looks) / sum(ms),
    reference: { id: 'steps', description: 'wall time of the steps themselves' },
  };
}

/** Times the looks beside these steppers; those of thousands of substeps take hours to rest. */
export function checkCosts(names) {
  const rows = kScenes.flatMap((scene) => names.map((stepper) => rowOf(scene, stepper)));
  const columns = ['scene', 'stepper', 'ms a step', 'ms a look', 'share %'];
  const lines = rows.map((row) => [row.case, row.stepper, row.ms, row.look_ms, 100 * row.share]);
  return {
    rows: [],
    goals: [
      atMost(
        'equilibrium_check_share_of_a_step',
        largest(rows.map(({ share }) => share)),
        kMostShare,
        rows,
      ),
    ],
    text: markdown(columns, lines),
  };
}
