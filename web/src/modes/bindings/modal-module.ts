// The class bound by the module that finds modes and in-betweens, and the shape of the texts it answers with.

/** The measure of how much a shape costs: the volume inside, the surface alone, or a cloth's own springs. */
export type Energy = 'volume' | 'surface' | 'cloth';

/** The volume that carries a surface: as it fits, cubes inside, or the surface thickened. */
export type VolumeChoice = 'auto' | 'lattice' | 'shell';

/** Answer of the opening calls. */
export interface SurfaceAnswer {
  n_vertices: number;
  n_triangles: number;
  /** True where every edge has two triangles. */
  closed: boolean;
  /** Pinned vertices of a cloth. */
  pins?: number[];
  /** One step of a cloth's run. */
  step_s?: number;
  /** Skipped statements of the OBJ file, counted, in words; missing or empty when none was. */
  skipped?: string;
}

export interface RunAnswer {
  time_s: number;
  /** Speed of the fastest vertex. */
  speed_m_per_s: number;
}

export interface ModesAnswer {
  /**
   * Square of the angular frequency of each mode beside the rigid ones, ascending: of a cloth [1/s²], of a
   * volume under 1 Pa and 1 kg/m³, of a surface under 1 N/m and 1 kg/m².
   */
  stiffness: number[];
  /** How many rigid motions were left out. */
  rigid: number;
  /** Tetrahedra of the volume; 0 without one. */
  tets: number;
}

export interface VolumeWish {
  volume: VolumeChoice;
  /** Edge of the cubes or thickness of the shell [m]; the usual one if missing. */
  size_m?: number;
  /** How many, beside the rigid ones. */
  modes: number;
}

export interface CompletionAnswer {
  tets: number;
  /** Parts of the surface that move each for itself. */
  bodies: number;
}

/** A shape between two keys, and the one that lies straight between the same keys at the same time. */
export interface FilledFrame {
  /** The first key is at 0, the next one at 1. */
  time: number;
  /** The key at its time or the last one before. */
  left: number;
  share_of_next: number;
  unequal_halves: number;
  volume_m3: number;
  straight_volume_m3: number;
  /** Root of the mean square of how far each piece is from a turned copy of itself; a ratio. */
  strain: number;
  straight_strain: number;
}

/** One surface, or one cloth of a scene, its modes and its key shapes. */
export interface ModalStudyHandle {
  /** `{sides_m: [x, y, z], cells}`: a closed box. */
  openBox(boxText: string): string;
  openObj(objText: string): string;
  /** A key shape from a file of its own, with the vertices and triangles of the surface. */
  readKey(objText: string): string;
  openScene(sceneText: string): string;
  /** So many steps of the scene; the shape is the one that it has come to. */
  run(steps: number): string;
  /** `{energy, ...VolumeWish}`: about the present shape. */
  findModes(wantedText: string): string;
  /** Keys one after the other, three numbers a vertex [m], and `{keys: n, ...VolumeWish}`. */
  complete(places: Float64Array, wantedText: string): string;
  replaceKey(index: number, places: Float64Array): string;
  fillIn(count: number): string;
  volumeShares(): string;
  /** Frames one after the other, three numbers a vertex [m]. */
  clothShares(places: Float64Array, count: number): string;
  /** Views of module memory, dead after the next call. */
  triangles(): Uint32Array;
  /** The shape that modes are about. */
  shape(): Float64Array;
  /** The shape that readKey found. */
  key(): Float64Array;
  /** Moves of each mode, where the farthest vertex moves by 1. */
  moves(): Float32Array;
  /** Surfaces of all frames, one after the other. */
  filled(): Float64Array;
  delete(): void;
}

/** A module of its own, fetched when modes are first looked at. */
export interface ModalModule {
  ModalStudy: new (fabricsText: string) => ModalStudyHandle;
}
