// What the page asks of each of its views.

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
