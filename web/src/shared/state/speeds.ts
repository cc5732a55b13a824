// The speeds that a view offers: simulated or shown seconds a second of the clock.
export const SPEEDS: readonly number[] = [1, 0.5, 0.25];
