declare module '*/sweep.mjs' {
  import type { SweepModule } from './sweep-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createSweep: (options?: { wasmBinary?: Uint8Array }) => Promise<SweepModule>;
  export default createSweep;
}
