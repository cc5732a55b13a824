declare module '*/deform.mjs' {
  import type { DeformModule } from './deform-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createDeform: (options?: { wasmBinary?: Uint8Array }) => Promise<DeformModule>;
  export default createDeform;
}
