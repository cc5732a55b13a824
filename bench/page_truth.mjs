// ./pleat bench page_truth (--help tells the options)
// Truth of the page: whether it raises alarms over cloth that a visitor pulls, and whether what it
// shows first is what somebody would take. It runs the page's WebAssembly.
import { runParts } from './parts/bench-parts.mjs';
import { pulls, sweep } from './parts/page-truth-pulls.mjs';
import { sweep } from './parts/page-truth-sweep.mjs';

const purpose = 'whether what the page says of the cloth is true';
await runParts('page_truth', purpose, { pulls, sweep }, { isScaled: false });
