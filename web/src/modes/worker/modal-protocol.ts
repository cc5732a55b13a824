// Messages between the page and the worker that finds modes and in-betweens. Lengths in metres.
import type { Refusal } from '../../shared/bindings/refusals';
import type {
  CompletionAnswer,
  Energy,
  FilledFrame,
  ModesAnswer,
  SurfaceAnswer,
  VolumeWish,
} from '../bindings/modal-module';

/** Text that a surface is made from; `text` is of the box, of the OBJ file or of the scene. */
export type Opened =
  | { kind: 'box'; text: string }
  | { kind: 'obj'; text: string }
  /** A cloth with frames is draped: so many are kept, one for `stepsEach` steps, and it comes to rest. */
  | { kind: 'scene'; text: string; frames: number; stepsEach: number };

export type ToModal =
  | { type: 'open'; fabricsText: string; opened: Opened }
  | { type: 'modes'; energy: Energy; wish: VolumeWish }
  /** Other keys, one after the other, and so many frames between them. */
  | { type: 'complete'; keys: Float64Array; nKeys: number; wish: VolumeWish; frames: number }
  /** Another shape for one of them. */
  | { type: 'replace'; index: number; positions: Float64Array; frames: number }
  /** A key shape of the present surface, from a file in metres. */
  | { type: 'key'; text: string }
  /** How much of the drape is in the cloth's own modes. */
  | { type: 'drapeShares'; drape: Float64Array; count: number };

export interface OpenedMessage {
  type: 'opened';
  answer: SurfaceAnswer;
  triangles: Uint32Array;
  /** The shape that modes are about. */
  shape: Float64Array;
  /** Frames of the drape, one after the other; empty without. */
  drape: Float64Array;
}

export interface ModesMessage {
  type: 'modes';
  energy: Energy;
  answer: ModesAnswer;
  /** One after the other; the farthest vertex moves by 1. */
  moves: Float32Array;
}

export interface CompletedMessage {
  type: 'completed';
  answer: CompletionAnswer;
  frames: FilledFrame[];
  /** Surfaces of the frames, one after the other. */
  filled: Float32Array;
  /** Null where the surface falls into parts. */
  shares: number[] | null;
}

export interface KeyMessage {
  type: 'key';
  positions: Float64Array;
}

export interface SharesMessage {
  type: 'shares';
  shares: number[];
}

export type FromModal =
  | OpenedMessage
  | ModesMessage
  | CompletedMessage
  | KeyMessage
  | SharesMessage
  | Refusal;

/** The answer to each question. */
export interface ModalAnswers {
  open: OpenedMessage;
  modes: ModesMessage;
  complete: CompletedMessage;
  replace: CompletedMessage;
  key: KeyMessage;
  drapeShares: SharesMessage;
}
