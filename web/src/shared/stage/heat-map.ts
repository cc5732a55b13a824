// The numbers that the colours of a cloth show.

/** Nothing, stretch, stretch with its sign, or distance to the reference. */
export type HeatMap = 'off' | 'magnitude' | 'signed' | 'distance';

/** The heat map's scale and what the frame holds: ratios or metres; NaN where there is no number. */
export interface HeatScale {
  map: HeatMap;
  low: number;
  high: number;
  least: number;
  most: number;
}
