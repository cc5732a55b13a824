declare module 'virtual:pleat-body' {
  /** The body as the view starts with it, a SolidsAnswer (build-steps/first-body.ts). */
  const body: unknown;
  export default body;
}
