// The WebAssembly module as it was built.
import { existsSync, readFileSync } from 'node:fs';
import type { DeformModule } from '../../src/fabrics/bindings/deform-module';
import type { ModalModule } from '../../src/modes/bindings/modal-module';
import type { ConvergenceModule } from '../../src/motion/bindings/convergence-module';
import type { SweepModule } from '../../src/motion/bindings/sweep-module';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';

export type BuiltModule = PleatModule &
  SweepModule &
  ConvergenceModule &
  DeformModule &
  RefinementModule &
  ModalModule;

const fileOf = (name: string) => new URL(`../../src/wasm/${name}`, import.meta.url);

export async function loadModule(): Promise<BuiltModule> {
  if (!existsSync(fileOf('pleat.wasm')))
    throw new Error('The WebAssembly module is not built: ./pleat test and ./pleat demo do.');
  const { default: create } = await import(/* @vite-ignore */ fileOf('pleat.mjs').href);
  const parts = ['pleat.wasm', 'pleat-rest.wasm'].map((name) => readFileSync(fileOf(name)));
  return create({ parts: await Promise.all(parts.map((bytes) => WebAssembly.compile(bytes))) });
}
