// The worker of deformed cloth on its real module, with a clock and a schedule of the test's own.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import type { TermNumbers } from '../../src/fabrics/bindings/deform-module';
import { EXPERIMENTS } from '../../src/fabrics/state/experiments';
import { geometryOf } from '../../src/fabrics/state/fabric-geometry';
import { type Hold, holdAt, holdsOf, joined } from '../../src/fabrics/state/holds';
import { DeformCore } from '../../src/fabrics/worker/deform-core';
import type { DeformFrame, FromDeform, ToDeform } from '../../src/fabrics/worker/deform-protocol';
import { frameViews } from '../../src/shared/bindings/frame';
import { fabricNamed, fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';

/** A sheet that is pulled up in its middle, of so many vertices a side. */
const sceneText = (side = 9) => {
  const terms = EXPERIMENTS.find(({ id }) => id === 'terms');
  const scene = JSON.parse(terms?.text ?? '{}');
  scene.cloth.sheet.vertices = [side, side];
  return JSON.stringify(scene);
};

const weightsOf = (name: string) => geometryOf(fabricNamed(name)).recomputed;

/** A core whose turns are taken by `settle`, one after the other, and a page that gives buffers back. */
async function serve(nowMs = () => performance.now()) {
  const module = await loadModule();
  const posted: FromDeform[] = [];
  const grants: string[] = [];
  let isWoken = false;
  const keep = (message: FromDeform) =>
    message.type === 'granted' ? grants.push(message.what) : posted.push(message);
  const core = new DeformCore(module, keep, {
    later: () => {
      isWoken = true;
    },
    nowMs,
  });
  const send = (message: ToDeform) => core.receive(message);
  function take<Type extends FromDeform['type']>(type: Type): Extract<FromDeform, { type: Type }> {
    const message = posted.shift();
    if (message?.type !== type) throw new Error(`${type} expected: ${JSON.stringify(message)}`);
    return message as Extract<FromDeform, { type: Type }>;
  }
  /** Gives the core its turns until it asks for no more, and its buffers back; the last frames. */
  function settle(most = 10000): DeformFrame[] {
    const frames: DeformFrame[] = [];
    for (let turn = 0; isWoken && turn < most; ++turn) {
      isWoken = false;
      core.advance();
      while (posted[0]?.type === 'frame') {
        const frame = take('frame');
        const { cloth, pane } = frame;
        frames[pane] = { ...frame, buffer: frame.buffer.slice(0) };
        send({ type: 'return', cloth, pane, buffer: frame.buffer });
      }
    }
    return frames;
  }
  const positions = (frame: DeformFrame | undefined) =>
    frameViews(frame?.buffer ?? new ArrayBuffer(0)).positions;
  return { core, send, take, settle, positions, posted, grants };
}

/** Opened, held as the experiment is, with a pane for each of these fabrics. */
async function opened(fabrics = ['linen'], text = sceneText(), nowMs?: () => number) {
  const server = await serve(nowMs);
  server.send({ type: 'open', cloth: 1, fabricsText, sceneText: text, objText: '' });
  const { answer, triangles } = server.take('opened');
  const holds = holdsOf(answer, triangles);
  const hold = (of: Hold[]) => server.send({ type: 'hold', ...joined(of) });
  const show = (weights: TermNumbers[], form: 'consistent' | 'published' = 'consistent') =>
    server.send({ type: 'show', form, weights });
  hold(holds);
  show(fabrics.map(weightsOf));
  return { ...server, answer, triangles, holds, hold, show };
}

function distance(a: Float32Array, b: Float32Array): number {
  let most = 0;
  for (let k = 0; k < a.length; ++k) most = Math.max(most, Math.abs((a[k] ?? 0) - (b[k] ?? 0)));
  return a.length === b.length ? most : Number.POSITIVE_INFINITY;
}

const raised = (holds: Hold[], up: number) =>
  holds.map((hold): Hold => (hold.kind === 'handle' ? { ...hold, offset: [0, up, 0] } : hold));

describe('deform-core', () => {
  it('finds the shape of each pane, in which what is held is where it is held', async () => {
    const { settle, positions, holds } = await opened(['silk', 'linen']);
    const frames = settle();
    const { vertices, places } = joined(holds);
    for (const frame of frames) {
      expect(frame.status).toBe('converged');
      vertices.forEach((vertex, index) => {
        for (let axis = 0; axis < 3; ++axis)
          expect(positions(frame)[3 * vertex + axis]).toBeCloseTo(places[3 * index + axis] ?? 9, 6);
      });
    }
    expect(distance(positions(frames[0]), positions(frames[1]))).toBeGreaterThan(5e-3);
  });

  it('opens every experiment that the page offers', async () => {
    const { send, take } = await serve();
    for (const [index, { id, text }] of EXPERIMENTS.entries()) {
      const obj = JSON.parse(text).cloth.mesh?.obj?.replace(/^.*\//, '');
      const mesh = obj && new URL(`../../../assets/meshes/${obj}`, import.meta.url);
      const objText = mesh ? readFileSync(mesh, 'utf8') : '';
      send({ type: 'open', cloth: index + 1, fabricsText, sceneText: text, objText });
      const { answer } = take('opened');
      expect(answer.handles.length, id).toBeGreaterThan(0);
    }
  });

  it('follows a hand without more than the factor at hand, and ends where a rest would', async () => {
    const { settle, send, holds, positions } = await opened();
    settle();
    for (const up of [0.02, 0.04, 0.06]) {
      send({ type: 'move', places: joined(raised(holds, up)).places });
      expect(settle()[0]?.status).toBe('dragging');
    }
    send({ type: 'rest', isHeld: false });
    const there = positions(settle()[0]);
    const straight = await opened();
    straight.hold(raised(straight.holds, 0.06));
    expect(distance(there, straight.positions(straight.settle()[0]))).toBeLessThan(1e-5);
  });

  it('never shows more energy than before while nothing is moved', async () => {
    const { settle, send, holds } = await opened(['chiffon']);
    settle();
    send({ type: 'move', places: joined(raised(holds, 0.2)).places });
    send({ type: 'rest', isHeld: false });
    const energies = settle()[0]?.report.steps.map((step) => step.energy) ?? [];
    expect(energies.length).toBeGreaterThan(1);
    for (const [step, energy] of energies.entries())
      expect(energy).toBeLessThanOrEqual(energies[step - 1] ?? Number.POSITIVE_INFINITY);
  });

  it('goes out a hundred sheets and back to the same shape', async () => {
    const { settle, send, holds, positions } = await opened();
    const before = positions(settle()[0]);
    for (const up of [5, 46, 5, 0]) {
      send({ type: 'move', places: joined(raised(holds, up)).places });
      settle(3);
    }
    send({ type: 'rest', isHeld: false });
    expect(distance(before, positions(settle()[0]))).toBeLessThan(1e-5);
  });

  it('keeps the lower shape when a way from rest is given up', async () => {
    let clockMs = 0; // a turn is one step
    const nowMs = () => {
      clockMs += 100;
      return clockMs;
    };
    const { core, settle, send, posted, positions } = await opened(['linen'], sceneText(), nowMs);
    const there = positions(settle()[0]);
    send({ type: 'rest', isHeld: false });
    core.advance(); // the first way is at its end
    core.advance(); // one step from rest
    posted.length = 0;
    send({ type: 'section', pane: 0 });
    const [section] = posted;
    if (section?.type !== 'section')
      throw new Error(`section expected: ${JSON.stringify(section)}`);
    const kept = Float32Array.from(section.positions);
    expect(distance(there, kept)).toBeLessThan(1e-5);
  });

  it('keeps shapes through other weights, and starts anew in another form', async () => {
    const { settle, show, positions } = await opened(['linen']);
    const linen = positions(settle()[0]);
    show([weightsOf('silk')]);
    const silk = positions(settle()[0]);
    show([weightsOf('linen')]);
    expect(distance(linen, positions(settle()[0]))).toBeLessThan(1e-5);
    show([weightsOf('silk')], 'published');
    expect(distance(silk, positions(settle()[0]))).toBeGreaterThan(1e-4);
  });

  it('keeps a frame for want of buffers and sends the newest when one comes back', async () => {
    const { core, take, settle, send, holds, posted } = await opened();
    settle();
    const kept: DeformFrame[] = [];
    for (const up of [0.01, 0.02, 0.03]) {
      send({ type: 'move', places: joined(raised(holds, up)).places });
      core.advance();
      if (posted.length > 0) kept.push(take('frame'));
    }
    expect(kept.length).toBe(2);
    const [first] = kept;
    if (!first) throw new Error('no frame');
    send({ type: 'return', cloth: 1, pane: 0, buffer: first.buffer });
    const { positions } = frameViews(take('frame').buffer);
    const [vertex = 0] = holds.find(({ kind }) => kind === 'handle')?.vertices ?? [];
    expect(positions[3 * vertex + 1]).toBeCloseTo(0.13, 6);
  });

  it('refuses in a sentence what has no one shape, and goes on as it was', async () => {
    const { show, take, settle, hold, answer, grants } = await opened();
    expect(grants).toEqual(['hold', 'show']);
    settle();
    show([{ recovery: 0, stretch: 1, bending: 1 }]);
    settle();
    const corner = holdAt(answer, 0, 'pin', []);
    if (!corner) throw new Error('no corner');
    hold([]);
    expect(take('refused').failure.what).toMatch(/got none: the equations are singular/);
    show([{ recovery: 0, stretch: 0, bending: 0 }]);
    expect(take('refused')).toMatchObject({ failure: { kind: 'input' } });
    expect(grants).toEqual(['hold', 'show', 'show']);
  });

  it('refuses a bad mesh by its line and keeps the cloth', async () => {
    const { send, take, settle, holds } = await opened();
    settle();
    const text = JSON.stringify({ cloth: { mesh: { obj: 'torn.obj' } }, fabric: 'linen' });
    const objText = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n';
    send({ type: 'open', cloth: 2, fabricsText, sceneText: text, objText });
    expect(take('refused').failure.what).toMatch(/expected/);
    send({ type: 'move', places: joined(raised(holds, 0.05)).places });
    expect(settle()[0]).toMatchObject({ cloth: 1, status: 'dragging' });
  });

  it('fits a visitor’s measurements, and refuses those that are none', async () => {
    const { send, take, settle } = await opened();
    settle();
    const { measures } = geometryOf(fabricNamed('wool'));
    send({ type: 'fit', measures });
    const { answer } = take('fitted');
    const { recovery, stretch, bending } = answer.weights;
    expect(recovery + stretch + bending).toBeCloseTo(1, 9);
    expect(answer.clamped).toEqual([]);
    send({ type: 'fit', measures: { ...measures, stretch: 9 } });
    expect(take('fitted').answer.clamped).toEqual(['stretch']);
    send({ type: 'fit', measures: { ...measures, stretch: -1 } });
    expect(take('refused').failure.where).toBe('/stretch');
  });

  it('hands out what a motion starts from: the cloth at rest, its holds, and the shape', async () => {
    const { send, take, settle, positions, holds, answer } = await opened();
    const [frame] = settle();
    send({ type: 'section', pane: 0 });
    const { section, positions: start } = take('section');
    const { mesh } = section as { mesh: { positions_m: number[][]; groups: { held: number[] } } };
    expect(mesh.positions_m.flat()).toEqual(answer.rest_m);
    expect(mesh.groups.held).toEqual([...joined(holds).vertices]);
    expect(distance(Float32Array.from(start), positions(frame))).toBe(0);
  });
});
