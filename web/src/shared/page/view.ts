// The interface of the page's views, and the shape that one view hands to another.

export interface View {
  /** The part of the address after `#` at which this view is as it is. */
  link(): string;
  /** Shows what a link stands for. */
  open(hash: string): void;
  /** One that is hidden rests and leaves the address alone. */
  setShown(isShown: boolean): void;
  /** State and frame to look at, for the console and for tests. */
  probe: object;
}

/** The cloth and the places that a motion starts from. */
export interface StartShape {
  /** Words on what it is. */
  name: string;
  /** The section "cloth" of a scene; what was held is its group "held". */
  section: object;
  positions: Float64Array;
}
