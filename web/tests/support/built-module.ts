// The WebAssembly modules as they were built.
import { existsSync, readFileSync } from 'node:fs';
import type { DeformModule } from '../../src/fabrics/bindings/deform-module';
import type { ModalModule } from '../../src/modes/bindings/modal-module';
import type { ConvergenceModule } from '../../src/motion/bindings/convergence-module';
import type { SweepModule } from '../../src/motion/bindings/sweep-module';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';

interface Modules {
  pleat: PleatModule;
  sweep: SweepModule;
  convergence: ConvergenceModule;
  deform: DeformModule;
  refinement: RefinementModule;
  modal: ModalModule;
}

const fileOf = (name: string) => new URL(`../../src/wasm/${name}`, import.meta.url);

export async function loadModule<Name extends keyof Modules>(name: Name): Promise<Modules[Name]> {
  if (!existsSync(fileOf(`${name}.wasm`)))
    throw new Error(
      `The WebAssembly module "${name}" is not built: ./pleat test and ./pleat demo do.`,
    );
  const { default: create } = await import(/* @vite-ignore */ fileOf(`${name}.mjs`).href);
  return create({ wasmBinary: readFileSync(fileOf(`${name}.wasm`)) });
}
