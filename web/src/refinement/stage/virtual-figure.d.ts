declare module 'virtual:pleat-figure' {
  /** The body as the view starts with it, a SolidsAnswer (build-steps/first-figure.ts). */
  const body: unknown;
  export default body;
}
