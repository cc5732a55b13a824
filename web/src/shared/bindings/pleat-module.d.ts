declare module '*/pleat.mjs' {
  import type { PleatModule } from './wasm-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createPleat: (options?: { wasmBinary?: Uint8Array }) => Promise<PleatModule>;
  export default createPleat;
}

declare module '*/sweep.mjs' {
  import type { SweepModule } from './wasm-module';

  const createSweep: (options?: { wasmBinary?: Uint8Array }) => Promise<SweepModule>;
  export default createSweep;
}

declare module '*/deform.mjs' {
  import type { DeformModule } from './wasm-module';

  const createDeform: (options?: { wasmBinary?: Uint8Array }) => Promise<DeformModule>;
  export default createDeform;
}

declare module '*/refinement.mjs' {
  import type { RefinementModule } from '../../refinement/bindings/refinement-module';

  const createRefinement: (options?: { wasmBinary?: Uint8Array }) => Promise<RefinementModule>;
  export default createRefinement;
}
