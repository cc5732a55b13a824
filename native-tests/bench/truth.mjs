// ./pleat bench truth (--help tells the options)
// What the program says of its own results, held against what they are.
import { runParts } from './parts/bench-parts.mjs';
import { dress } from './parts/truth-dress.mjs';
import { order } from './parts/truth-order.mjs';
import { page } from './parts/truth-page.mjs';
import { warnings } from './parts/truth-warnings.mjs';

await runParts('truth', 'what the program says of its results, and the goals it has to meet', {
  order,
  page,
  dress,
  warnings,
});
