// Captions of the view of modes against the computed modes of their bodies.
import { readFileSync } from 'node:fs';
import { beforeAll, describe, expect, it } from 'vitest';
import type { Energy, ModalModule } from '../../src/modes/bindings/modal-module';
import { energyMeaning, modesNote } from '../../src/modes/panels/mode-words';
import { RUBBER } from '../../src/modes/state/material';
import { enclosedVolume, mixInto, quietAmplitude, REACH } from '../../src/modes/state/mix';
import { BAR_SIDES_M, barEdge, modelOf } from '../../src/modes/state/models';
import {
  type FoundModes,
  initialModesState,
  type ModesState,
  usualLink,
} from '../../src/modes/state/modes-state';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { extentOf } from '../../src/shared/state/vectors';
import { loadModule } from '../support/built-module';

const N_MODES = 12;

const lengthOf = (values: ArrayLike<number>, at: number) =>
  Math.hypot(values[at] ?? 0, values[at + 1] ?? 0, values[at + 2] ?? 0);

/** The bar in the page's cubes, or another body that is opened so. */
function study(module: ModalModule, kind: 'bar' | 'sheet' | 'skirt' | 't_shirt') {
  const run = new module.ModalStudy(fabricsText);
  if (kind === 'bar') run.openBox(JSON.stringify({ sides_m: BAR_SIDES_M, cells: 3 }));
  else if (kind === 'skirt' || kind === 't_shirt')
    run.openObj(
      readFileSync(new URL(`../../../assets/meshes/${kind}.obj`, import.meta.url), 'utf8'),
    );
  else {
    const source = modelOf('sheet')?.source;
    run.openScene(source?.kind === 'scene' ? source.text : '');
  }
  const shape = run.shape().slice();
  const triangles = run.triangles().slice();
  return {
    shape,
    triangles,
    /** Moves of each mode, the farthest vertex by 1. */
    moves(energy: Energy): Float32Array[] {
      const wish = kind === 'bar' ? { volume: 'lattice', size_m: barEdge(3) } : { volume: 'auto' };
      const answer = JSON.parse(run.findModes(JSON.stringify({ energy, modes: N_MODES, ...wish })));
      expect(answer.ok).toBe(true);
      const all = run.moves().slice();
      return Array.from({ length: N_MODES }, (_, mode) =>
        all.slice(mode * shape.length, (mode + 1) * shape.length),
      );
    },
    end: () => run.delete(),
  };
}

/** Largest change of a distance straight across the bar, in shares of the farthest move. */
function squash(shape: Float64Array, move: Float32Array): number {
  const places = new Map<string, number>();
  const key = (x: number, y: number, z: number) => [x, y, z].map((v) => v.toFixed(4)).join();
  const [, low, deep] = [0, 1, 2].map((axis) =>
    Math.min(...shape.filter((_, k) => k % 3 === axis)),
  );
  for (let at = 0; at < shape.length; at += 3)
    places.set(key(shape[at] ?? 0, shape[at + 1] ?? 0, shape[at + 2] ?? 0), at);
  let most = 0;
  places.forEach((at) => {
    const [x = 0, y = 0, z = 0] = shape.subarray(at, at + 3);
    const across = (other: number | undefined, axis: number) =>
      other === undefined ? 0 : Math.abs((move[other + axis] ?? 0) - (move[at + axis] ?? 0));
    if (Math.abs(y - (low ?? 0)) < 1e-9)
      most = Math.max(most, across(places.get(key(x, y + BAR_SIDES_M[1], z)), 1));
    if (Math.abs(z - (deep ?? 0)) < 1e-9)
      most = Math.max(most, across(places.get(key(x, y, z + BAR_SIDES_M[2])), 2));
  });
  return most;
}

describe('the words of modes', { timeout: 120000 }, () => {
  let module: ModalModule;
  beforeAll(async () => {
    module = await loadModule();
  });
  const state = (patch: Partial<ModesState>): ModesState => ({
    ...initialModesState(usualLink('bar'), []),
    surface: { n_vertices: 8, n_triangles: 12, closed: true },
    ...patch,
  });

  it('say that a volume keeps its cross-section, and that some modes of its skin squash it', () => {
    expect(energyMeaning(state({}))).toMatch(
      /softest modes bend and twist .* leave its cross-section alone/,
    );
    expect(energyMeaning(state({ energy: 'surface' }))).toMatch(
      /some that squash the cross-section/,
    );
    expect(energyMeaning(state({ compares: true }))).toMatch(/Compare the last ones/);
    const bar = study(module, 'bar');
    const of = (energy: Energy) => bar.moves(energy).map((move) => squash(bar.shape, move));
    const [volume, surface] = [of('volume'), of('surface')];
    bar.end();
    expect(Math.max(...volume.slice(0, 6))).toBeLessThan(0.1);
    expect(Math.max(...surface)).toBeGreaterThan(3 * Math.max(...volume.slice(0, 6)));
    expect(Math.max(...surface)).toBeGreaterThan(0.15);
    expect(Math.max(...surface.slice(6))).toBeGreaterThan(Math.max(...surface.slice(0, 6)));
  });

  it('say that a large straight swing swells the body', () => {
    const found = { energy: 'volume', modes: [], rigid: 6, tets: 1 } satisfies FoundModes;
    expect(modesNote(found, state({}))).toMatch(
      /moves every point straight, so that a large swing swells/,
    );
    const bar = study(module, 'bar');
    const reach = REACH * extentOf(bar.shape);
    const rest = enclosedVolume(bar.shape, bar.triangles);
    const mixed = new Float64Array(bar.shape.length);
    const ratios = bar.moves('volume').map((move) => {
      mixInto(mixed, bar.shape, move, [1], reach);
      return enclosedVolume(mixed, bar.triangles) / rest;
    });
    expect(ratios.filter((ratio) => ratio > 1.05).length).toBeGreaterThan(N_MODES / 2);
    expect(
      quietAmplitude(
        bar.moves('volume')[0] ?? new Float32Array(0),
        bar.shape,
        bar.triangles,
        reach,
      ),
    ).toBeLessThan(1);
    bar.end();
  });

  it('say what the bar measures and is made of', () => {
    const { caption = '' } = modelOf('bar') ?? {};
    const [length, width, thickness] =
      /(\d+) cm long, (\d+) cm wide and (\d+) cm thick/.exec(caption)?.slice(1).map(Number) ?? [];
    expect([length, thickness, width]).toEqual(BAR_SIDES_M.map((side) => Math.round(100 * side)));
    expect(caption).toContain(`${RUBBER.young_pa / 1e6} MPa, ${RUBBER.density_kg_per_m3} kg/m³`);
  });

  it('say that bending costs a flat sheet least: its lowest modes bend it', () => {
    expect(modelOf('sheet')?.caption).toMatch(/lowest modes bend it/);
    const sheet = study(module, 'sheet');
    for (const move of [
      ...sheet.moves('volume').slice(0, 4),
      ...sheet.moves('surface').slice(0, 4),
    ]) {
      const out = Math.max(...move.filter((_, k) => k % 3 === 1).map(Math.abs));
      const within = Math.max(...move.filter((_, k) => k % 3 !== 1).map(Math.abs));
      expect(within / out).toBeLessThan(0.05);
    }
    sheet.end();
  });

  it('say that a skirt’s rim opens and closes first', () => {
    expect(modelOf('skirt')?.caption).toMatch(/its rim opens and closes before anything else/);
    const skirt = study(module, 'skirt');
    const [move = new Float32Array(0)] = skirt.moves('volume');
    const heights = skirt.shape.filter((_, k) => k % 3 === 1);
    const [low, high] = [Math.min(...heights), Math.max(...heights)];
    const farthest = heights.reduce(
      (best, y, vertex) => {
        const length = lengthOf(move, 3 * vertex);
        return length > best.length ? { length, y } : best;
      },
      { length: 0, y: high },
    );
    skirt.end();
    expect((farthest.y - low) / (high - low)).toBeLessThan(0.05);
  });

  it('say that a T-shirt’s second mode flattens its body and leaves the sleeves alone', () => {
    expect(modelOf('t-shirt')?.caption).toMatch(/second mode flattens the body and leaves the sl/);
    const shirt = study(module, 't_shirt');
    const { shape } = shirt;
    const half = Math.max(...shape.filter((_, k) => k % 3 === 0));
    for (const energy of ['volume', 'surface'] as const) {
      const move = shirt.moves(energy)[1] ?? new Float32Array(0);
      const meanOf = (isIn: (x: number, z: number) => boolean, of: (at: number) => number) => {
        const values = Array.from({ length: shape.length / 3 }, (_, vertex) => 3 * vertex)
          .filter((at) => isIn(shape[at] ?? 0, shape[at + 2] ?? 0))
          .map(of);
        return values.reduce((sum, value) => sum + value, 0) / values.length;
      };
      const isBody = (x: number) => Math.abs(x) < 0.4 * half;
      const along = (at: number) => move[at + 2] ?? 0;
      const front = meanOf((x, z) => isBody(x) && z > 0, along);
      const back = meanOf((x, z) => isBody(x) && z < 0, along);
      const far = (at: number) => lengthOf(move, at);
      const [body, sleeves] = [meanOf(isBody, far), meanOf((x) => Math.abs(x) > 0.6 * half, far)];
      expect(front * back, energy).toBeLessThan(0);
      expect(Math.min(Math.abs(front), Math.abs(back)) / body, energy).toBeGreaterThan(0.8);
      expect(sleeves / body, energy).toBeLessThan(0.1);
    }
    shirt.end();
  });
});
