declare module 'virtual:pleat-steppers' {
  /** The core's table of steppers (build-steps/stepper-rows.ts). */
  const rows: readonly unknown[];
  export default rows;
  /** Keys and values of what its rows have as details. */
  export const details: readonly unknown[];
}

declare module 'virtual:pleat-details' {
  /** Details with what people are told of them. */
  const details: readonly unknown[];
  export default details;
}
