// The coarser levels that are drawn over the cloth: which stepper's they are, and how it makes them.
import type { LevelSelection } from '../../shared/bindings/pleat-module';
import { STEPPERS, stepperRow } from '../../shared/steppers/steppers';
import { detailOf, type Setting } from './setting';

/** Most levels that a link may ask for: no mesh of ours has more. */
export const MOST_COARSE = 30;

/** Steppers that make levels of a mesh. */
export const LEVEL_MAKERS: readonly string[] = STEPPERS.filter(
  ({ details }) => 'levels' in details,
).map(({ name }) => name);

/** How levels are made of a mesh. */
export interface LevelWish {
  selection: LevelSelection;
  nCoarser: number;
  /** Share of a level's vertices that the next one keeps; of no meaning to thinned ones. */
  ratio: number;
}

/** The stepper whose levels are shown: its own where it has any, else the one that was chosen. */
export function makerOf({ stepper }: Pick<Setting, 'stepper'>, chosen: string): string {
  return LEVEL_MAKERS.includes(stepper) ? stepper : chosen;
}

/** The levels that the maker has with this setting, or usually. */
export function levelWish(setting: Setting, chosen: string): LevelWish {
  const maker = makerOf(setting, chosen);
  const { details: starts } = stepperRow(maker);
  const own = setting.stepper === maker ? setting : { stepper: maker };
  const numberOf = (key: string) => Number(detailOf(own, key) ?? 0.5);
  return {
    // Who does not choose how many vertices a level keeps, thins.
    selection: 'ratio' in starts ? 'quadrics' : 'thinned',
    nCoarser: numberOf('levels') || Number(starts.levels),
    ratio: numberOf('ratio'),
  };
}
