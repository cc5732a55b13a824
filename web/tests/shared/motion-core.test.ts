import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import type { SweepModule } from '../../src/motion/bindings/sweep-module';
import {
  PRESET_IDS,
  PRESETS,
  presetSetting,
  type Setting,
  sceneOf,
  withModel,
  withStepper,
} from '../../src/motion/state/setting';
import { settingOf, sweepPlan } from '../../src/motion/state/sweep-plan';
import { readObj } from '../../src/motion/worker/obj-core';
import type { ObjReadMessage } from '../../src/motion/worker/obj-protocol';
import { SweepCore } from '../../src/motion/worker/sweep-core';
import type { FromSweep } from '../../src/motion/worker/sweep-protocol';
import type { Failure } from '../../src/shared/bindings/answers';
import { frameViews } from '../../src/shared/bindings/frame';
import type { PleatModule, RunNumbers } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { openObjFile } from '../../src/shared/state/obj-file';
import { canRun, STEPPER_NAMES, STEPPERS } from '../../src/shared/steppers/steppers';
import { MotionCore } from '../../src/shared/workers/motion-core';
import type { FromMotion, ToMotion } from '../../src/shared/workers/motion-protocol';
import { boundMethods } from '../support/bound-methods';
import { loadFirst, loadModule } from '../support/built-module';
import { createFakeModule } from '../support/fake-module';
import { TYPED_METHODS } from '../support/typed-methods';

type AllModules = PleatModule & SweepModule;

type Posted = FromMotion | FromSweep;
type Sent<Type extends Posted['type']> = Extract<Posted, { type: Type }>;

/** A core with everything it posted; `take` removes and returns the next message. */
function serve(module: AllModules) {
  const posted: Posted[] = [];
  const core = new MotionCore(module, (message) => posted.push(message));
  return {
    core,
    posted,
    send: (message: ToMotion) => core.receive(message),
    /** Plans and runs; what is posted begins with the ids of its references. */
    sweep(plan: object) {
      const sweeping = new SweepCore(module, (message) => posted.push(message));
      sweeping.receive({ type: 'plan', fabricsText, planText: JSON.stringify(plan) });
      if (posted.at(-1)?.type === 'planned') sweeping.receive({ type: 'measure' });
      sweeping.close();
    },
    take<Type extends Posted['type']>(type: Type): Sent<Type> {
      const message = posted.shift();
      if (message?.type !== type) throw new Error(`${type} expected: ${JSON.stringify(message)}`);
      return message as Sent<Type>;
    },
  };
}

const ALL_TO_1 = { finest: 1, withSlow: true };
const sheet = presetSetting('swinging-sheet');
const setting: Setting = { ...presetSetting('curtain'), level: 1 };
const sceneText = (patch: Partial<Setting> = {}) =>
  JSON.stringify(sceneOf({ ...setting, ...patch }));

function open(module: AllModules) {
  const server = serve(module);
  server.send({ type: 'open', fabricsText });
  server.take('ready');
  server.send({ type: 'load', sceneText: sceneText(), keepMotion: false });
  return { ...server, loaded: server.take('loaded') };
}

async function read(module: AllModules, name: string, text: string) {
  const file = await openObjFile(new File([text], name));
  if (typeof file === 'string') throw new Error(file);
  const { low, high } = file;
  const known = { name, isOwn: true, unit: 'm', odd: null, low, high } as const;
  return readObj(module, { type: 'readObj', fabricsText, objText: text, file: known });
}

/** Two triangles, upright or level, in a group. */
function objText(isFlat: boolean, isTextured = false): string {
  const point = (a: number, b: number) => (isFlat ? `v ${a} 1 ${b}` : `v ${a} ${b} 0`);
  const points = [point(0, 1), point(0, 0), point(1, 0), point(1, 1)];
  if (!isTextured) return [...points, 'g hem', 'f 1 2 3', 'f 1 3 4', ''].join('\n');
  const texture = ['vt 0 0', 'vt 0 1', 'vt 1 1', 'vt 1 0'];
  return [...points, ...texture, 'g hem', 'f 1/1 2/2 3/3', 'f 1/1 3/3 4/4', ''].join('\n');
}

const modules: [string, () => Promise<AllModules>][] = [
  ['the stand-in', async () => createFakeModule().module],
  ['the WebAssembly module', loadFirst],
];

describe.each(modules)('motion-core with %s', (_name, load) => {
  it('answers a load with a mesh, a first frame and numbers that fit together', async () => {
    const { loaded } = open(await load());
    const { positions, scalar } = frameViews(loaded.buffers[0]);
    expect(positions.length).toBe(3 * loaded.summary.n_vertices);
    expect(scalar.length).toBe(loaded.summary.n_vertices);
    expect(loaded.triangles.length).toBe(3 * loaded.summary.n_triangles);
    expect(Math.max(...loaded.triangles)).toBe(loaded.summary.n_vertices - 1);
    expect(loaded.buffers[1].byteLength).toBe(loaded.buffers[0].byteLength);
    expect(loaded.numbers.time_s).toBe(0);
  });

  it('fills the buffer it was given with the moved cloth', async () => {
    const { send, take, loaded } = open(await load());
    const [first, buffer] = loaded.buffers;
    send({ type: 'step', count: 5, wantsNumbers: true, buffer });
    const frame = take('frame');
    expect(frame.buffer).toBe(buffer);
    expect(frame.hasEnded).toBe(false);
    expect(frame.report?.numbers.time_s).toBeCloseTo(5 * loaded.summary.step_s, 12);
    expect(frameViews(frame.buffer).positions).not.toEqual(frameViews(first).positions);
    expect(frameViews(frame.buffer).positions.every(Number.isFinite)).toBe(true);
  });

  it('accounts for all energy of the frames that want it, and for none of the others', async () => {
    const { send, take, loaded } = open(await load());
    const [buffer, other] = loaded.buffers;
    const step = (count: number, wantsEnergy: boolean, into: ArrayBuffer) => {
      const wanted = { wantsNumbers: false, wantsEnergy };
      send({ type: 'step', count, buffer: into, ...wanted });
      return take('frame').energy;
    };
    expect(step(3, false, buffer)).toBeNull();
    const first = step(0, true, other);
    expect(first).toMatchObject({ damping: 0, air: 0, contact: 0, pins: 0, gravity: 0 });
    const now = step(20, true, buffer);
    if (!first || !now) throw new Error('no account');
    expect(now.time_s - first.time_s).toBeCloseTo(20 * loaded.summary.step_s, 9);
    const held = now.kinetic + now.elastic + now.gravity;
    const given = now.start + now.damping + now.air + now.contact + now.pins + now.drift;
    expect(Math.abs(held - given)).toBeLessThan(1e-9 * Math.abs(now.gravity));
    expect(now.kinetic).toBeGreaterThan(0);
    expect(now.damping).toBeLessThan(0);
    expect(step(1, false, other)).toBeNull();
  });

  it('begins the account anew with a load and a reset', async () => {
    const { send, take, loaded } = open(await load());
    const wanted = { wantsNumbers: false, wantsEnergy: true } as const;
    send({ type: 'step', count: 9, buffer: loaded.buffers[1], ...wanted });
    expect(take('frame').energy?.gravity).not.toBe(0);
    for (const begin of [
      { type: 'reset' },
      { type: 'load', sceneText: sceneText(), keepMotion: true },
    ] as const) {
      send(begin);
      const [buffer] = take('loaded').buffers;
      send({ type: 'step', count: 0, buffer, ...wanted });
      expect(take('frame').energy).toMatchObject({ gravity: 0, damping: 0, drift: 0 });
    }
  });

  it('tells the springs of the mesh, and which of them imex takes implicitly', async () => {
    const { send, take } = open(await load());
    const splitOf = (patch: Partial<Setting>) => {
      send({ type: 'load', sceneText: sceneText(patch), keepMotion: false });
      const { summary } = take('loaded');
      send({ type: 'readSprings' });
      const { ends, isImplicit } = take('springs');
      expect(Math.max(...ends)).toBeLessThan(summary.n_vertices);
      return { n: ends.length / 2, summary, isImplicit: Array.from(isImplicit) };
    };
    const imex = withStepper(setting, 'imex');
    const { n, summary, isImplicit } = splitOf(imex);
    expect(isImplicit).toHaveLength(n);
    expect(isImplicit).toContain(1);
    expect(splitOf(withStepper(setting, 'xpbd')).isImplicit).toEqual([]);
    if (_name === 'the stand-in') return;
    expect(n).toBe(summary.n_springs);
    const count = (split: number[]) => split.reduce((sum, one) => sum + one, 0);
    const finer = splitOf({ ...imex, substeps: 40 * imex.substeps }).isImplicit;
    expect(count(finer)).toBeLessThan(count(isImplicit));
  });

  it('tells coarser levels, each of vertices of the one before', async () => {
    const { send, take, loaded } = open(await load());
    const wanted = { selection: 'quadrics', ratio: 0.25 } as const;
    send({ type: 'readLevels', ...wanted, nCoarser: 2 });
    const { levels, shortage } = take('levels');
    expect(shortage).toBe('');
    expect(levels).toHaveLength(2);
    let before = new Set(Array.from({ length: loaded.summary.n_vertices }, (_, v) => v));
    for (const { vertices, edges } of levels) {
      expect(vertices.length).toBeGreaterThan(1);
      expect(vertices.length).toBeLessThan(before.size);
      expect([...vertices].filter((v) => !before.has(v))).toEqual([]);
      before = new Set(vertices);
      expect(before.size).toBe(vertices.length);
      expect([...edges].filter((v) => !before.has(v))).toEqual([]);
      expect(new Set(edges)).toEqual(before);
    }
    send({ type: 'readLevels', ...wanted, selection: 'thinned', nCoarser: 30 });
    expect(take('levels').shortage).not.toBe('');
    send({ type: 'readLevels', ...wanted, ratio: 0.95, nCoarser: 2 });
    expect(take('levels')).toMatchObject({ levels: [], shortage: expect.stringContaining('0.9') });
  });

  it('tells the share of springs that imex takes implicitly in any substep', async () => {
    const { send, take } = open(await load());
    const imex = withStepper(setting, 'imex');
    send({ type: 'load', sceneText: sceneText(imex), keepMotion: false });
    take('loaded');
    const shareAt = (substeps: number) => {
      const { stepS } = imex;
      send({ type: 'readImplicitShare', stepS, substeps, explicitShare: 0 });
      const answer = take('implicitShare');
      expect(answer.substeps).toBe(substeps);
      return answer.share;
    };
    const { stepS } = imex;
    const wanted = { substeps: 2, explicitShare: 0.75 };
    send({ type: 'readImplicitShare', stepS, ...wanted });
    const taken = take('implicitShare');
    expect(taken.share).toBeLessThanOrEqual(0.25);
    expect(shareAt(taken.substeps)).toBe(taken.share);
    expect(shareAt(taken.substeps - 1)).toBeGreaterThan(0.25);
    const shares = [1, 4, 16, 64, 256, 4096].map(shareAt);
    expect(shares).toEqual([...shares].sort((a, b) => b - a));
    expect(shares[0]).toBeGreaterThan(shareAt(64));
    if (_name === 'the stand-in') return;
    expect(shares.at(-1)).toBe(0);
    send({ type: 'readSprings' });
    const { isImplicit } = take('springs');
    const nImplicit = isImplicit.reduce((sum, one) => sum + one, 0);
    expect(shareAt(imex.substeps)).toBeCloseTo(nImplicit / isImplicit.length, 12);
  });

  it('keeps the motion when the level changes, and forgets it on a load', async () => {
    const { send, take, loaded } = open(await load());
    send({ type: 'step', count: 20, wantsNumbers: true, buffer: loaded.buffers[1] });
    const before = take('frame').report?.numbers.time_s ?? 0;
    expect(before).toBeGreaterThan(0);
    send({ type: 'load', sceneText: sceneText({ level: 2 }), keepMotion: true });
    const carried = take('loaded');
    expect(carried.summary.n_vertices).toBeGreaterThan(loaded.summary.n_vertices);
    expect(carried.numbers.time_s).toBeCloseTo(before, 9);
    send({ type: 'load', sceneText: sceneText(), keepMotion: false });
    expect(take('loaded').numbers.time_s).toBe(0);
  });

  it('counts the steps that a run took to its time, in whatever setting they were', async () => {
    const { send, take, loaded } = open(await load());
    const step = (count: number, buffer: ArrayBuffer) => {
      send({ type: 'step', count, wantsNumbers: true, buffer });
      return take('frame').report?.numbers;
    };
    step(6, loaded.buffers[1]);
    const change = (patch: Partial<Setting>) => {
      send({ type: 'load', sceneText: sceneText(patch), keepMotion: true });
      return take('loaded');
    };
    const carried = change({ substeps: 3 });
    expect(carried.numbers.step).toBe(6);
    expect(carried.numbers.time_s).toBeCloseTo(6 / 60, 9);
    const later = step(3, carried.buffers[1]);
    expect(later?.step).toBe(9);
    expect(later?.time_s).toBeCloseTo(9 / 60, 9);
    expect(change({ level: 2 }).numbers.step).toBe(9);
    send({ type: 'reset' });
    expect(take('loaded').numbers).toMatchObject({ step: 0, time_s: 0 });
  });

  it('goes on from the end of a way, as the run did that took it', async () => {
    const { send, take, loaded } = open(await load());
    const carry = (patch: Partial<Setting>) =>
      send({ type: 'load', sceneText: sceneText(patch), keepMotion: true });
    const step = (count: number, buffer: ArrayBuffer) => {
      send({ type: 'step', count, wantsNumbers: true, buffer });
      return take('frame').buffer;
    };
    step(5, loaded.buffers[1]);
    carry({ substeps: 3 });
    step(4, take('loaded').buffers[1]);
    carry({ substeps: 4 });
    const { buffers, numbers } = take('loaded');
    step(30, buffers[1]);
    const way = [
      { sceneText: sceneText(), steps: 5 },
      { sceneText: sceneText({ substeps: 3 }), steps: 4 },
    ];
    send({ type: 'load', sceneText: sceneText({ substeps: 4 }), keepMotion: true, way });
    const again = take('loaded');
    expect(again.numbers).toMatchObject({ step: 9, time_s: numbers.time_s });
    expect(frameViews(again.buffers[0]).positions).toEqual(frameViews(buffers[0]).positions);
  });

  it('is back at the first frame after a reset', async () => {
    const { send, take, loaded } = open(await load());
    send({ type: 'step', count: 9, wantsNumbers: false, buffer: loaded.buffers[1] });
    take('frame');
    send({ type: 'reset' });
    const again = take('loaded');
    expect(again.numbers.step).toBe(0);
    expect(frameViews(again.buffers[0])).toEqual(frameViews(loaded.buffers[0]));
  });

  it('runs every stepper of the page from its usual setting', async () => {
    const { send, take } = open(await load());
    STEPPER_NAMES.forEach((stepper) => {
      const text = JSON.stringify(sceneOf(withStepper({ ...setting, level: 0 }, stepper)));
      send({ type: 'load', sceneText: text, keepMotion: false });
      const [, buffer] = take('loaded').buffers;
      send({ type: 'step', count: 2, wantsNumbers: true, buffer });
      expect(take('frame')).toMatchObject({ hasEnded: false, report: { status: 'ok' } });
    });
  });

  it('runs a membrane with every stepper that the page offers for it', async () => {
    const { send, take } = open(await load());
    const membrane = withModel({ ...setting, level: 0 }, 'membrane');
    const possible = STEPPER_NAMES.filter((stepper) => canRun(stepper, 'membrane'));
    expect(possible).not.toContain('xpbd');
    possible.forEach((stepper) => {
      const text = JSON.stringify(sceneOf(withStepper(membrane, stepper)));
      send({ type: 'load', sceneText: text, keepMotion: false });
      const [, buffer] = take('loaded').buffers;
      send({ type: 'step', count: 2, wantsNumbers: true, buffer });
      expect(take('frame')).toMatchObject({ hasEnded: false, report: { status: 'ok' } });
    });
    for (const stepper of STEPPER_NAMES.filter((one) => !possible.includes(one))) {
      if (_name === 'the stand-in') continue;
      const text = JSON.stringify(sceneOf(withStepper(membrane, stepper)));
      send({ type: 'load', sceneText: text, keepMotion: false });
      expect(take('refused').failure.kind).toBe('input');
    }
  });

  it('says why a scene is refused and keeps the cloth it had', async () => {
    const { send, take, loaded } = open(await load());
    const refusedText = sceneText({ stepper: 'explicit', substeps: 1 });
    send({ type: 'load', sceneText: refusedText, keepMotion: false });
    const { failure } = take('refused');
    expect(failure.kind).toBe('input');
    expect(failure.where).toBe('/method/substeps');
    expect(failure.what).toContain('substeps');
    send({ type: 'step', count: 1, wantsNumbers: false, buffer: loaded.buffers[1] });
    expect(take('frame').hasEnded).toBe(false);
  });

  it('moves a held vertex to its target and lets it go', async () => {
    const { send, take, loaded } = open(await load());
    const { positions } = frameViews(loaded.buffers[0]);
    const vertex = loaded.summary.n_vertices - 1;
    const target: [number, number, number] = [
      (positions[3 * vertex] ?? 0) + 0.05,
      positions[3 * vertex + 1] ?? 0,
      (positions[3 * vertex + 2] ?? 0) + 0.05,
    ];
    send({ type: 'grab', vertex });
    send({ type: 'moveGrab', target });
    send({ type: 'step', count: 30, wantsNumbers: false, buffer: loaded.buffers[1] });
    const moved = frameViews(take('frame').buffer).positions;
    const held = moved.subarray(3 * vertex, 3 * vertex + 3);
    // The stand-in swings what it steps; the module puts a held vertex at its target.
    if (_name !== 'the stand-in') {
      target.forEach((value, axis) => {
        expect(held[axis]).toBeCloseTo(value, 5);
      });
    }
    send({ type: 'releaseGrab' });
    send({ type: 'moveGrab', target: [9, 9, 9] });
    send({ type: 'step', count: 20, wantsNumbers: false, buffer: loaded.buffers[0] });
    const free = frameViews(take('frame').buffer).positions;
    expect(Math.max(...free)).toBeLessThan(8);
    const away = [0, 1, 2].map((axis) => (free[3 * vertex + axis] ?? 0) - (target[axis] ?? 0));
    expect(Math.hypot(...away)).toBeGreaterThan(0.001);
  });

  it('sends another mesh with the frame in which the cloth tears, and the whole one at a reset', async () => {
    const { send, take } = open(await load());
    const tearing = JSON.stringify(sceneOf({ ...presetSetting('tearing-curtain'), level: 1 }));
    send({ type: 'load', sceneText: tearing, keepMotion: false });
    const { summary, buffers, triangles } = take('loaded');
    const vertex = summary.n_vertices - 1;
    const places = frameViews(buffers[0]).positions;
    const [x = 0, y = 0, z = 0] = places.subarray(3 * vertex, 3 * vertex + 3);
    send({ type: 'grab', vertex });
    let [buffer] = buffers;
    let nVertices = summary.n_vertices;
    let last = triangles;
    for (let s = 1; s <= 60; ++s) {
      send({ type: 'moveGrab', target: [x + 0.01 * s, y, z + 0.01 * s] });
      send({ type: 'step', count: 1, wantsNumbers: false, buffer });
      const frame = take('frame');
      const { positions, scalar } = frameViews(frame.buffer);
      expect(frame.torn !== null).toBe(scalar.length > nVertices);
      expect(positions.every(Number.isFinite) && scalar.every(Number.isFinite)).toBe(true);
      if (frame.torn) {
        expect(frame.torn.spare.byteLength).toBe(frame.buffer.byteLength);
        last = frame.torn.triangles;
      } else expect(frame.buffer).toBe(buffer);
      ({ buffer } = frame);
      nVertices = scalar.length;
    }
    expect(nVertices).toBeGreaterThan(summary.n_vertices);
    expect(last.length).toBe(triangles.length);
    expect(Math.max(...last)).toBe(nVertices - 1);
    send({ type: 'step', count: 1, wantsNumbers: false, buffer: buffers[1] });
    send({ type: 'reset' });
    const whole = take('loaded');
    expect(whole.triangles).toEqual(triangles);
    expect(frameViews(whole.buffers[0]).scalar.length).toBe(summary.n_vertices);
  });

  it('counts steps of another length beside those before', async () => {
    if (_name === 'the stand-in') return; // its steps are all alike
    const { send, take, loaded } = open(await load());
    send({ type: 'step', count: 6, wantsNumbers: false, buffer: loaded.buffers[1] });
    take('frame');
    send({ type: 'load', sceneText: sceneText({ stepS: 1 / 240 }), keepMotion: true });
    const { buffers } = take('loaded');
    send({ type: 'step', count: 4, wantsNumbers: true, buffer: buffers[1] });
    const numbers = take('frame').report?.numbers;
    expect(numbers?.step).toBe(10);
    expect(numbers?.time_s).toBeCloseTo(6 / 60 + 4 / 240, 9);
  });

  it('begins torn cloth anew in another fabric', async () => {
    if (_name === 'the stand-in') return;
    const { send, take } = open(await load());
    const torn = { ...presetSetting('tearing-curtain'), level: 0 };
    const weak = { ...sceneOf(torn), model: { tearing: { breaking_elongation: 1e-6 } } };
    send({ type: 'load', sceneText: JSON.stringify(weak), keepMotion: false });
    const { buffers } = take('loaded');
    send({ type: 'step', count: 9, wantsNumbers: false, buffer: buffers[1] });
    expect(take('frame').torn).not.toBeNull();
    const silk = JSON.stringify(sceneOf({ ...torn, fabric: 'silk' }));
    send({ type: 'load', sceneText: silk, keepMotion: true });
    expect(take('loaded').numbers).toMatchObject({ step: 0, time_s: 0 });
  });

  it('measures a small sweep: every row with speed, error and reference', async () => {
    const { sweep, posted } = open(await load());
    const { scene, settings } = sweepPlan(sheet, { finest: 0, withSlow: false });
    const plan = { scene, settings: settings.slice(0, 5), duration_s: 0.1, repeats: 1 };
    sweep(plan);
    const { report } = posted.at(-1) as Sent<'sweepReport'>;
    expect(report.done).toBe(true);
    expect(report.rows).toHaveLength(5);
    for (const row of report.rows) {
      expect(row.status).toBe('ok');
      expect(row.reference.id).not.toBe('');
      expect(row.reference.converged).toBe(true);
      expect(row.ms_per_frame).toBeGreaterThan(0);
      expect(row.position_error_m).toBeGreaterThan(0);
      expect(settingOf(row, sheet).stepper).toBe(row.method.stepper);
      if (_name !== 'the stand-in') expect(row.commit).toMatch(/\S/);
    }
  });

  it('goes without a reference that cannot be read', async () => {
    const { send, posted, take, loaded } = open(await load());
    const [, buffer] = loaded.buffers;
    send({ type: 'setReference', bytes: new TextEncoder().encode('<html>').buffer });
    expect(posted).toEqual([]);
    const wanted = { wantsNumbers: true, scalar: 'distance' } as const;
    send({ type: 'step', count: 1, buffer, ...wanted });
    const frame = take('frame');
    expect(frame.scalar).toBe('distance');
    expect(frame.report?.numbers.reference).toBeNull();
    expect(frameViews(frame.buffer).scalar.every(Number.isNaN)).toBe(true);
  });

  it('drops a buffer of another mesh instead of writing beyond it', async () => {
    const { send, posted } = open(await load());
    send({ type: 'step', count: 1, wantsNumbers: false, buffer: new ArrayBuffer(16) });
    expect(posted).toEqual([]);
  });

  it('reads an OBJ file into a mesh that moves', async () => {
    const module = await load();
    const { send, take } = open(module);
    const { mesh } = (await read(module, 'two.obj', objText(false))) as ObjReadMessage;
    expect(mesh).toMatchObject({
      ...{ name: 'two.obj', isOwn: true, threads: 'down', groups: ['hem'] },
      ...{ nVertices: 4, nTriangles: 2, low: [0, 0, 0], high: [1, 1, 0] },
    });
    for (const hold of ['highest', 'nothing', 'group:hem'] as const) {
      const text = JSON.stringify(sceneOf({ ...presetSetting('obj'), hold }, mesh));
      send({ type: 'load', sceneText: text, keepMotion: false });
      const { buffers } = take('loaded');
      const [first, buffer] = buffers;
      send({ type: 'step', count: 3, wantsNumbers: true, buffer });
      const moved = frameViews(take('frame').buffer).positions;
      const [lowest, before] = [moved[4], frameViews(first).positions[4]];
      if (_name === 'the stand-in') continue;
      expect(before).toBe(0);
      if (hold === 'group:hem') expect(lowest).toBe(0);
      else expect(lowest).toBeLessThan(0);
    }
  });

  it('takes threads from texture coordinates, else downward, or along x on a flat mesh', async () => {
    const module = await load();
    const threadsOf = async (text: string) => {
      const { mesh } = (await read(module, 'two.obj', text)) as ObjReadMessage;
      return { threads: mesh.threads, cloth: JSON.parse(mesh.clothText) };
    };
    expect((await threadsOf(objText(false))).threads).toBe('down');
    const { threads, cloth } = await threadsOf(objText(true));
    expect(threads).toBe('along_x');
    if (_name === 'the stand-in') expect(cloth.mesh.warp_direction).toEqual([1, 0, 0]);
    else expect(cloth.mesh.warp_directions[1][0]).toBeCloseTo(1, 12);
    expect((await threadsOf(objText(true, true))).threads).toBe('texture');
  });

  it('names the line of a bad OBJ file', async () => {
    const bad = `${objText(false)}f 1 2\n`;
    const answer = await read(await load(), 'bad.obj', bad);
    const { failure } = answer as { failure: Failure };
    expect(failure).toMatchObject({ kind: 'input', where: 'bad.obj: line 8' });
    expect(failure.what).toContain('expected');
  });

  it('turns an exception into a refusal', async () => {
    const { send, take } = serve(await load());
    send({ type: 'reset' });
    expect(take('refused')).toMatchObject({ failure: { kind: 'internal' } });
  });
});

describe('motion-core', () => {
  it('reports a run that ended, with its reason', () => {
    const { send, take } = serve(createFakeModule().module);
    send({ type: 'open', fabricsText });
    take('ready');
    const fragile = JSON.stringify({ ...sceneOf(setting), name: 'fragile' });
    send({ type: 'load', sceneText: fragile, keepMotion: false });
    const [, buffer] = take('loaded').buffers;
    send({ type: 'step', count: 50, wantsNumbers: false, buffer });
    const frame = take('frame');
    expect(frame.hasEnded).toBe(true);
    expect(frame.report?.status).toBe('not_finite');
  });

  it('runs a sweep to its end, with growing rows', () => {
    const { sweep, posted } = serve(createFakeModule().module);
    sweep(sweepPlan(sheet, ALL_TO_1));
    const [planned, ...sent] = posted;
    expect(planned).toEqual({ type: 'planned', references: ['converged', 'own-0'] });
    const reports = sent.map((message) => (message as Sent<'sweepReport'>).report);
    expect(reports.map((report) => report.rows.length)).toEqual(
      Array.from({ length: 22 }, (_, index) => index + 1),
    );
    expect(reports.map((report) => report.done).indexOf(true)).toBe(21);
  });

  it('refuses a sweep with the reason of the module', () => {
    const { sweep, take } = serve(createFakeModule().module);
    const { scene } = sweepPlan(sheet, { finest: 0, withSlow: false });
    sweep({ scene, settings: [] });
    expect(take('refused').failure.where).toBe('/settings');
  });

  it('deletes every object of the module', async () => {
    const { module, alive } = createFakeModule();
    const { send, sweep, core } = serve(module);
    send({ type: 'open', fabricsText });
    send({ type: 'open', fabricsText });
    sweep(sweepPlan(sheet, ALL_TO_1));
    await read(module, 'two.obj', objText(false));
    expect(alive()).toBe(1);
    core.close();
    expect(alive()).toBe(0);
  });
});

describe('motion-core with a module that lacks CHOLMOD', () => {
  const { module } = createFakeModule({ hasCholmod: false });

  it('loads every preset with every stepper, and says what serves instead', () => {
    const { send, take } = open(module);
    for (const preset of PRESET_IDS) {
      for (const stepper of STEPPER_NAMES) {
        const text = JSON.stringify(sceneOf(withStepper(presetSetting(preset), stepper)));
        send({ type: 'load', sceneText: text, keepMotion: false });
        expect(take('loaded').summary.notes).toEqual(['Eigen serves.']);
      }
    }
  });

  it('sweeps with Eigen, in the reference and in projective, and its rows can be applied', () => {
    const { send, sweep, take, posted } = open(module);
    sweep(sweepPlan(sheet, ALL_TO_1));
    const { rows } = (posted.at(-1) as Sent<'sweepReport'>).report;
    expect(rows.every((row) => row.reference.description === 'implicit with eigen')).toBe(true);
    const projective = rows.filter((row) => row.method.stepper === 'projective');
    expect(projective.map((row) => row.method.solver)).toEqual([
      'eigen',
      'eigen',
      'eigen',
      'eigen',
    ]);
    posted.length = 0;
    for (const row of rows) {
      const text = JSON.stringify(sceneOf(settingOf(row, setting)));
      send({ type: 'load', sceneText: text, keepMotion: false });
      take('loaded');
    }
  });

  it('refuses what names CHOLMOD', () => {
    const { send, take } = open(module);
    const scene = sceneOf(withStepper(setting, 'projective'));
    const method = { ...(scene.method as object), solver: 'cholmod' };
    const text = JSON.stringify({ ...scene, method });
    send({ type: 'load', sceneText: text, keepMotion: false });
    expect(take('refused').failure.where).toBe('/method/solver');
  });

  it('has no option and no word that names it', () => {
    const words = JSON.stringify([STEPPERS, PRESETS]);
    expect(words.toLowerCase()).not.toContain('cholmod');
  });
});

const shippedFile = new URL('../../../assets/references/swinging_sheet.reference', import.meta.url);

describe('the WebAssembly module with a shipped reference', () => {
  const swinging = presetSetting('swinging-sheet');
  const textOf = (patch: Partial<Setting>) => JSON.stringify(sceneOf({ ...swinging, ...patch }));

  async function openReferred() {
    const server = serve(await loadFirst());
    const { send, take } = server;
    send({ type: 'open', fabricsText });
    take('ready');
    const loadWith = (patch: Partial<Setting>, keepMotion = false) => {
      send({ type: 'load', sceneText: textOf(patch), keepMotion, scalar: 'distance' });
      return take('loaded');
    };
    const step = (count: number, { buffers }: Sent<'loaded'>) => {
      const wanted = { wantsNumbers: true, scalar: 'distance' } as const;
      send({ type: 'step', count, buffer: buffers[1], ...wanted });
      const { report, buffer } = take('frame');
      return { reference: report?.numbers.reference, distances: frameViews(buffer).scalar };
    };
    const first = loadWith({});
    send({ type: 'setReference', bytes: Uint8Array.from(readFileSync(shippedFile)).buffer });
    const { reference } = take('referenceSet').numbers;
    return { ...server, loadWith, step, first, reference };
  }

  it('tells the distance, of each point and of all, and how well that is known', async () => {
    const { step, first, reference } = await openReferred();
    expect(reference).toMatchObject({ distance_m: 0, disturbed: false });
    const { reference: later, distances } = step(12, first);
    const distance = later?.distance_m ?? Number.NaN;
    expect(distance).toBeGreaterThan(0.001);
    expect(later?.uncertainty_m).toBeLessThan(0.1 * distance);
    expect(Math.max(...distances)).toBeGreaterThan(distance);
    expect(Math.min(...distances)).toBe(0); // no pin is off
  });

  it('grows as the step, for a method of first order', async () => {
    const { loadWith, step } = await openReferred();
    const distanceOf = (substeps: number) => {
      const newton = { ...withStepper(swinging, 'newton'), substeps };
      return step(3, loadWith(newton)).reference?.distance_m ?? Number.NaN;
    };
    const ratio = distanceOf(1) / distanceOf(4);
    expect(ratio).toBeGreaterThan(3.4);
    expect(ratio).toBeLessThan(4.6);
  });

  it('meets the same scene at any level and method, and no changed one', async () => {
    const { loadWith } = await openReferred();
    const meets = (patch: Partial<Setting>) => loadWith(patch).numbers.reference !== null;
    expect(meets({ level: 1 })).toBe(true);
    expect(meets(withStepper(swinging, 'xpbd'))).toBe(true);
    expect(meets({ fabric: 'silk' })).toBe(false);
    expect(meets({ model: 'membrane' })).toBe(false);
    expect(meets({ preset: 'curtain' })).toBe(false);
    expect(meets({})).toBe(true);
  });

  it('has no distance beyond its end', async () => {
    const { step, first } = await openReferred();
    const { reference, distances } = step(120, first);
    expect(reference).toMatchObject({ distance_m: null, disturbed: false });
    expect(reference?.end_s).toBeLessThan(2);
    expect(distances.every(Number.isNaN)).toBe(true);
  });

  it('has no distance for a cloth that a hand or another fabric moved, until a reset', async () => {
    const { send, take, loadWith, step, first } = await openReferred();
    send({ type: 'grab', vertex: 40 });
    expect(step(2, first).reference).toMatchObject({ distance_m: null, disturbed: true });
    send({ type: 'reset' });
    expect(take('loaded').numbers.reference).toMatchObject({ distance_m: 0, disturbed: false });
    step(5, loadWith({ fabric: 'silk' }));
    const back = loadWith({}, true);
    expect(back.numbers.reference).toMatchObject({ distance_m: null, disturbed: true });
    const finer = step(5, loadWith({ level: 1 }));
    expect(finer.reference?.disturbed).toBe(false);
    expect(loadWith({}, true).numbers.reference?.disturbed).toBe(false);
  });
});

describe('the cost of a step', () => {
  async function projectiveRun() {
    const module = await loadFirst();
    const simulation = new module.Simulation(fabricsText);
    const method = withStepper({ ...setting, level: 3 }, 'projective');
    simulation.load(JSON.stringify(sceneOf({ ...method, iterations: 1 })));
    simulation.step(1);
    const readNumbers = () => JSON.parse(simulation.numbers()) as RunNumbers;
    return { simulation, readNumbers };
  }

  it('is the wall time of the whole step, of which parts are a part', async () => {
    const { simulation, readNumbers } = await projectiveRun();
    const begin = performance.now();
    simulation.step(60);
    const clockMs = performance.now() - begin;
    const { steps_ms, steps_timed, parts_ms } = readNumbers();
    expect(steps_timed).toBe(60);
    expect(steps_ms).toBeLessThan(clockMs);
    expect(Object.values(parts_ms).reduce((sum, ms) => sum + ms, 0)).toBeLessThan(steps_ms);
  });

  it('leaves out the first step, which builds what the others keep', async () => {
    const { readNumbers } = await projectiveRun();
    expect(readNumbers()).toMatchObject({ steps_timed: 0, steps_ms: 0, parts_ms: {} });
  });
});

describe('the module', () => {
  it('binds exactly the classes and methods that the types name', async () => {
    expect(boundMethods(await loadModule())).toEqual(TYPED_METHODS);
  });
});
