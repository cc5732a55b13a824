// ./pleat bench same_cloth (--help tells the options)
// Whether every stepper comes to the same cloth: scenes whose outcome is known, with each at its
// defaults. A row is right, or the run warns of it, or it is wrong without a word.
import { runParts } from './parts/bench-parts.mjs';
import { markdown } from './parts/bench-rows.mjs';
import { beads, largeSheets, sheets } from './parts/same-cloth-ball.mjs';
import { checkCosts } from './parts/same-cloth-check.mjs';
import { groupGoals, overallGoals } from './parts/same-cloth-goals.mjs';
import { fineSheets } from './parts/same-cloth-large.mjs';
import { grips, inclines, slides, terminals } from './parts/same-cloth-motion.mjs';
import { cantilevers, curtains, flags, sags } from './parts/same-cloth-rest.mjs';
import {
  counts,
  explicitOnes,
  reasons,
  runCases,
  steppers,
  verdictTable,
} from './parts/same-cloth-runs.mjs';
import { fineSwatches, slivers, swatchRows } from './parts/same-cloth-swatch.mjs';

/** How many rows of each stepper are right. */
function countTable(rows, names) {
  const columns = ['stepper', 'right', 'warned', 'WRONG', 'absent', 'share right', 's'];
  const lines = names.map((stepper) => Object.values(counts(rows, stepper)));
  return markdown(columns, lines);
}

/** Table of a group, how many of its rows are right with each stepper, and its goals. */
function found(group, rows, names) {
  const absent = reasons(rows);
  const texts = [verdictTable(rows, names), countTable(rows, names), absent];
  return {
    rows: rows.map((row) => ({ group, ...row })),
    goals: groupGoals(group, rows),
    text: texts.filter(Boolean).join('\n\n'),
  };
}

const groupOf = (group, casesOf) => () => {
  const names = steppers();
  return found(group, runCases(casesOf(), names), names);
};

function swatch() {
  const names = steppers();
  return found('swatch', [...swatchRows(names), ...runCases(fineSwatches(), names)], names);
}

const parts = {
  cantilever: groupOf('cantilever', cantilevers),
  sag: groupOf('sag', sags),
  curtain: groupOf('curtain', curtains),
  terminal: groupOf('terminal', terminals),
  flag: groupOf('flag', flags),
  incline: groupOf('incline', inclines),
  slide: groupOf('slide', slides),
  grip: groupOf('grip', grips),
  slivers: groupOf('slivers', slivers),
  swatch,
  bead: groupOf('bead', beads),
  ball: groupOf('ball', sheets),
  large_ball: groupOf('large_ball', largeSheets),
  large: fineSheets,
  check_cost: () => checkCosts(steppers().filter((name) => !explicitOnes.includes(name))),
};

/** All groups that were run: counts of each stepper, and goals. */
function overall(all) {
  const rows = all.filter(({ group }) => group);
  if (rows.length === 0) return null;
  const names = [...new Set(rows.map(({ stepper }) => stepper))];
  return { text: `all groups:\n\n${countTable(rows, names)}`, goals: overallGoals(rows) };
}

const purpose = 'whether every stepper comes to the same cloth, or says that it does not';
await runParts('same_cloth', purpose, parts, { isScaled: false, overall });
