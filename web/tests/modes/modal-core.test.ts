// The worker of modes on its real module, against what is known of bars, keys and cloth.
import { beforeAll, describe, expect, it } from 'vitest';
import type { ModalModule, VolumeWish } from '../../src/modes/bindings/modal-module';
import { bent, DRAPE_FRAMES } from '../../src/modes/state/key-shapes';
import { beamHz, modeNumbers } from '../../src/modes/state/material';
import { enclosedVolume, farthestMove } from '../../src/modes/state/mix';
import { BAR_SIDES_M, barEdge, MODELS } from '../../src/modes/state/models';
import { ModalCore } from '../../src/modes/worker/modal-core';
import type { FromModal, ToModal } from '../../src/modes/worker/modal-protocol';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';

/** First root of cos x cosh x = 1: a beam that nothing holds. */
const FREE = 4.730041;

const BAR_TEXT = (cells: number) => JSON.stringify({ sides_m: BAR_SIDES_M, cells });

function wishFor(cells: 2 | 3 | 4, modes = 12): VolumeWish {
  return { volume: 'lattice', modes, size_m: barEdge(cells) };
}

/** A core and its answers, each taken by its type. */
function serve(module: ModalModule) {
  const posted: FromModal[] = [];
  const core = new ModalCore(module, (message) => posted.push(message));
  function ask<Type extends FromModal['type']>(
    type: Type,
    message: ToModal,
  ): Extract<FromModal, { type: Type }> {
    core.receive(message);
    const answer = posted.shift();
    if (answer?.type !== type) throw new Error(`${type} expected: ${JSON.stringify(answer)}`);
    return answer as Extract<FromModal, { type: Type }>;
  }
  const openBar = (cells: number) =>
    ask('opened', { type: 'open', fabricsText, opened: { kind: 'box', text: BAR_TEXT(cells) } });
  const openCloth = () => {
    const source = MODELS.find(({ id }) => id === 'cloth')?.source;
    const text = source?.kind === 'scene' ? source.text : '';
    const opened = { kind: 'scene', text, frames: DRAPE_FRAMES, stepsEach: 2 } as const;
    return ask('opened', { type: 'open', fabricsText, opened });
  };
  return { ask, openBar, openCloth };
}

function joined(...keys: Float64Array[]): Float64Array {
  return Float64Array.from(keys.flatMap((key) => [...key]));
}

describe('modal core', () => {
  let module: ModalModule;
  beforeAll(async () => {
    module = await loadModule();
  });

  it('gives a closed bar six rigid motions and the first frequency of a beam, to 10 %', () => {
    const { ask, openBar } = serve(module);
    const { answer } = openBar(4);
    expect(answer.closed).toBe(true);
    const found = ask('modes', { type: 'modes', energy: 'volume', wish: wishFor(4) });
    expect(found.answer.rigid).toBe(6);
    const [length, thickness] = BAR_SIDES_M;
    const beam = ((FREE / length) ** 2 / (2 * Math.PI)) * thickness * Math.sqrt(1e6 / (12 * 1000));
    expect(beamHz(length, thickness)).toBeCloseTo(beam, 9);
    const hz = modeNumbers(found.answer.stiffness, 'volume', true)[0]?.hz ?? 0;
    expect(Math.abs(hz / beam - 1)).toBeLessThan(0.1);
  });

  it('moves the farthest vertex of each mode by 1', () => {
    const { ask, openBar } = serve(module);
    const { shape } = openBar(2);
    for (const energy of ['volume', 'surface'] as const) {
      const { moves } = ask('modes', { type: 'modes', energy, wish: wishFor(2) });
      expect(moves.length).toBe(12 * shape.length);
      const still = new Float64Array(shape.length);
      for (let mode = 0; mode < 12; ++mode) {
        const move = moves.subarray(mode * shape.length, (mode + 1) * shape.length);
        expect(farthestMove(move, still)).toBeCloseTo(1, 5);
      }
    }
  });

  it('meets its keys to 1e-9, keeps the volume of a bent bar within 2 %, and halves fairly', () => {
    const study = new module.ModalStudy(fabricsText);
    study.openBox(BAR_TEXT(3));
    const straight = study.shape().slice();
    const arc = bent(straight, 180);
    study.complete(joined(straight, arc), JSON.stringify({ keys: 2, ...wishFor(3) }));
    const { frames } = JSON.parse(study.fillIn(17));
    const filled = study.filled();
    expect(farthestMove(filled.subarray(0, straight.length), straight)).toBeLessThan(1e-9);
    expect(farthestMove(filled.subarray(-straight.length), arc)).toBeLessThan(1e-9);
    const rest = frames[0].volume_m3;
    expect(rest).toBeCloseTo(1.2 * 0.12 * 0.24, 9);
    for (const frame of frames) {
      expect(Math.abs(frame.volume_m3 / rest - 1)).toBeLessThan(0.02);
      expect(frame.unequal_halves).toBeLessThan(0.01);
    }
    expect(frames[8].straight_volume_m3 / rest).toBeLessThan(0.85);
    expect(frames[8].straight_strain).toBeGreaterThan(2 * frames[8].strain);
    // The drawn mesh is the surface of that volume.
    const middle = filled.slice(8 * straight.length, 9 * straight.length);
    const drawn = enclosedVolume(middle, study.triangles());
    expect(Math.abs(drawn / rest - 1)).toBeLessThan(0.02);
    study.delete();
  });

  it('takes another shape for a key with the modes that it has', () => {
    const { ask, openBar } = serve(module);
    const { shape } = openBar(2);
    const keys = joined(shape, bent(shape, 180));
    const wish = wishFor(2);
    ask('completed', { type: 'complete', keys, nKeys: 2, wish, frames: 9 });
    const other = bent(shape, 90);
    const { filled, shares } = ask('completed', {
      type: 'replace',
      index: 1,
      positions: other,
      frames: 9,
    });
    expect(farthestMove(filled.subarray(-shape.length), other)).toBeLessThan(1e-6);
    expect(shares?.length).toBe(6 + wish.modes);
  });

  it('shares of the first modes climb, and most of a bend is in a few', () => {
    const { ask, openBar } = serve(module);
    const { shape } = openBar(3);
    const keys = joined(shape, bent(shape, 90));
    const { shares } = ask('completed', {
      type: 'complete',
      keys,
      nKeys: 2,
      wish: wishFor(3),
      frames: 9,
    });
    const known = shares ?? [];
    known.slice(1).forEach((share, index) => {
      expect(share).toBeGreaterThanOrEqual(known[index] ?? 1);
    });
    expect(known.at(-1)).toBeLessThanOrEqual(1);
    expect(known.at(-1)).toBeGreaterThan(0.95);
    expect(known[5]).toBeLessThan(0.6);
  });

  it('finds the draped cloth at rest: every mode swings, and its corners stay', () => {
    const { ask, openCloth } = serve(module);
    const { answer, shape, drape } = openCloth();
    expect(drape.length).toBe(DRAPE_FRAMES * shape.length);
    expect(farthestMove(drape.subarray(0, shape.length), shape)).toBeGreaterThan(0.2);
    const found = ask('modes', {
      type: 'modes',
      energy: 'cloth',
      wish: { volume: 'auto', modes: 12 },
    });
    expect(found.answer.rigid).toBe(0);
    expect(Math.min(...found.answer.stiffness)).toBeGreaterThan(0);
    const pins = answer.pins ?? [];
    expect(pins.length).toBe(2);
    for (const pin of pins)
      expect([...found.moves.subarray(3 * pin, 3 * pin + 3)]).toEqual([0, 0, 0]);
    const { shares } = ask('shares', { type: 'drapeShares', drape, count: 12 });
    expect(shares.length).toBe(12);
    expect(shares[11]).toBeGreaterThan(shares[0] ?? 1);
  });

  it('says in a sentence what cannot be, and keeps what it had', () => {
    const { ask, openBar } = serve(module);
    const { shape } = openBar(2);
    const open = (text: string) =>
      ask('refused', { type: 'open', fabricsText, opened: { kind: 'obj', text } }).failure;
    expect(open('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n')).toMatchObject({ kind: 'input' });
    const many = ask('refused', {
      type: 'modes',
      energy: 'surface',
      wish: { volume: 'auto', modes: 100000 },
    });
    expect(many.failure.what).toMatch(/expected 1 to \d+ modes/);
    const one = ask('refused', {
      type: 'complete',
      keys: shape,
      nKeys: 1,
      wish: wishFor(2),
      frames: 9,
    });
    expect(one.failure.what).toMatch(/two keys or more/);
    ask('modes', { type: 'modes', energy: 'volume', wish: wishFor(2) });
  });

  it('refuses cubes for an open surface', () => {
    const { ask } = serve(module);
    const text = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n';
    ask('opened', { type: 'open', fabricsText, opened: { kind: 'obj', text } });
    const { failure } = ask('refused', {
      type: 'modes',
      energy: 'volume',
      wish: { volume: 'lattice', modes: 3 },
    });
    expect(failure.kind).toBe('input');
    expect(failure.what).toMatch(/open|closed/);
  });
});
