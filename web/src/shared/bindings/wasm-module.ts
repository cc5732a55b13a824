// The classes bound by the WebAssembly modules, and the shape of the texts they answer with.
// Each class has a list of its methods; a test holds the lists against the real modules.

/** Every text answer: the payload beside `ok`, or one sentence about what was wrong and where. */
export type Answer<Payload> = ({ ok: true } & Payload) | Failure;

export interface Failure {
  ok: false;
  /** `input`: the scene or plan is at fault. `internal`: the program is. */
  kind: 'input' | 'internal';
  /** JSON pointer into the text that was passed, or empty. */
  where: string;
  what: string;
}

export interface SceneSummary {
  n_vertices: number;
  n_triangles: number;
  n_springs: number;
  n_bends: number;
  step_s: number;
  substeps: number;
  built: string[];
  left_out: string[];
  notes?: string[];
}

/** How the present state compares with a reference of its scene. */
export interface ReferenceNumbers {
  /** RMS by area; null beyond the reference's end, and when `disturbed`. */
  distance_m: number | null;
  /** How well the reference is known then; null when nobody knows. */
  uncertainty_m: number | null;
  end_s: number;
  description: string;
  /** A hand or another scene moved the cloth since its start. */
  disturbed: boolean;
}

export interface RunNumbers {
  time_s: number;
  step: number;
  /** Largest and root mean square of |edge strain|, as ratios. */
  largest_stretch: number;
  rms_stretch: number;
  /** Relative residual of the last step's own equations. */
  residual: number;
  iterations: number;
  /** Total wall time since load, the first step not counted: of each part that was timed [ms]. */
  parts_ms: Record<string, number>;
  /** And of the steps as a whole [ms], of which there were `steps_timed`. */
  steps_ms: number;
  steps_timed: number;
  /** Null where there is none of this scene. */
  reference: ReferenceNumbers | null;
}

export interface RunStatus {
  status: string;
  message: string;
}

export type Triple = [number, number, number];

export type Collider =
  | { shape: 'plane'; point: Triple; normal: Triple }
  | { shape: 'sphere'; centre: Triple; radius_m: number };

/** What `readObj` finds in a file. */
export interface ObjAnswer {
  /** The section "cloth" of a scene, with the mesh written out. */
  cloth: object;
  groups: string[];
  n_vertices: number;
  n_triangles: number;
  low_m: Triple;
  high_m: Triple;
  /** Some triangle has no texture coordinates. */
  needs_direction: boolean;
}

export interface BenchMethod {
  stepper: string;
  step_s: number;
  /** "stable": as many as the stability bound asks for. */
  substeps?: number | 'stable';
  iterations?: number;
  [setting: string]: unknown;
}

/** One measured setting; a number that could not be measured is null. */
export interface BenchRow {
  scene: string;
  /** What it changes in the plan's scene: values by their JSON pointers. */
  setting: Record<string, unknown>;
  method: BenchMethod;
  level: number;
  n_vertices: number;
  /** Substeps of a step, as run. */
  n_substeps: number;
  /** How often solids left a vertex no place outside of them. */
  n_unresolved_contacts: number;
  /** Timed runs, of which the times are the median. */
  n_runs: number;
  /** Wall time of 1/60 s of motion. */
  ms_per_frame: number | null;
  ms_per_simulated_second: number | null;
  /** Slowest minus quickest run, of `ms_per_frame`. */
  spread_ms: number | null;
  position_error_m: number | null;
  /** Of the rest diagonal. */
  position_error_percent: number | null;
  rms_stretch: number | null;
  largest_stretch: number | null;
  reference: { id: string; converged: boolean; description: string };
  /** "ok", "not_converged" (it ran to its end), or why it failed. */
  status: string;
  message: string;
  target: 'wasm' | 'native';
  [detail: string]: unknown;
}

export interface SweepReport {
  done: boolean;
  /** 0 to 1. */
  progress: number;
  rows: BenchRow[];
  /** Indices into `rows`. */
  front: number[];
  message: string;
}

export interface SceneHandle {
  fabrics(): string;
  schema(): string;
  parse(sceneText: string): string;
  /** The mesh of an OBJ file. `meshText`: the section "mesh" of a scene that names the file. */
  readObj(objText: string, meshText: string): string;
  delete(): void;
}

export interface SimulationHandle {
  load(sceneText: string): string;
  carryOver(sceneText: string): string;
  /** Starts the loaded scene from these places, now and at each reset, pins with it [m]. */
  startFrom(places: Float64Array): string;
  reset(): string;
  /** 0, or the status code whose reason `status()` tells. */
  step(count: number): number;
  status(): string;
  numbers(): string;
  /** Views of module memory: a view is dead after the next call, take it anew each time. */
  positions(): Float32Array;
  /** The same positions in full precision. */
  exactPositions(): Float64Array;
  /** One a vertex [kg]. */
  masses(): Float64Array;
  /** Signed mean strain of the springs at each vertex, as a ratio. */
  stretch(): Float32Array;
  /** To the reference at each vertex [m]; empty without one for the scene at its time. */
  distances(): Float32Array;
  triangles(): Uint32Array;
  /** Compares with a reference from now on, whenever the loaded scene is what it is of. */
  setReference(bytes: Uint8Array): string;
  colliders(): string;
  grab(vertex: number): string;
  /** Target of the held patch [m]. */
  moveGrab(x: number, y: number, z: number): void;
  releaseGrab(): void;
  delete(): void;
}

export interface ExperimentHandle {
  start(planText: string): string;
  advance(budgetMs: number): string;
  delete(): void;
}

/** One number for each term of the energy of a deformed cloth. */
export interface TermNumbers {
  recovery: number;
  stretch: number;
  bending: number;
}

/** What `Deformation.open` finds in an experiment. */
export interface ClothAnswer {
  name: string;
  caption: string;
  n_vertices: number;
  n_triangles: number;
  /** Three numbers a vertex. */
  rest_m: number[];
  /** How far around a vertex a hand holds. */
  grasp_m: number;
  groups: { name: string; vertices: number[] }[];
  /** Held where they rest. */
  pins: number[];
  handles: { name: string; vertices: number[]; places_m: number[] }[];
  fabric: string;
}

/** How a pane's shape came about and what it costs. */
export interface DeformReport {
  weights: TermNumbers;
  energy: number;
  /** Unweighted. */
  terms: TermNumbers;
  converged: boolean;
  /** Since something was last moved, held or weighted otherwise. */
  steps: { energy: number; terms: TermNumbers; relativeStep: number; linearised: boolean }[];
}

/** What the measured fabrics make likely for a visitor's own measurements. */
export interface FitAnswer {
  weights: TermNumbers;
  normalised: TermNumbers;
  leaveOneOutError: TermNumbers;
  measuredRange: Record<keyof TermNumbers, [number, number]>;
  clamped: (keyof TermNumbers)[];
  nearest: string;
}

/** What `Deformation.step` answers. */
export const PROGRESS = { moved: 0, linearised: 1, converged: 2, stuck: 3 } as const;

/** One cloth in several panes, each with weights of its own, all under the same hold. */
export interface DeformationHandle {
  /** The cloth of an experiment; `objText` is of the file that it names, or empty. */
  open(sceneText: string, objText: string): string;
  /** `{form, weights: [...]}`: a pane for each. Panes keep their shape while the form stays. */
  show(panesText: string): string;
  /** Vertices, ascending, and three numbers a place [m]. Each pane takes it up in `follow`. */
  hold(vertices: Int32Array, places: Float64Array): string;
  moveHeld(places: Float64Array): void;
  follow(pane: number): string;
  /** One of PROGRESS. */
  step(pane: number, mayLinearise: boolean): number;
  restart(pane: number): string;
  /** `restart`, with the present shape set aside for `keepBetter`. */
  tryFromRest(pane: number): string;
  keepBetter(pane: number): string;
  report(pane: number): string;
  fitMeasures(measuresText: string): string;
  /** The section "cloth" of a scene in motion, with what is held as the group "held". */
  clothSection(): string;
  /** Views of module memory, dead after the next call. */
  triangles(): Uint32Array;
  positions(pane: number): Float32Array;
  exactPositions(pane: number): Float64Array;
  delete(): void;
}

export interface PleatModule {
  Scene: new (fabricsText: string) => SceneHandle;
  Simulation: new (fabricsText: string) => SimulationHandle;
}

/** A module of its own, fetched when the first sweep is asked for. */
export interface SweepModule {
  Experiment: new (fabricsText: string) => ExperimentHandle;
}

/** A module of its own, fetched when fabrics are first compared. */
export interface DeformModule {
  Deformation: new (fabricsText: string) => DeformationHandle;
}

/** Lists the keys of `Handle`; a missing or a surplus name does not compile. */
export function methodsOf<Handle>(names: Record<keyof Handle, true>): string[] {
  return Object.keys(names).sort();
}

/** The methods of each bound class by name. */
export const BOUND_METHODS: Record<keyof (PleatModule & SweepModule & DeformModule), string[]> = {
  Scene: methodsOf<SceneHandle>({
    fabrics: true,
    schema: true,
    parse: true,
    readObj: true,
    delete: true,
  }),
  Simulation: methodsOf<SimulationHandle>({
    load: true,
    carryOver: true,
    startFrom: true,
    reset: true,
    step: true,
    status: true,
    numbers: true,
    positions: true,
    exactPositions: true,
    masses: true,
    stretch: true,
    distances: true,
    setReference: true,
    triangles: true,
    colliders: true,
    grab: true,
    moveGrab: true,
    releaseGrab: true,
    delete: true,
  }),
  Experiment: methodsOf<ExperimentHandle>({ start: true, advance: true, delete: true }),
  Deformation: methodsOf<DeformationHandle>({
    open: true,
    show: true,
    hold: true,
    moveHeld: true,
    follow: true,
    step: true,
    restart: true,
    tryFromRest: true,
    keepBetter: true,
    report: true,
    fitMeasures: true,
    clothSection: true,
    triangles: true,
    positions: true,
    exactPositions: true,
    delete: true,
  }),
};
