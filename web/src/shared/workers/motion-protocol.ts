// Messages between the page and the worker of cloth in motion, both ways. Lengths in metres, times in seconds.

import type { Scalar } from '../bindings/frame';
import type { Collider } from '../bindings/geometry';
import type {
  EnergyNumbers,
  ImexShare,
  LevelSelection,
  MeshLevels,
  RunNumbers,
  SceneSummary,
  SpringSplit,
} from '../bindings/pleat-module';
import type { Refusal } from '../bindings/refusals';
import type { Done } from './asked';

export interface StepMessage {
  type: 'step';
  /** 0 to fill the buffer anew. */
  count: number;
  wantsNumbers: boolean;
  /** An account of energy is kept over these steps. */
  wantsEnergy?: boolean;
  scalar?: Scalar;
  buffer: ArrayBuffer;
}

export interface SceneToLoad {
  sceneText: string;
  /** Places where the vertices start, unless they start where they rest. */
  start?: Float64Array;
}

export interface LoadMessage extends SceneToLoad {
  type: 'load';
  keepMotion: boolean;
  scalar?: Scalar;
  /** The motion to keep is this one's end: so many steps of each scene, the first one from its start. */
  way?: readonly (SceneToLoad & { steps: number })[];
}

export interface ImplicitShareQuestion {
  type: 'readImplicitShare';
  stepS: number;
  substeps: number;
  /** Share of the springs that shall be explicit at least. */
  explicitShare: number;
}

export interface LevelsQuestion {
  type: 'readLevels';
  selection: LevelSelection;
  nCoarser: number;
  /** Share of a level's vertices that the next one keeps. */
  ratio: number;
}

export type ToMotion =
  /** First message: opens the module's objects with the fabric file's text. */
  | { type: 'open'; fabricsText: string }
  | LoadMessage
  | { type: 'reset'; scalar?: Scalar }
  /** A reference's file, for whichever scene is loaded and is what it is of. */
  | { type: 'setReference'; bytes: ArrayBuffer }
  /** The buffer is given away here and comes back filled in `frame`. */
  | StepMessage
  /** Asks for the springs that are implicit as of now. */
  | { type: 'readSprings' }
  /** How imex would take the springs of a lattice. */
  | ImplicitShareQuestion
  /** Coarser levels of the loaded mesh. */
  | LevelsQuestion
  | { type: 'grab'; vertex: number }
  | { type: 'moveGrab'; target: [number, number, number] }
  | { type: 'releaseGrab' };

export interface LoadedMessage {
  type: 'loaded';
  summary: SceneSummary;
  triangles: Uint32Array;
  /** Two frame buffers that belong to the page from now on; the first holds the present frame. */
  buffers: [ArrayBuffer, ArrayBuffer];
  scalar: Scalar;
  numbers: RunNumbers;
  colliders: Collider[];
}

/** `status` is "ok", "not_converged" (the run goes on from the best so far), or why it ended. */
export interface RunReport {
  numbers: RunNumbers;
  status: string;
  message: string;
}

/** The mesh that a tear has made. */
export interface TornMesh {
  triangles: Uint32Array;
  /** A second buffer beside the frame's own, for the frames of this mesh. */
  spare: ArrayBuffer;
}

export interface FrameMessage {
  type: 'frame';
  count: number;
  /** The one that was given, or where the cloth tore, one of another size. */
  buffer: ArrayBuffer;
  /** Null where the mesh is that of the frame before. */
  torn: TornMesh | null;
  scalar: Scalar;
  /** The run cannot go on; the buffer holds its last finite frame. */
  hasEnded: boolean;
  /** Null unless it was asked for or the run has ended. */
  report: RunReport | null;
  /** Null unless an account is kept. */
  energy: EnergyNumbers | null;
  colliders: Collider[];
}

export interface SpringsMessage extends SpringSplit {
  type: 'springs';
}

export interface ImplicitShareMessage extends ImexShare {
  type: 'implicitShare';
}

/** A mesh that has no levels has a shortage that says why. */
export interface LevelsMessage extends MeshLevels {
  type: 'levels';
}

/** A reference was taken: the numbers anew. */
export interface ReferenceSetMessage {
  type: 'referenceSet';
  numbers: RunNumbers;
}

export type FromMotion =
  | { type: 'ready' }
  | LoadedMessage
  | FrameMessage
  | SpringsMessage
  | ImplicitShareMessage
  | LevelsMessage
  | ReferenceSetMessage
  | Refusal;

/** The answer to each message that is a question; `done`: there was nothing to answer. */
export interface MotionAnswers {
  open: { type: 'ready' };
  load: LoadedMessage;
  reset: LoadedMessage;
  setReference: ReferenceSetMessage | Done;
  step: FrameMessage | Done;
  readSprings: SpringsMessage;
  readImplicitShare: ImplicitShareMessage;
  readLevels: LevelsMessage;
  grab: Done;
  moveGrab: Done;
  releaseGrab: Done;
}
