declare module 'virtual:pleat-figure' {
  /** The figure as the view starts with it, a SolidsAnswer (build-steps/first-figure.ts). */
  const figure: unknown;
  export default figure;
}
