declare module 'virtual:pleat-steppers' {
  /** The core's table of steppers (build-steps/stepper-rows.ts). */
  const rows: readonly unknown[];
  export default rows;
}
