// ./pleat bench multigrid (--help tells the options)
// Savings of coarser levels: position-based steps against a plain loop and one by one, and solves of
// implicit steps; and the cost of making them.
import { runParts } from './parts/bench-parts.mjs';
import { convergence } from './parts/convergence.mjs';
import { experiments } from './parts/experiments.mjs';
import { skirt } from './parts/fine-skirt.mjs';
import { guards } from './parts/guards.mjs';
import { hierarchy } from './parts/hierarchy.mjs';
import { contact } from './parts/loop-contact.mjs';
import { loop, loopOptions } from './parts/loop-contest.mjs';
import { clothOption, preconditioner } from './parts/multigrid-preconditioner.mjs';

const parts = {
  loop,
  contact,
  convergence,
  preconditioner,
  hierarchy,
  guards,
  experiments,
  skirt,
};
const more = { ...loopOptions, ...clothOption };

await runParts('multigrid', 'what coarser levels save', parts, { more });
