// ./pleat bench page_truth (--help tells the options)
// Truth of the page: whether it raises alarms over cloth that a visitor pulls and over settings that
// nobody has touched, whether its remedies heal, and whether its first pictures show what they are
// to show. It runs the page's WebAssembly.
import { runParts } from './parts/bench-parts.mjs';
import { explosions } from './parts/page-truth-explosions.mjs';
import { failures } from './parts/page-truth-failures.mjs';
import { firstPictures } from './parts/page-truth-first-pictures.mjs';
import { progress } from './parts/page-truth-progress.mjs';
import { pulls } from './parts/page-truth-pulls.mjs';
import { strips } from './parts/page-truth-strips.mjs';
import { sweep } from './parts/page-truth-sweep.mjs';
import { untouched } from './parts/page-truth-untouched.mjs';

const purpose = 'whether what the page says and shows of the cloth is true';
const parts = { explosions, failures, first_pictures: firstPictures, progress, pulls, strips, sweep, untouched };
await runParts('page_truth', purpose, parts, { isScaled: false });
