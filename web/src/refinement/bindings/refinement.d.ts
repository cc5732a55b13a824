declare module '*/refinement.mjs' {
  import type { RefinementModule } from './refinement-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createRefinement: (options?: { wasmBinary?: Uint8Array }) => Promise<RefinementModule>;
  export default createRefinement;
}
