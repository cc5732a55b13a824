// ./pleat bench contact (--help tells the options)
// Whether cloth passes through itself, what the guard against that takes from its motion, and what
// it costs.
import { runParts } from './parts/bench-parts.mjs';
import { bodies } from './parts/contact-bodies.mjs';
import { absent, cost } from './parts/contact-cost.mjs';
import { crossings } from './parts/contact-crossings.mjs';
import { rest } from './parts/contact-rest.mjs';

const parts = { crossings, rest, cost, absent, bodies };
await runParts('contact', 'whether cloth passes through itself, and what a guard costs', parts);
