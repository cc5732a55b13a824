// The core's table of steppers, which the page knows as a module of its own: asked of the module that
// was built for the page, so that what is said of a stepper stands in the core alone.
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const NAME = 'virtual:pleat-steppers';
const BUILT = new URL('../src/wasm/pleat.mjs', import.meta.url);

async function rows(): Promise<unknown> {
  const { default: create } = await import(BUILT.href);
  const { Scene } = await create({ wasmBinary: readFileSync(new URL('pleat.wasm', BUILT)) });
  const scene = new Scene('');
  const { steppers } = JSON.parse(scene.steppers());
  scene.delete();
  return steppers;
}

export function stepperRows(): Plugin {
  return {
    name: 'pleat-steppers',
    resolveId: (id) => (id === NAME ? `\0${NAME}` : null),
    load: async (id) =>
      id === `\0${NAME}` ? `export default ${JSON.stringify(await rows())}` : null,
  };
}
