// ./pleat bench honesty (--help tells the options)
// What the program says of its own results, held against what they are.
import { runParts } from './parts/bench-parts.mjs';
import { dress } from './parts/honesty-dress.mjs';
import { order } from './parts/honesty-order.mjs';
import { page } from './parts/honesty-page.mjs';
import { warnings } from './parts/honesty-warnings.mjs';

await runParts('honesty', 'what the program says of its results, and the goals it has to meet', {
  order,
  page,
  dress,
  warnings,
});
