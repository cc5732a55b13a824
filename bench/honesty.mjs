// ./pleat bench honesty (--help tells the options)
// Results of the program as it tells them, held against what they are.
import { runParts } from './parts/bench-parts.mjs';
import { advice } from './parts/honesty-advice.mjs';
import { dress } from './parts/honesty-dress.mjs';
import { order } from './parts/honesty-order.mjs';
import { page } from './parts/honesty-page.mjs';
import { warnings } from './parts/honesty-warnings.mjs';

const parts = { order, page, dress, warnings, advice };
await runParts('honesty', 'what the program says of its results, and the goals', parts);
