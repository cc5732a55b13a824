import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import { compactJson } from './build-steps/compact-json.ts';
import { compactShaders } from './build-steps/compact-shaders.ts';
import { firstBody } from './build-steps/first-body.ts';
import { firstLoadBudget } from './build-steps/first-load-budget.ts';
import { offlineCopy } from './build-steps/offline-copy.ts';
import { stepperRows } from './build-steps/stepper-rows.ts';

const repository = fileURLToPath(new URL('..', import.meta.url));

/** Files of the state that a first load takes. */
const FIRST_STATE =
  /src\/(motion|shared)\/(state|steppers)\/(?!sweep-cost|obj-file|convergence)|pleat-steppers/;

/** Six characters tell the few versions of a file apart, and pack better than eight. */
const NAMES = {
  assetFileNames: 'assets/[name]-[hash:6][extname]',
  chunkFileNames: 'assets/[name]-[hash:6].js',
  entryFileNames: 'assets/[name]-[hash:6].js',
};

export default defineConfig({
  base: './', // any static folder will do
  plugins: [
    compactJson(),
    compactShaders(),
    stepperRows(),
    firstBody(),
    offlineCopy(),
    firstLoadBudget(),
  ],
  server: { fs: { allow: [repository] } }, // fabrics and scenes lie in assets/
  worker: { format: 'es', rolldownOptions: { output: NAMES } },
  build: {
    target: 'es2022',
    // Imports of a later part are mostly here already: a list of them would weigh more than it gains.
    modulePreload: { polyfill: false, resolveDependencies: () => [] },
    assetsInlineLimit: 0, // the content policy allows no data: but images
    chunkSizeWarningLimit: 800, // three.js; the budget is what counts
    // Else the text of the fabric file is copied into each place that sends it to a worker.
    rolldownOptions: {
      optimization: { inlineConst: false },
      output: {
        ...NAMES,
        // One file holds what the first load shares with later parts: it packs better than four.
        advancedChunks: { groups: [{ name: 'state', test: FIRST_STATE }] },
      },
    },
  },
});
