declare module '*/pleat.mjs' {
  import type { PleatModule } from './pleat-module';

  /** `wasmBinary` lets Node pass the file's bytes; a browser fetches them itself. */
  const createPleat: (options?: { wasmBinary?: Uint8Array }) => Promise<PleatModule>;
  export default createPleat;
}
