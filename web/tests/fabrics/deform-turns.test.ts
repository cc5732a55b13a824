// The order in which the worker of deformed cloth calls a module that only keeps a record of the calls.
import { describe, expect, it } from 'vitest';
import {
  type DeformationHandle,
  type DeformModule,
  PROGRESS,
  WAY,
} from '../../src/fabrics/bindings/deform-module';
import { DeformCore } from '../../src/fabrics/worker/deform-core';
import type { DeformFrame, FromDeform, ToDeform } from '../../src/fabrics/worker/deform-protocol';

const ok = (payload: object = {}) => JSON.stringify({ ok: true, ...payload });
const ONES = { recovery: 1, stretch: 1, bending: 1 };

/** Answers of `settle`, one after the other from `beginSettling` on. */
type Ways = (keyof typeof WAY)[];

/** Takes two steps after a hand; on its way to the least energy it answers `ways`. */
function recorder(ways: Ways) {
  const calls: string[] = [];
  let nSteps = 0;
  let isShown = false;
  const called = (name: string, answer = ok()) => {
    calls.push(name);
    nSteps = 0;
    return answer;
  };
  class Recorded implements DeformationHandle {
    open = () =>
      ok({ n_vertices: 1, rest_m: [0, 0, 0], pins: [], handles: [], groups: [], name: 'point' });
    show(text: string) {
      const fresh = JSON.parse(text).weights.map(() => !isShown);
      isShown = true;
      return called('show', ok({ fresh }));
    }
    hold = () => ok();
    moveHeld = () => undefined;
    follow = (pane: number) => called(`follow ${pane}`);
    step(pane: number) {
      calls.push(`step ${pane}`);
      nSteps += 1;
      return nSteps < 2 ? PROGRESS.moved : PROGRESS.ended;
    }
    restart = (pane: number) => called(`restart ${pane}`);
    beginSettling = (pane: number, triesRest: boolean) =>
      called(`begin ${pane}${triesRest ? ', rest too' : ''}`);
    settle(_pane: number) {
      const way = ways[nSteps] ?? 'done';
      nSteps += 1;
      calls.push(way);
      return WAY[way];
    }
    report = () => ok({ weights: ONES, energy: 0, terms: ONES, converged: true, steps: [] });
    fitMeasures = () => ok();
    clothSection = () => ok();
    triangles = () => new Uint32Array(0);
    positions = () => new Float32Array(3);
    exactPositions = () => new Float64Array(3);
    delete = () => undefined;
  }
  return { calls, module: { Deformation: Recorded } as DeformModule };
}

/**
 * A core whose clock goes on by so much at each look: while it stands still, a slice ends where a
 * stage does. Turns come at once.
 */
function serve(nPanes: number, ways: Ways, msPerLook = 0) {
  const { calls, module } = recorder(ways);
  const frames: DeformFrame[] = [];
  let isWoken = false;
  let clockMs = 0;
  const nowMs = () => {
    clockMs += msPerLook;
    return clockMs;
  };
  const later = () => {
    isWoken = true;
  };
  const post = (message: FromDeform) => {
    if (message.type !== 'frame') return;
    calls.push(message.status);
    frames.push(message);
  };
  const core = new DeformCore(module, post, { later, nowMs });
  /** Calls and pictures of so many turns after a message. */
  function send(message: ToDeform, nTurns = 100): string[] {
    core.receive(message);
    for (let turn = 0; isWoken && turn < nTurns; ++turn) {
      isWoken = false;
      core.advance();
      for (const { cloth, pane, buffer } of frames.splice(0))
        core.receive({ type: 'return', cloth, pane, buffer });
    }
    return calls.splice(0);
  }
  const [vertices, places] = [Int32Array.from([0]), new Float64Array(3)];
  send({ type: 'open', cloth: 1, fabricsText: '', sceneText: '', objText: '' });
  send({ type: 'hold', vertices, places });
  const show = () => send({ type: 'show', form: 'consistent', weights: Array(nPanes).fill(ONES) });
  return { first: show(), show, move: () => send({ type: 'move', places }), send };
}

const ALONE: Ways = ['fromHere', 'done'];
const BOTH: Ways = ['fromHere', 'between', 'fromRest', 'done'];

describe('the turns of deformed cloth', () => {
  it('come from rest at first, and once only', () => {
    const { first } = serve(1, ALONE);
    expect(first).toEqual(['show', 'restart 0', 'begin 0', 'fromHere', 'done', 'converged']);
  });

  it('leave matrices to the move itself while a hand moves', () => {
    const { move } = serve(1, ALONE);
    expect(move()).toEqual(['follow 0', 'step 0', 'step 0', 'dragging']);
  });

  it('try the way from rest too once a hand has let go, and show where the first way ends', () => {
    const { move, send } = serve(1, BOTH);
    move();
    expect(send({ type: 'rest', isHeld: false })).toEqual([
      'begin 0, rest too',
      'fromHere',
      'between',
      'settling',
      'fromRest',
      'done',
      'converged',
    ]);
  });

  it('show nothing of a long way from rest but its end', () => {
    const { move, send } = serve(1, ['between', 'fromRest', 'fromRest', 'done'], 50);
    move();
    expect(send({ type: 'rest', isHeld: false })).toEqual([
      'begin 0, rest too',
      'between',
      'settling',
      'fromRest',
      'fromRest',
      'done',
      'converged',
    ]);
  });

  it('stay on the way at hand while the hand only rests', () => {
    const { move, send } = serve(1, ALONE);
    move();
    expect(send({ type: 'rest', isHeld: true })).toEqual([
      'begin 0',
      'fromHere',
      'done',
      'converged',
    ]);
  });

  it('settle anew when something else changes on the way from rest', () => {
    const { move, send, show } = serve(1, ['between', 'fromRest', 'fromRest', 'done'], 50);
    move();
    expect(send({ type: 'rest', isHeld: false }, 3)).toContain('fromRest');
    expect(show().slice(0, 2)).toEqual(['show', 'begin 0, rest too']);
  });

  it('go around the panes', () => {
    const { move } = serve(3, ALONE);
    expect(move().filter((call) => call.startsWith('follow'))).toEqual([
      'follow 0',
      'follow 1',
      'follow 2',
    ]);
  });
});
