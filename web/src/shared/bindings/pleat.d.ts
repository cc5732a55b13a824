declare module '*/pleat.mjs' {
  interface Options {
    /** The file's bytes, for Node. */
    wasmBinary?: Uint8Array;
    /** Instantiates a module that is compiled already, and hands the instance over. */
    instantiateWasm?(
      imports: WebAssembly.Imports,
      receive: (instance: WebAssembly.Instance) => void,
    ): object;
  }

  /** The core, or the part of its classes that the caller names. */
  const createPleat: <Part>(options: Options) => Promise<Part>;
  export default createPleat;
}
