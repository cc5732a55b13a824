// ./pleat bench page_truth (--help tells the options)
// What the page shows and says of cloth that a visitor pulls, on the WebAssembly that it runs.
import { runParts } from './parts/bench-parts.mjs';
import { pulls } from './parts/page-truth-pulls.mjs';

const purpose = 'whether what the page says of the cloth is true';
await runParts('page_truth', purpose, { pulls }, { isScaled: false });
