// ./pleat bench multigrid (--help tells the options)
// What coarser levels save where cloth has many vertices.
import { runParts } from './parts/bench-parts.mjs';
import { clothOption, preconditioner } from './parts/multigrid-preconditioner.mjs';

await runParts(
  'multigrid',
  'what coarser levels save where cloth has many vertices',
  { preconditioner },
  [clothOption],
);
