// Messages between the page and the worker that finds the shapes of fabrics. Lengths in metres.

import type { Refusal } from '../../shared/bindings/refusals';
import type { StartShape } from '../../shared/page/view';
import type { Done } from '../../shared/workers/asked';
import type { ClothAnswer, DeformReport, FitAnswer, TermNumbers } from '../bindings/deform-module';
import type { EnergyForm, PaneState } from '../state/deform-state';

export interface ShowMessage {
  type: 'show';
  form: EnergyForm;
  /** One pane for each. */
  weights: TermNumbers[];
}

export type ToDeform =
  /** Another cloth, with nothing held and no panes. `cloth` marks what comes of it. */
  | { type: 'open'; cloth: number; fabricsText: string; sceneText: string; objText: string }
  | ShowMessage
  /** Vertices, ascending, and their places. */
  | { type: 'hold'; vertices: Int32Array; places: Float64Array }
  /** A hand goes on moving: panes follow as far as that is quick. */
  | { type: 'move'; places: Float64Array }
  /** The hand rests: the exact shapes are found; those from rest are tried once it has let go. */
  | { type: 'rest'; isHeld: boolean }
  /** A frame's buffer comes back. */
  | { type: 'return'; cloth: number; pane: number; buffer: ArrayBuffer }
  | { type: 'fit'; measures: TermNumbers }
  /** Asks for what a cloth in motion starts from. */
  | { type: 'section'; pane: number };

export interface DeformFrame {
  type: 'frame';
  cloth: number;
  pane: number;
  /** Laid out as any frame (frame.ts), without a scalar. To be given back. */
  buffer: ArrayBuffer;
  status: PaneState['status'];
  report: DeformReport;
  /** Time of the work since something was last moved or weighted otherwise [ms]. */
  updateMs: number;
}

export interface OpenedMessage {
  type: 'opened';
  cloth: number;
  answer: ClothAnswer;
  triangles: Uint32Array;
}

/** The shown fabrics, or the holds, are as they were asked for. */
export interface GrantedMessage {
  type: 'granted';
  what: 'show' | 'hold';
}

export interface FittedMessage {
  type: 'fitted';
  measures: TermNumbers;
  answer: FitAnswer;
}

/** The section "cloth" of a scene, and the places from which a pane's shape starts. */
export interface SectionMessage extends Omit<StartShape, 'name'> {
  type: 'section';
}

export type FromDeform =
  | OpenedMessage
  | GrantedMessage
  | Refusal
  | DeformFrame
  | FittedMessage
  | SectionMessage;

/** The answer to each message that is a question. Frames are news. */
export interface DeformAnswers {
  open: OpenedMessage;
  show: GrantedMessage;
  hold: GrantedMessage;
  fit: FittedMessage;
  section: SectionMessage;
  move: Done;
  rest: Done;
  return: Done;
}
