// Fabrics that are shown side by side, and changes of that list.

import { fabricNamed } from '../../shared/fabric/fabric-data';
import type { FitAnswer, TermNumbers } from '../bindings/deform-module';
import type { FabricChoice } from './deform-state';
import { geometryOf } from './fabric-geometry';

/** So many panes fit beside each other. */
export const MOST_COMPARED = 4;

export const OWN_TITLE = 'your fabric';

/** Ratios beyond this are refused, as a measurement in another unit is likely. */
export const LARGEST_RATIO = 10;

/** The shown fabrics in the order of their panes, and the pane whose numbers are read. */
export interface Comparison {
  fabrics: FabricChoice[];
  chosen: number;
}

export function titleOf(choice: FabricChoice): string {
  return choice.kind === 'named' ? choice.name : OWN_TITLE;
}

/** There is one own fabric, whatever its measures. */
export function isSame(a: FabricChoice, b: FabricChoice): boolean {
  return titleOf(a) === titleOf(b);
}

/** Null for an own fabric that was not fitted. */
export function weightsOf(
  choice: FabricChoice,
  from: 'recomputed' | 'published',
  own: FitAnswer | null,
): TermNumbers | null {
  if (choice.kind === 'own') return own?.weights ?? null;
  return geometryOf(fabricNamed(choice.name))[from];
}

/** The chosen pane shows that fabric; a pane that shows it already is chosen instead. */
export function withShown({ fabrics, chosen }: Comparison, choice: FabricChoice): Comparison {
  const shown = fabrics.findIndex((one) => isSame(one, choice));
  const changed = shown < 0 ? chosen : shown;
  return { fabrics: fabrics.with(changed, choice), chosen: changed };
}

/** Adds a pane, or closes the one that shows that fabric; or one sentence why not. */
export function withToggled(
  { fabrics, chosen }: Comparison,
  choice: FabricChoice,
): Comparison | string {
  const shown = fabrics.findIndex((one) => isSame(one, choice));
  if (shown < 0) {
    return fabrics.length < MOST_COMPARED
      ? { fabrics: [...fabrics, choice], chosen: fabrics.length }
      : `${MOST_COMPARED} fabrics at most stand side by side: take one away first.`;
  }
  if (fabrics.length === 1) return 'One fabric stays: add another before taking this one away.';
  const isBefore = shown < chosen || chosen === fabrics.length - 1;
  return {
    fabrics: fabrics.toSpliced(shown, 1),
    chosen: isBefore ? Math.max(0, chosen - 1) : chosen,
  };
}
