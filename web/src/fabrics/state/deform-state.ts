// State of the view "Fabrics". Only this and the frames travel between its parts.

import type { Failure } from '../../shared/bindings/answers';
import type { DeformReport, FitAnswer, TermNumbers } from '../bindings/deform-module';
import type { EdgeReach } from './edge-reach';
import type { FabricOrder } from './fabric-order';

export type EnergyForm = 'consistent' | 'published';
export const TERMS = ['recovery', 'stretch', 'bending'] as const;
export type Term = (typeof TERMS)[number];

/** A fabric of the library, or the visitor's own measurements. */
export type FabricChoice = { kind: 'named'; name: string } | { kind: 'own'; measures: TermNumbers };

/** One pane: one fabric's shape under the common hold. */
export interface PaneState {
  fabric: FabricChoice;
  weights: TermNumbers;
  energy: number;
  terms: TermNumbers;
  steps: DeformReport['steps'];
  status: 'dragging' | 'settling' | 'converged' | 'not_converged';
  /** Time of the last update [ms]. */
  updateMs: number;
  /** How far its edges are stretched and pushed together, and what of that cloth bears; null until the shape is found. */
  reach: EdgeReach | null;
}

export interface NamedHold {
  name: string;
  vertices: number[];
}

export interface DeformState {
  /** Name of a file of assets/deform, or 'own' for the visitor's OBJ. */
  experiment: string;
  panes: PaneState[]; // 1 to 4, or 15 in the gallery
  gallery: boolean;
  /** Order of the list, and of the panes when all fabrics are shown. */
  order: FabricOrder;
  form: EnergyForm;
  terms: Record<Term, boolean>;
  weightsFrom: 'recomputed' | 'published';
  pins: NamedHold[];
  handles: NamedHold[];
  /** Pane whose card and energy curve are shown. */
  chosen: number;
  problem: Failure | null;
  ownFabric: FitAnswer | null;
}
