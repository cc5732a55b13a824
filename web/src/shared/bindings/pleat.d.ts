declare module '*/pleat.mjs' {
  interface Options {
    /** The part for a first visit, compiled, and the rest where that is wanted. */
    parts: WebAssembly.Module[];
  }

  /** The core, or the part of its classes that the caller names. */
  const createPleat: <Part>(options: Options) => Promise<Part>;
  export default createPleat;
}
