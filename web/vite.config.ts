import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { compactJson } from './build-steps/compact-json.ts';
import { compactShaders } from './build-steps/compact-shaders.ts';
import { firstFigure } from './build-steps/first-figure.ts';
import { firstLoadBudget } from './build-steps/first-load-budget.ts';
import { offlineCopy } from './build-steps/offline-copy.ts';
import { stepperRows } from './build-steps/stepper-rows.ts';

const repository = fileURLToPath(new URL('..', import.meta.url));

export default defineConfig({
  base: './', // any static folder will do
  plugins: [
    compactJson(),
    compactShaders(),
    stepperRows(),
    firstFigure(),
    offlineCopy(),
    firstLoadBudget(),
  ],
  server: { fs: { allow: [repository] } }, // fabrics and scenes lie in assets/
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    modulePreload: { polyfill: false }, // a browser without it fetches modules a little later
    assetsInlineLimit: 0, // the content policy allows no data: but images
    chunkSizeWarningLimit: 800, // three.js; the budget is what counts
    // Else the text of the fabric file is copied into each place that sends it to a worker.
    rolldownOptions: { optimization: { inlineConst: false } },
  },
});
