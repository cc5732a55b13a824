// Answers each message to the worker of cloth in motion, as a function of the module and of where
// answers go. The only file that calls delete() on its objects.

import { granted, Refused, type RunStatus, read } from '../bindings/answers';
import { FLOATS_PER_VERTEX, frameViews, type Scalar } from '../bindings/frame';
import type { Collider, Surface, Triple } from '../bindings/geometry';
import {
  ENERGY_NUMBERS,
  type EnergyNumbers,
  type ImexShare,
  type MeshLevel,
  type PleatModule,
  type RunNumbers,
  type SceneSummary,
  type SimulationHandle,
} from '../bindings/pleat-module';
import type {
  FromMotion,
  ImplicitShareQuestion,
  LevelsQuestion,
  LoadMessage,
  RunReport,
  SceneToLoad,
  StepMessage,
  ToMotion,
  TornMesh,
} from './motion-protocol';
import { ModuleCore } from './serve';

/** Copies the present frame; the one copy on its way to the screen. NaN: there is no such number. */
function fill(simulation: SimulationHandle, buffer: ArrayBuffer, scalar: Scalar): void {
  const views = frameViews(buffer);
  views.positions.set(simulation.positions());
  const values = scalar === 'distance' ? simulation.distances() : simulation.stretch();
  if (values.length === views.scalar.length) views.scalar.set(values);
  else views.scalar.fill(Number.NaN);
}

function readEnergy(simulation: SimulationHandle): EnergyNumbers | null {
  const values = simulation.energies();
  if (values.length === 0) return null;
  const named = ENERGY_NUMBERS.map((name, index) => [name, values[index] ?? Number.NaN]);
  return Object.fromEntries(named) as EnergyNumbers;
}

/** Meshes among the solids of a scene. */
function readSurfaces(simulation: SimulationHandle): Surface[] {
  type Written = { positions_m: Triple[]; triangles: Triple[] };
  const answer = read<{ surfaces: Written[] }>(simulation.surfaces());
  return (answer.ok ? answer.surfaces : []).map(({ positions_m, triangles }) => {
    const positions = new Float32Array(positions_m.flat());
    const id = `${positions.reduce((all, x, index) => all + (index + 1) * x, 0)}`;
    return { id, positions, triangles: new Uint32Array(triangles.flat()) };
  });
}

function readColliders(simulation: SimulationHandle, surfaces: readonly Surface[]): Collider[] {
  type Told = Exclude<Collider, { shape: 'mesh' }> | ToldMesh;
  type ToldMesh = { shape: 'mesh'; offset_m: Triple; surface: number };
  const answer = read<{ colliders: Told[] }>(simulation.colliders());
  return (answer.ok ? answer.colliders : []).flatMap((told): Collider[] => {
    if (told.shape !== 'mesh') return [told];
    const surface = surfaces[told.surface] as Surface;
    return [{ ...told, surface }];
  });
}

/** Size of a buffer for the frames of the present mesh. */
function frameBytes(simulation: SimulationHandle): number {
  return (4 * FLOATS_PER_VERTEX * simulation.positions().length) / 3;
}

/** Serves one page. Call `receive` with each message, `close` at the end. */
export class MotionCore extends ModuleCore<PleatModule, ToMotion, FromMotion> {
  private simulation: SimulationHandle | null = null;
  private loaded: SceneSummary | null = null;
  private surfaces: Surface[] = [];
  private isHeld = false;
  private hasLedger = false;
  private nBytes = 0; // size of the buffers of frames
  private nStepsBefore = 0; // steps of the run until it took its present setting

  /** Numbers whose steps are those that the run took to its time, whatever their length. */
  private readNumbers(run: SimulationHandle): RunNumbers | null {
    const numbers = read<RunNumbers>(run.numbers());
    return numbers.ok ? { ...numbers, step: this.nStepsBefore + numbers.step } : null;
  }

  private readReport(run: SimulationHandle): RunReport | null {
    const numbers = this.readNumbers(run);
    const status = read<RunStatus>(run.status());
    if (!numbers || !status.ok) return null;
    return { numbers, status: status.status, message: status.message };
  }

  /** Sends everything the page draws from, with two fresh buffers, the first one filled. */
  private postLoaded({ scalar = 'stretch' }: { scalar?: Scalar }, run: SimulationHandle): void {
    const { loaded: summary } = this;
    const numbers = this.readNumbers(run);
    if (!summary || !numbers) throw new Error('no numbers after a load');
    this.nBytes = frameBytes(run);
    const buffers: [ArrayBuffer, ArrayBuffer] = [
      new ArrayBuffer(this.nBytes),
      new ArrayBuffer(this.nBytes),
    ];
    fill(run, buffers[0], scalar);
    const triangles = run.triangles().slice();
    this.surfaces = readSurfaces(run);
    const colliders = readColliders(run, this.surfaces);
    this.post({ type: 'loaded', summary, triangles, buffers, scalar, numbers, colliders }, [
      triangles.buffer,
      ...buffers,
    ]);
  }

  private take(run: SimulationHandle, { sceneText, start }: SceneToLoad, isKept: boolean): void {
    const nSteps = isKept ? this.readNumbers(run)?.step : 0;
    const text = isKept ? run.carryOver(sceneText) : run.load(sceneText);
    const { summary } = granted<{ summary: SceneSummary }>(text);
    if (start) granted(run.startFrom(start));
    const isOnItsWay = Number(this.readNumbers(run)?.time_s) > 0; // torn cloth begins anew
    this.nStepsBefore = (isOnItsWay && nSteps) || 0;
    this.loaded = summary;
  }

  private load(run: SimulationHandle, message: LoadMessage): void {
    for (const [index, leg] of (message.way ?? []).entries()) {
      this.take(run, leg, index > 0);
      if (run.step(leg.steps) !== 0) throw new Error('the run ended on a way that it had taken');
    }
    this.take(run, message, message.keepMotion && this.loaded !== null);
    this.postLoaded(message, run);
  }

  private reset(run: SimulationHandle, message: Extract<ToMotion, { type: 'reset' }>): void {
    if (!this.loaded) throw new Error('reset before load');
    granted(run.reset());
    this.nStepsBefore = 0;
    this.postLoaded(message, run);
  }

  /** One that cannot be read is none: the page goes without. */
  private setReference(run: SimulationHandle, bytes: ArrayBuffer): void {
    const answer = read<object>(run.setReference(new Uint8Array(bytes)));
    const numbers = answer.ok && this.loaded ? this.readNumbers(run) : null;
    if (numbers) this.post({ type: 'referenceSet', numbers }, []);
  }

  /** The buffer, or two of another size and the mesh when a tear has changed it. */
  private buffersFor(run: SimulationHandle, given: ArrayBuffer): [ArrayBuffer, TornMesh | null] {
    const nBytes = frameBytes(run);
    if (nBytes === this.nBytes) return [given, null];
    this.nBytes = nBytes;
    const torn = { triangles: run.triangles().slice(), spare: new ArrayBuffer(nBytes) };
    return [new ArrayBuffer(nBytes), torn];
  }

  private step(run: SimulationHandle, message: StepMessage): void {
    const { count, scalar = 'stretch', wantsEnergy = false } = message;
    // A buffer of another size belongs to the mesh before the last load: nothing to fill.
    if (!this.loaded || message.buffer.byteLength !== this.nBytes) return;
    if (wantsEnergy && !this.hasLedger) run.openLedger();
    if (!wantsEnergy && this.hasLedger) run.closeLedger();
    this.hasLedger = wantsEnergy;
    const code = run.step(count);
    const [buffer, torn] = this.buffersFor(run, message.buffer);
    fill(run, buffer, scalar);
    const hasEnded = code !== 0;
    const report = hasEnded || message.wantsNumbers ? this.readReport(run) : null;
    const energy = readEnergy(run);
    const colliders = readColliders(run, this.surfaces);
    this.post(
      { type: 'frame', count, buffer, torn, scalar, hasEnded, report, energy, colliders },
      torn ? [buffer, torn.spare, torn.triangles.buffer] : [buffer],
    );
  }

  private readSprings(run: SimulationHandle): void {
    const ends = run.springEnds().slice();
    const isImplicit = run.implicitSprings().slice();
    this.post({ type: 'springs', ends, isImplicit }, [ends.buffer, isImplicit.buffer]);
  }

  private readImplicitShare(run: SimulationHandle, message: ImplicitShareQuestion): void {
    const { stepS, substeps, explicitShare } = message;
    const text = run.implicitShare(stepS, substeps, explicitShare);
    const { substeps: taken, share } = granted<ImexShare>(text);
    this.post({ type: 'implicitShare', substeps: taken, share }, []);
  }

  private readLevels(run: SimulationHandle, message: LevelsQuestion): void {
    const { selection, nCoarser, ratio } = message;
    const answer = read<{ n_coarser: number; shortage: string }>(
      run.makeLevels(selection, nCoarser, ratio),
    );
    if (!answer.ok && answer.kind === 'internal') throw new Refused(answer);
    const levels: MeshLevel[] = [];
    for (let level = 1; answer.ok && level <= answer.n_coarser; ++level) {
      const vertices = run.levelVertices(level).slice();
      levels.push({ vertices, edges: run.levelEdges(level).slice() });
    }
    const shortage = answer.ok ? answer.shortage : answer.what;
    const transfer = levels.flatMap(({ vertices, edges }) => [vertices.buffer, edges.buffer]);
    this.post({ type: 'levels', levels, shortage }, transfer);
  }

  private open(text: string): void {
    this.simulation?.delete();
    this.simulation = new this.module.Simulation(text);
    this.loaded = null;
    this.hasLedger = false;
    this.post({ type: 'ready' }, []);
  }

  protected handle(message: ToMotion): void {
    if (message.type === 'open') return this.open(message.fabricsText);
    if (!this.simulation) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'load':
        this.isHeld = false;
        return this.load(this.simulation, message);
      case 'reset':
        this.isHeld = false;
        return this.reset(this.simulation, message);
      case 'setReference':
        return this.setReference(this.simulation, message.bytes);
      case 'step':
        return this.step(this.simulation, message);
      case 'readSprings':
        return this.readSprings(this.simulation);
      case 'readImplicitShare':
        return this.readImplicitShare(this.simulation, message);
      case 'readLevels':
        return this.readLevels(this.simulation, message);
      case 'grab':
        this.isHeld = this.loaded !== null && read<object>(this.simulation.grab(message.vertex)).ok;
        return;
      case 'moveGrab':
        if (this.isHeld) this.simulation.moveGrab(...message.target);
        return;
      case 'releaseGrab':
        if (this.isHeld) this.simulation.releaseGrab();
        this.isHeld = false;
        return;
    }
  }

  close(): void {
    this.simulation?.delete();
    this.simulation = null;
  }
}
