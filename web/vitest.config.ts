import { defineConfig } from 'vitest/config';
import { stepperRows } from './build-steps/stepper-rows.ts';

export default defineConfig({
  plugins: [stepperRows()],
  test: { environment: 'node', include: ['tests/**/*.test.{ts,mjs}'] },
});
