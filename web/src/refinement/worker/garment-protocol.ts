// Messages between the page and the workers of garments: one for each pane, and one for the example.
// Lengths in metres, times in seconds.
import type { Refusal } from '../../shared/bindings/refusals';
import type { RunWarning } from '../../shared/bindings/run-warning';
import type { Done } from '../../shared/workers/asked';
import type {
  ComparedAnswer,
  FaultsAnswer,
  GarmentCosts,
  GarmentSummary,
  HandedFiles,
  SolidsAnswer,
} from '../bindings/refinement-module';
import type { Fit } from '../state/fit';
import type { PlanFile } from '../state/plan-file';
import type { RecordingHead } from './recording';

/** Numbers at the vertices by which a frame can be coloured. */
export type GarmentScalar = 'curvature' | 'distance';

/** How a pane comes to its next frame: from its record, by the steps of a frame, or it stays. */
export type Advance = 'recorded' | 'stepped' | 'still';

export type ToGarment =
  | {
      type: 'load';
      fabricsText: string;
      sceneText: string;
      /** A scene of the fine mesh that frames are held against. */
      fineText: string;
      files: HandedFiles;
      /** The file of a record of this scene. */
      recording: ArrayBuffer | null;
      /** Time of a frame. */
      frameS: number;
      /** Time from which on folds count. */
      settledS: number;
    }
  /** A recorded frame can be any one: those before it count for the fit as well. */
  | { type: 'advance'; frame: number; how: Advance }
  | { type: 'reset' }
  | {
      type: 'describe';
      scalar: GarmentScalar | null;
      /** The fine pane's places at the same time, if they are there. */
      reference: Float32Array | null;
      /** The fine pane's folds, if they are to be compared. */
      fineFolds: Float64Array | null;
      /** Shows the reference as this mesh could show it, in place of a frame of its own. */
      takesSample: boolean;
      timeS: number;
      /** Also faults, and the distance between surfaces, which takes longer than a frame. */
      wantsFaults: boolean;
      wantsSurface: boolean;
      /** An earlier frame's, to be filled. */
      buffer: ArrayBuffer | null;
    };

export interface GarmentMesh {
  triangles: Uint32Array;
  /** The face that each triangle is of. */
  triangleFaces: Uint32Array;
  edges: Uint32Array;
  hanging: Uint32Array;
  faces: Int32Array;
  parents: Int32Array;
}

export interface Described {
  type: 'described';
  /** Laid out as any frame is (frame.ts); its scalar is NaN where it is unknown. */
  buffer: ArrayBuffer;
  /** Distances from the reference, and RMS between the surfaces. */
  compared: ComparedAnswer | null;
  surfaceM: number | null;
  /** How far folds stand out, over all that were seen; null until that is enough to tell. */
  folds: Float64Array | null;
  /** How differently they are folded from the fine pane. */
  foldsM: number | null;
  faults: FaultsAnswer | null;
  costs: GarmentCosts | null;
  /** Signs in the steps of this pane that its scene cannot explain. */
  warnings: RunWarning[];
  solids: SolidsAnswer | null;
}

export interface Loaded {
  type: 'loaded';
  summary: GarmentSummary;
  mesh: GarmentMesh;
  /** Head of the record; null when there is none, or one of another mesh. */
  recording: RecordingHead | null;
}

export interface Advanced {
  type: 'advanced';
  fit: Fit | null;
  /** Why the run ended, or null. */
  ended: string | null;
}

export type FromGarment = Loaded | Advanced | Described | Refusal;

/** The answer to each question. */
export interface GarmentAnswers {
  load: Loaded;
  advance: Advanced;
  reset: Done;
  describe: Described;
}

/** The one number by which a plan is asked for. */
export type PlanWish = { largest_loss_m: number } | { max_vertices: number };

/** An example: its scene on the fine mesh, and what plans are to make of it. */
export interface ExampleScene {
  fabricsText: string;
  sceneText: string;
  files: HandedFiles;
  name: string;
  nPatterns: number;
}

export type ToExample =
  | (ExampleScene & {
      type: 'open';
      /** The files of the features and of the frames that limits are taken from. */
      features: ArrayBuffer;
      frames: ArrayBuffer;
    })
  | (ExampleScene & {
      /** An example more, from its beginning. */
      type: 'begin';
      /** Time of a frame, of the last one before those that count, and of the last one. */
      frameS: number;
      fromS: number;
      toS: number;
      /** One in so many of the frames that count is kept for limits. */
      keptOf: number;
    })
  /** A frame of it. */
  | { type: 'goOn' }
  | { type: 'plan'; wish: PlanWish };

/** The share of the example that has run; at 1 plans are made of it too. */
export interface WentOn {
  type: 'wentOn';
  share: number;
}

export interface Planned {
  type: 'planned';
  plan: PlanFile;
}

export type FromExample = WentOn | Planned | Refusal;

/** The answer to each question. */
export interface ExampleAnswers {
  open: Done;
  begin: WentOn;
  goOn: WentOn;
  plan: Planned;
}
