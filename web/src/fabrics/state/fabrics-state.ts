// The whole state of the view of fabrics: what its panel shows, and what only its stage needs.
import { type Failure, inputFailure } from '../../shared/bindings/answers';
import type { Triple } from '../../shared/bindings/geometry';
import { type FabricRecord, fabricNamed } from '../../shared/fabric/fabric-data';
import type { ObjUnit } from '../../shared/state/obj-file';
import type { ClothAnswer, FitAnswer, TermNumbers } from '../bindings/deform-module';
import type { DeformState, FabricChoice, PaneState } from './deform-state';
import { weightsOf } from './fabric-choice';
import { geometryOf, perTerm } from './fabric-geometry';
import { orderedFabrics } from './fabric-order';
import type { Hold } from './holds';

/** Effect of a press on the cloth: a hand takes it, or a pin goes in or out. */
export type Tool = 'pull' | 'pin';

export interface FabricsState extends DeformState {
  /** `broken`: nothing can be computed here. */
  phase: 'loading' | 'ready' | 'broken';
  /** Pins and handles, in the order in which they came: which has a vertex first, keeps it. */
  holds: readonly Hold[];
  /** The experiment's holds, before a visitor changed them. */
  ownHolds: Hold[];
  /** The fabrics that are shown when it is not all of them: one to four. */
  compared: FabricChoice[];
  cloth: ClothAnswer | null;
  /** The visitor's mesh, once there is one. */
  objName: string | null;
  objUnit: ObjUnit;
  /** Words on what is odd about its size. */
  objOdd: string | null;
  /** Name of the visitor's file that is being read. */
  reading: string | null;
  tool: Tool;
  /** Name of the hold that keys move. */
  chosenHold: string | null;
  isDragging: boolean;
  invited: boolean;
  edges: boolean;
}

/** How far a hold was moved: one of the experiment by its name, or a visitor's own by its vertex. */
export interface LinkedHold {
  by: string | { kind: Hold['kind']; vertex: number };
  offset: Triple;
}

export interface FabricsLink
  extends Pick<
    FabricsState,
    | 'experiment'
    | 'gallery'
    | 'order'
    | 'form'
    | 'terms'
    | 'weightsFrom'
    | 'chosen'
    | 'compared'
    | 'edges'
  > {
  moved: LinkedHold[];
  /** Names of the experiment's holds that were let go. */
  released: string[];
}

/** The part of the state that says what holds the cloth. */
export function heldBy(holds: readonly Hold[]): Pick<FabricsState, 'holds' | 'pins' | 'handles'> {
  const ofKind = (wanted: Hold['kind']) => holds.filter(({ kind }) => kind === wanted);
  return { holds, pins: ofKind('pin'), handles: ofKind('handle') };
}

/** The fabric that a choice looks like. */
export function recordOf(choice: FabricChoice, own: FitAnswer | null): FabricRecord {
  return fabricNamed(choice.kind === 'named' ? choice.name : (own?.nearest ?? ''));
}

/** The weights that enter the energy: those of terms that are switched off are zero. */
export function countedWeights({ weights }: PaneState, terms: DeformState['terms']): TermNumbers {
  return perTerm((term) => (terms[term] ? weights[term] : 0));
}

/** Panes for what is to be shown; a pane that is there keeps its numbers until new ones come. */
export function panesFor(
  state: Pick<
    FabricsState,
    'gallery' | 'order' | 'compared' | 'weightsFrom' | 'ownFabric' | 'panes'
  >,
): PaneState[] {
  const all = orderedFabrics(state.order).map(
    ({ name_en: name }): FabricChoice => ({ kind: 'named', name }),
  );
  const shown = state.gallery ? all : state.compared;
  return shown.map((fabric, index): PaneState => {
    const numbers = state.panes[index] ?? {
      energy: Number.NaN,
      terms: perTerm(() => Number.NaN),
      steps: [],
      updateMs: Number.NaN,
      reach: null,
    };
    // An own fabric is as its nearest until its weights are fitted.
    const weights =
      weightsOf(fabric, state.weightsFrom, state.ownFabric) ??
      geometryOf(recordOf(fabric, state.ownFabric)).recomputed;
    return { ...numbers, fabric, weights, status: 'settling', reach: null };
  });
}

/** Panes whose numbers are of what was before, until new ones come. */
export function settlingPanes(panes: readonly PaneState[]): PaneState[] {
  return panes.map((pane) => ({ ...pane, status: 'settling', reach: null }));
}

/** The failure for parts of a link that could not be followed, after what was known of it already. */
export function linkFailure(problems: readonly string[], known: Failure | null): Failure | null {
  if (problems.length === 0) return known;
  const before = known?.what ?? 'The link could not be read fully.';
  return inputFailure(`${before} ${problems.join('; ')}.`);
}

export function initialFabricsState(link: FabricsLink, problems: string[]): FabricsState {
  const start = { ...link, ownFabric: null, panes: [] };
  return {
    ...start,
    phase: 'loading',
    panes: panesFor(start),
    ...heldBy([]),
    ownHolds: [],
    cloth: null,
    objName: null,
    objUnit: 'm',
    objOdd: null,
    reading: null,
    tool: 'pull',
    chosenHold: null,
    isDragging: false,
    invited: true,
    problem: linkFailure(problems, null),
  };
}
