// ./pleat bench page_truth (--help tells the options)
// Truth of the page: whether it raises alarms over cloth that a visitor pulls, and whether stiff fabrics look
// stiff. It runs the page's WebAssembly.
import { runParts } from './parts/bench-parts.mjs';
import { pulls } from './parts/page-truth-pulls.mjs';
import { strips } from './parts/page-truth-strips.mjs';

const purpose = 'whether what the page says of the cloth is true';
await runParts('page_truth', purpose, { pulls, strips }, { isScaled: false });
