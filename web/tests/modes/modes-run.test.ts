// The page's end of the worker of modes, with the real module in this thread.
import { beforeAll, describe, expect, it, vi } from 'vitest';
import type { ModalModule } from '../../src/modes/bindings/modal-module';
import { KeyEditor } from '../../src/modes/run/key-editor';
import type { StartModal } from '../../src/modes/run/modal-client';
import { ModesRun } from '../../src/modes/run/modes-run';
import { Pull } from '../../src/modes/run/pull';
import { farthestMove } from '../../src/modes/state/mix';
import { decodeModesLink } from '../../src/modes/state/modes-link';
import { initialModesState } from '../../src/modes/state/modes-state';
import { ModalCore } from '../../src/modes/worker/modal-core';
import type { FromModal, ToModal } from '../../src/modes/worker/modal-protocol';
import { inputFailure, sentenceOf } from '../../src/shared/bindings/answers';
import { objText } from '../../src/shared/panels/saving';
import { createStore } from '../../src/shared/state/store';
import { createAsked, type Port } from '../../src/shared/workers/asked';
import { loadModule } from '../support/built-module';
import { workerPort } from '../support/worker-port';

let module: ModalModule;

/** A view at a link, what it asked the worker for, and what it draws. */
async function open(hash: string) {
  const asked: ToModal['type'][] = [];
  const ports: Port[] = [];
  const start: StartModal = (listener) => {
    const port = workerPort<ToModal, FromModal>((post) => {
      const core = new ModalCore(module, post);
      return {
        receive(message) {
          asked.push(message.type);
          core.receive(message);
        },
        close: () => core.close(),
      };
    });
    ports.push(port);
    return createAsked(port, listener);
  };
  /** The newest worker ends, as when the browser ends it. */
  const kill = () => ports.at(-1)?.onmessage?.({ data: { broken: 'killed' } } as MessageEvent);
  const { link, problems } = decodeModesLink(hash);
  const store = createStore(initialModesState(link, problems));
  const drawn: { ghost: Float32Array | null; panes: number } = { ghost: null, panes: 0 };
  const run = new ModesRun(
    store,
    {
      showMesh: () => undefined,
      setPanes: (count) => {
        drawn.panes = count;
      },
      showShape: () => undefined,
      showGhost: (positions) => {
        drawn.ghost = positions;
      },
      framed: () => undefined,
    },
    start,
  );
  /** Waits until nothing is left to be answered. */
  const settled = async () => {
    let before = -1;
    await vi.waitUntil(
      async () => {
        const isQuiet = store.get().phase === 'ready' && before === asked.length;
        before = asked.length;
        return isQuiet;
      },
      { timeout: 20000, interval: 80 },
    );
  };
  run.openModel(link.model, link);
  await settled();
  return { run, store, asked, drawn, settled, kill, editor: new KeyEditor(run) };
}

const fileOf = (name: string, text: string) => new File([text], name);

describe('run of modes', () => {
  beforeAll(async () => {
    module = await loadModule();
  });

  it('opens the bar half way between its keys, with a ghost that is elsewhere', async () => {
    const { run, store, drawn } = await open('#view=modes&cells=2&show=keys');
    const { keys, completion, found, problem } = store.get();
    expect(problem).toBe(null);
    expect(keys.map(({ origin }) => origin.kind)).toEqual(['rest', 'bent']);
    expect(found?.modes.length).toBe(12);
    expect(completion?.frames.length).toBe(17);
    expect(farthestMove(run.shown.positions(0), drawn.ghost ?? [])).toBeGreaterThan(0.02);
    store.set({ ghost: false });
    expect(drawn.ghost).toBe(null);
  });

  it('changes one key without doing the others anew', async () => {
    const { run, store, asked, editor, settled } = await open('#view=modes&cells=2&mix=1:0.5');
    asked.length = 0;
    store.set({ chosenKey: 1 });
    editor.replace();
    await settled();
    expect(asked).toEqual(['replace']);
    const { keys, completion, time } = store.get();
    expect(keys[1]?.origin).toEqual({ kind: 'mix', energy: 'volume', amplitudes: [0.5] });
    expect(time).toBe(1);
    expect(farthestMove(run.shown.positions(0), keys[1]?.positions ?? [])).toBeLessThan(1e-6);
    expect(completion?.frames.length).toBe(17);
  });

  it('keeps a mix as a key behind the chosen one, and deletes it again', async () => {
    const { store, editor, settled, asked } = await open('#view=modes&cells=2');
    asked.length = 0;
    editor.keep();
    await settled();
    expect(store.get().keys.map(({ origin }) => origin.kind)).toEqual(['rest', 'mix', 'bent']);
    expect(store.get().completion?.frames.length).toBe(33);
    expect(asked).toEqual(['complete']);
    editor.delete();
    await settled();
    expect(store.get().keys.length).toBe(2);
    editor.delete();
    expect(store.get().keys.length).toBe(2); // two are the least
  });

  it('takes keys of the same vertices from files, and refuses others in a sentence', async () => {
    const { run, store, editor, settled } = await open('#view=modes&cells=2');
    const body = run.present;
    if (!body) throw new Error('no body');
    const sentence = () => sentenceOf(store.get().problem ?? inputFailure(''));
    const text = objText(
      Float32Array.from(body.shape, (x) => 1.1 * x),
      body.triangles,
    );
    await editor.openFiles([fileOf('large.obj', text)]);
    await settled();
    const { keys, completion } = store.get();
    expect(keys[1]?.origin).toEqual({ kind: 'file', name: 'large.obj' });
    expect(completion?.frames.length).toBe(33);
    await editor.openFiles([fileOf('other.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')]);
    expect(sentence()).toMatch(/^other\.obj: expected a key with the 258 vertices.*found 3$/);
    await editor.openFiles([fileOf('joined.obj', text.replace(/f \d+ /, 'f 200 '))]);
    expect(sentence()).toMatch(/^joined\.obj: expected a key whose triangles join the same/);
    await editor.openFiles([fileOf('bad.obj', text.replace('v ', 'v x '))]);
    expect(sentence()).toMatch(/^bad\.obj: line 1: /);
    expect(store.get().keys).toBe(keys);
  });

  it('goes back to the keys that could be filled in between', async () => {
    const { store, editor, settled } = await open('#view=modes&cells=2');
    const before = store.get();
    // A key without a finite place cannot come from the page's own checks.
    const [first] = before.keys;
    const broken = new Float64Array(first?.positions.length ?? 0).fill(Number.NaN);
    store.set({ keys: [...before.keys, { origin: { kind: 'rest' }, positions: broken }] });
    editor.delete();
    await settled();
    expect(store.get().problem?.what).toMatch(/finite/);
    expect(store.get().keys).toEqual(before.keys);
    expect(store.get().completion).toEqual(before.completion);
  });

  it('shows volume and surface side by side', async () => {
    const { run, store, drawn, settled } = await open('#view=modes&cells=2&show=modes&mix=5:1');
    expect(drawn.panes).toBe(1);
    await run.setEnergy('volume', true);
    await settled();
    expect(store.get().compares).toBe(true);
    expect(drawn.panes).toBe(2);
    expect(farthestMove(run.shown.positions(0), run.shown.positions(1))).toBeGreaterThan(0.01);
  });

  it('leads a pulled vertex to the hand, by modes or along the keys', async () => {
    const { run, store } = await open('#view=modes&cells=2&show=keys');
    const pull = new Pull(store, run, () => false);
    const body = run.present;
    if (!body) throw new Error('no body');
    const vertex = body.liveliest(store.get().keys, 'volume');
    const arc = store.get().keys[1]?.positions ?? new Float64Array(0);
    pull.grab(vertex, 0);
    const [x = 0, y = 0, z = 0] = arc.subarray(3 * vertex, 3 * vertex + 3);
    pull.move([x, y, z]);
    expect(store.get().time).toBe(1);
    store.set({ showing: 'modes' });
    const rest = [...body.shape.subarray(3 * vertex, 3 * vertex + 3)];
    pull.move([rest[0] ?? 0, (rest[1] ?? 0) + 0.05, rest[2] ?? 0]);
    pull.release();
    const at = [...run.shown.positions(0).subarray(3 * vertex, 3 * vertex + 3)];
    expect(at[1]).toBeCloseTo((rest[1] ?? 0) + 0.05, 3);
    expect(store.get().playing).toBe(false);
  });

  it('keeps the body when a file is bad', async () => {
    const { run, store, settled } = await open('#view=modes&cells=2');
    const before = run.present;
    await run.openObj(fileOf('torn.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n'));
    await settled();
    expect(store.get().problem?.where).toMatch(/torn\.obj: line 4/);
    expect(store.get().model).toBe('bar');
    expect(run.present).toBe(before);
    expect(store.get().completion?.frames.length).toBe(17);
  });

  it('is as it was when a volume cannot carry it, and says why', async () => {
    const { run, store, settled } = await open('#view=modes&model=sheet');
    const before = store.get();
    await run.reopen({ volume: 'lattice' });
    await settled();
    const { volume, found, completion, problem } = store.get();
    expect(problem?.what).toMatch(/expected a closed surface/);
    expect({ volume, found }).toEqual({ volume: 'auto', found: before.found });
    expect(completion?.frames.length).toBe(17);
  });

  it('gives up keys that take long, and has those before', async () => {
    const { run, store, editor, settled } = await open('#view=modes&cells=2');
    editor.keep();
    expect(store.get().keys.length).toBe(3);
    store.set({ working: 'Filling in between the keys' });
    run.cancel();
    await settled();
    const { working, keys, completion, problem } = store.get();
    expect({ working, problem }).toEqual({ working: null, problem: null });
    expect(keys.map(({ origin }) => origin.kind)).toEqual(['rest', 'bent']);
    expect(completion?.frames.length).toBe(17);
  });

  it('gives up a body that takes long, and has the one before', async () => {
    const { run, store, settled } = await open('#view=modes&cells=2&mix=3:0.5');
    run.openModel('sheet');
    await vi.waitUntil(() => store.get().model === 'sheet', { interval: 1 });
    expect(store.get().found).toBe(null);
    store.set({ working: 'Finding the modes' });
    run.cancel();
    await settled();
    const { model, found, amplitudes, keys } = store.get();
    expect({ model, amplitudes }).toEqual({ model: 'bar', amplitudes: [0, 0, 0.5] });
    expect(found?.modes.length).toBe(12);
    expect(keys.length).toBe(2);
  });

  it('goes on with another worker where its own has ended', async () => {
    const { store, kill, settled } = await open('#view=modes&cells=2&mix=3:0.5');
    kill();
    await settled();
    const { amplitudes, keys, found, completion, problem } = store.get();
    expect(problem?.what).toMatch(/ended by itself \(killed\)\. It was started again\.$/);
    expect(amplitudes).toEqual([0, 0, 0.5]);
    expect(keys.map(({ origin }) => origin.kind)).toEqual(['rest', 'bent']);
    expect(found?.modes.length).toBe(12);
    expect(completion?.frames.length).toBe(17);
  });

  it('says so where two workers end in a row, and tries again when it is asked to', async () => {
    const { run, store, kill, settled } = await open('#view=modes&cells=2');
    kill();
    kill();
    expect(store.get().phase).toBe('broken');
    expect(store.get().problem?.what).toMatch(/That happened twice/);
    run.retry();
    await settled();
    expect(store.get().problem).toBe(null);
    expect(store.get().found?.modes.length).toBe(12);
  });
});
