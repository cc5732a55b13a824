// What the page asks of each of its views, and what one view hands to another.

export interface View {
  /** The part of the address after `#` at which this view is as it is. */
  link(): string;
  /** Shows what a link stands for. */
  open(hash: string): void;
  /** One that is hidden rests and leaves the address alone. */
  setShown(isShown: boolean): void;
  /** For the console and for tests: state and frame to look at. */
  probe: object;
}

/** What a cloth in motion starts from. */
export interface StartShape {
  /** The section "cloth" of a scene; what was held is its group "held". */
  section: object;
  positions: Float64Array;
}
