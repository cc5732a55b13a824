// A small stand-in for the WebAssembly module: a square sheet of springs, enough to test the page's
// side of the boundary. It counts the objects that are not deleted.

import type {
  BenchRow,
  ExperimentHandle,
  SweepModule,
} from '../../src/motion/bindings/sweep-module';
import type { Triple } from '../../src/shared/bindings/geometry';
import type {
  PleatModule,
  SceneHandle,
  SimulationHandle,
} from '../../src/shared/bindings/pleat-module';

/** Steps after which the run ends with a status, when the scene's name is "fragile". */
export const FRAGILE_STEPS = 10;

type FakeMethod = BenchRow['method'] & { solver?: string };

interface FakeChanges {
  '/refinement/level': number;
  '/method': FakeMethod;
}

interface FakeScene {
  name: string;
  refinement: { level: number };
  method: FakeMethod;
  model?: { tearing?: object };
}

interface FakePlan {
  settings: FakeChanges[];
  scene: FakeScene;
  reference: string;
}

/** The parts that the module is built with. */
interface FakeBuild {
  hasCholmod: boolean;
}

const ok = (payload: object = {}) => JSON.stringify({ ok: true, ...payload });
const refuse = (where: string, what: string) =>
  JSON.stringify({ ok: false, kind: 'input', where, what });

/** The direct solver that a method gets when it names none; null when it names one that is not there. */
function directSolver({ hasCholmod }: FakeBuild, method: FakeMethod): string | null {
  const solver = method.solver ?? (hasCholmod ? 'cholmod' : 'eigen');
  return solver === 'cholmod' && !hasCholmod ? null : solver;
}

class FakeSimulation implements SimulationHandle {
  private side = 0;
  private scene: FakeScene | null = null;
  private x = new Float32Array(0);
  private beginS = 0; // when it went on from another scene
  private steps = 0; // counted from then
  private held: number | null = null;
  private ended = false;
  private pulled = false;
  private isTorn = false;

  /** The lower right corner comes off, when it is held: its triangle gets a vertex of its own. */
  private tear(): void {
    const corner = this.side * this.side - 1;
    if (this.isTorn || this.held !== corner || !this.scene?.model?.tearing) return;
    this.isTorn = true;
    this.x = Float32Array.from([...this.x, ...this.x.subarray(3 * (corner - 1), 3 * corner)]);
  }

  constructor(
    private readonly build: FakeBuild,
    private readonly onDelete: () => void,
  ) {}

  private summary() {
    const n = this.side * this.side;
    const m = this.side - 1;
    return ok({
      summary: {
        n_vertices: n,
        n_triangles: 2 * m * m,
        n_springs: 2 * this.side * m,
        n_bends: 0,
        step_s: this.scene?.method.step_s,
        substeps: 1,
        built: ['springs'],
        left_out: ['contact'],
        notes: this.build.hasCholmod ? [] : ['Eigen serves.'],
      },
    });
  }

  load(text: string): string {
    const scene = JSON.parse(text) as FakeScene;
    if (scene.method.stepper === 'explicit' && scene.method.substeps === 1) {
      return refuse(
        '/method/substeps',
        'expected substeps of at most 5.6e-05 s, got 0.0167 s (300 substeps would do)',
      );
    }
    if (directSolver(this.build, scene.method) === null) {
      return refuse('/method/solver', 'expected a solver of this build, found cholmod');
    }
    this.scene = scene;
    this.side = 2 ** (scene.refinement.level + 1) + 1;
    this.reset();
    return this.summary();
  }

  private timeS = () => this.beginS + this.steps / 60;

  carryOver(text: string): string {
    const timeS = this.timeS();
    const answer = this.load(text);
    this.beginS = timeS;
    if (this.ledgerFrom !== null) this.openLedger();
    return answer;
  }

  startFrom(places: Float64Array): string {
    if (places.length !== this.x.length) return refuse('', 'expected a place for each vertex');
    this.x.set(places);
    return ok();
  }

  reset(): string {
    this.beginS = 0;
    this.steps = 0;
    if (this.ledgerFrom !== null) this.openLedger();
    this.pulled = false;
    this.ended = false;
    this.isTorn = false;
    this.x = new Float32Array(3 * this.side * this.side);
    for (let v = 0; v < this.side * this.side; ++v) {
      const [row, column] = [Math.floor(v / this.side), v % this.side];
      this.x.set([column / (this.side - 1), 1 - row / (this.side - 1), 0], 3 * v);
    }
    return ok();
  }

  step(count: number): number {
    for (let step = 0; step < count; ++step) {
      this.ended ||= this.scene?.name === 'fragile' && this.steps >= FRAGILE_STEPS;
      if (this.ended) return 3;
      this.steps += 1;
      this.tear();
      for (let v = 0; v < this.x.length / 3; ++v) {
        const depth = Math.floor(v / this.side) / (this.side - 1);
        this.x[3 * v + 2] = 0.3 * depth * Math.sin(0.1 * this.steps);
      }
    }
    return 0;
  }

  status(): string {
    return this.ended
      ? ok({ status: 'not_finite', message: 'vertex 3 is no longer finite' })
      : ok({ status: 'ok', message: '' });
  }

  numbers(): string {
    return ok({
      time_s: this.timeS(),
      step: this.steps,
      largest_stretch: 0.01,
      rms_stretch: 0.004,
      asked_stretch: null,
      residual: 1e-4,
      iterations: 7,
      parts_ms: { forces: 0.5 * this.steps, solve: 1.5 * this.steps },
      steps_ms: 2.5 * this.steps,
      steps_timed: this.steps,
      warnings: [],
      reference: this.compare(),
    });
  }

  positions = () => this.x;
  exactPositions = () => Float64Array.from(this.x);
  masses = () => new Float64Array(this.x.length / 3).fill(0.001);
  /** The stand-in's reference: the name of the scene it is of, and its end. */
  private reference: { name: string; end_s: number; uncertainty_m: number } | null = null;
  private matches = () => this.reference !== null && this.reference.name === this.scene?.name;

  private compare() {
    if (!this.reference || !this.matches()) return null;
    const { end_s, uncertainty_m } = this.reference;
    const isKnown = this.timeS() <= end_s && !this.pulled;
    return {
      distance_m: isKnown ? 0.012 : null,
      uncertainty_m: isKnown ? uncertainty_m : null,
      end_s,
      description: 'newton',
      disturbed: this.pulled,
    };
  }

  setReference(bytes: Uint8Array): string {
    const text = new TextDecoder().decode(bytes);
    if (!text.startsWith('{')) return refuse('', 'expected a reference');
    this.reference = JSON.parse(text);
    return ok({ matches: this.matches(), description: 'newton', end_s: this.reference?.end_s });
  }

  distances = () =>
    new Float32Array(this.compare()?.distance_m ? this.x.length / 3 : 0).fill(0.012);

  stretch = () => new Float32Array(this.x.length / 3).fill(this.steps === 0 ? 0 : 0.002);

  triangles(): Uint32Array {
    const corners: number[] = [];
    for (let row = 0; row + 1 < this.side; ++row) {
      for (let column = 0; column + 1 < this.side; ++column) {
        const a = row * this.side + column;
        corners.push(a, a + this.side, a + 1, a + 1, a + this.side, a + this.side + 1);
      }
    }
    if (this.isTorn) corners[corners.length - 2] = this.side * this.side;
    return Uint32Array.from(corners);
  }

  colliders = () => ok({ colliders: [{ shape: 'sphere', centre_m: [0, 0, 0], radius_m: 0.2 }] });
  surfaces = () => ok({ surfaces: [] });

  private ledgerFrom: number | null = null; // the step at which the account began
  openLedger = () => {
    this.ledgerFrom = this.steps;
  };
  closeLedger = () => {
    this.ledgerFrom = null;
  };
  /** All energy of height becomes energy of motion, but for what damping takes. */
  energies(): Float64Array {
    if (this.ledgerFrom === null) return new Float64Array(0);
    const fallen = 0.01 * (this.steps - this.ledgerFrom);
    const held = [0.75 * fallen, 0, 0 - fallen];
    return Float64Array.from([this.timeS(), ...held, 0 - 0.25 * fallen, 0, 0, 0, 0, 0, 0]);
  }

  /** Two springs, of which imex has one implicit; the other one while a hand holds the cloth. */
  springEnds = () => Uint32Array.from([0, 1, 1, 2]);
  implicitSprings = () => {
    const held = this.held === null ? [1, 0] : [0, 1];
    return Int8Array.from(this.scene?.method.stepper === 'imex' ? held : []);
  };

  /** All springs in substeps of 1/60 s, and ever fewer in shorter ones. */
  implicitShare(stepS: number, substeps: number, explicitShare: number): string {
    const enough = Math.ceil((60 * stepS) / Math.max(1e-6, 1 - explicitShare));
    const taken = explicitShare > 0 ? Math.max(substeps, enough) : substeps;
    return ok({ substeps: taken, share: Math.min(1, (60 * stepS) / taken) });
  }

  /** Every other vertex of the level before, and a line through them; two levels at most. */
  private nCoarser = 0;
  makeLevels(selection: string, nCoarser: number, ratio: number): string {
    if (ratio > 0.9) return refuse('ratio', 'expected a number below 0.9');
    this.nCoarser = Math.min(nCoarser, 2);
    const shortage = nCoarser > 2 ? `no third level of ${selection}` : '';
    return ok({ n_coarser: this.nCoarser, shortage });
  }

  levelVertices(level: number): Uint32Array {
    if (level > this.nCoarser) return new Uint32Array(0);
    const all = Uint32Array.from({ length: this.x.length / 3 }, (_, v) => v);
    return all.filter((v) => v % 2 ** level === 0);
  }

  levelEdges(level: number): Uint32Array {
    const vertices = [...this.levelVertices(level)];
    return Uint32Array.from(vertices.slice(1).flatMap((v, i) => [vertices[i] ?? 0, v]));
  }

  grab(vertex: number): string {
    if (vertex < 0 || vertex >= this.x.length / 3) return refuse('', `no vertex ${vertex}`);
    this.held = vertex;
    this.pulled = true;
    return ok();
  }

  moveGrab(x: number, y: number, z: number): void {
    if (this.held !== null) this.x.set([x, y, z], 3 * this.held);
  }

  releaseGrab(): void {
    this.held = null;
  }

  delete(): void {
    this.onDelete();
  }
}

class FakeExperiment implements ExperimentHandle {
  private rows: BenchRow[] = [];
  private readonly kept: string[] = [];

  constructor(
    private readonly build: FakeBuild,
    private readonly onDelete: () => void,
  ) {}

  start(text: string): string {
    const plan = JSON.parse(text) as FakePlan;
    if (plan.settings.length === 0) return refuse('/settings', 'expected a setting, found none');
    for (const method of [...plan.settings.map((one) => one['/method']), plan.scene.method]) {
      if (directSolver(this.build, method) === null) return refuse('/settings', 'found cholmod');
    }
    const reference = `implicit with ${this.build.hasCholmod ? 'cholmod' : 'eigen'}`;
    this.rows = plan.settings.map(({ '/refinement/level': level, '/method': method }) => {
      const solver = directSolver(this.build, method);
      return row(
        level,
        method.stepper === 'projective' ? { ...method, solver } : method,
        reference,
      );
    });
    return ok({ references: [plan.reference, 'own-0'] });
  }

  /** The stand-in's references are the texts of their ids. */
  keepReference(bytes: Uint8Array): string {
    const text = new TextDecoder().decode(bytes);
    if (text.startsWith('<')) return refuse('', 'expected a reference');
    this.kept.push(text);
    return ok();
  }

  private shown = 0;

  advance(): string {
    this.shown += 1;
    const done = this.shown >= this.rows.length;
    return ok({
      done,
      progress: this.shown / this.rows.length,
      rows: this.rows.slice(0, this.shown),
      front: [0],
      message: done ? 'done' : `running with ${this.kept.join(' and ') || 'what it makes'}`,
      estimated_s: this.rows.length,
    });
  }

  delete(): void {
    this.onDelete();
  }
}

function row(level: number, method: BenchRow['method'], reference: string): BenchRow {
  return {
    scene: 'fake',
    setting: { '/refinement/level': level, '/method': method },
    method,
    level,
    n_vertices: (2 ** (level + 1) + 1) ** 2,
    n_substeps: 1,
    n_unresolved_contacts: 0,
    n_runs: 5,
    ms_per_frame: 2 ** level,
    ms_per_simulated_second: 60 * 2 ** level,
    spread_ms: 0.1,
    position_error_m: 0.01 / 2 ** level,
    position_error_percent: 1 / 2 ** level,
    method_error_m: 0.002,
    mesh_error_m: 0.009 / 2 ** level,
    rms_stretch: 0.004,
    largest_stretch: 0.01,
    reference: { id: 'fake', converged: true, description: reference, uncertainty_m: 1e-4 },
    status: 'ok',
    message: '',
    target: 'wasm',
  };
}

const ORIGIN: Triple = [0, 0, 0];

/** Knows positions, names of groups, and whether there are texture coordinates. */
function fakeObj(text: string, meshText: string): string {
  const lines = text.split('\n');
  const bad = lines.findIndex((line) => !/^(v|vt|g) |^f( \S+){3,}$|^$/.test(line));
  const { obj, warp_direction } = JSON.parse(meshText) as { obj: string; warp_direction: Triple };
  if (bad >= 0) return refuse(`${obj}: line ${bad + 1}`, 'expected a statement of OBJ');
  const positions = lines
    .filter((line) => line.startsWith('v '))
    .map((line) => line.slice(2).split(' ').map(Number) as Triple);
  const ends = (pick: (...values: number[]) => number) =>
    ORIGIN.map((_, axis) => pick(...positions.map((position) => position[axis] ?? 0)));
  return ok({
    cloth: { mesh: { positions_m: positions, warp_direction } },
    groups: lines.filter((line) => line.startsWith('g ')).map((line) => line.slice(2)),
    n_vertices: positions.length,
    n_triangles: lines.filter((line) => line.startsWith('f ')).length,
    low_m: ends(Math.min),
    high_m: ends(Math.max),
    needs_direction: !text.includes('vt '),
  });
}

/** The module, and how many of its objects are still alive. */
export function createFakeModule(build: FakeBuild = { hasCholmod: true }): {
  module: PleatModule & SweepModule;
  alive: () => number;
} {
  let nAlive = 0;
  const born = () => {
    nAlive += 1;
    return () => {
      nAlive -= 1;
    };
  };
  class Scene implements SceneHandle {
    private readonly onDelete = born();
    fabrics = () => ok({ fabrics: [] });
    steppers = () => ok({ steppers: [] });
    /** Its tolerance, unless the scene has one, is that of imex. */
    parse = (text: string) => {
      const { method } = JSON.parse(text) as FakeScene;
      const scene = { method: { tolerance: 1e-4, ...method } };
      return ok({ scene, summary: { substeps: method.substeps } });
    };
    studyResponse = (text: string) => {
      const { world } = JSON.parse(text) as { world?: { colliders?: object[] } };
      if (!world?.colliders?.length)
        return refuse('/world/colliders', 'expected a solid, got none');
      const run = { n_touched: 2, contact_share: 0.2 };
      const speeds = (mps: number) => ({
        normal_velocities_m_per_s: [mps, mps],
        rms_normal_velocity_m_per_s: mps,
      });
      return ok({
        first_contact_s: 0.2,
        substep_s: 0.025,
        resting: { ...run, ...speeds(0.01) },
        uniform: { ...run, ...speeds(1) },
      });
    };
    readObj = fakeObj;
    delete(): void {
      this.onDelete();
    }
  }
  class Simulation extends FakeSimulation {
    constructor() {
      super(build, born());
    }
  }
  class Experiment extends FakeExperiment {
    constructor() {
      super(build, born());
    }
  }
  return { module: { Scene, Simulation, Experiment }, alive: () => nAlive };
}
