declare module '*/convergence.mjs' {
  import type { ConvergenceModule } from './convergence-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createConvergence: (options?: { wasmBinary?: Uint8Array }) => Promise<ConvergenceModule>;
  export default createConvergence;
}
