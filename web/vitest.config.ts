import { defineConfig } from 'vitest/config';
import { stepperRows } from './build-steps/stepper-rows.ts';

export default defineConfig({
  plugins: [stepperRows()],
  test: {
    // Tests that step a real module share the machine with compilers.
    testTimeout: 30_000,
    environment: 'node',
    include: ['tests/**/*.test.{ts,mjs}'],
  },
});
