// What the worker of deformed cloth does with each message, as a function of the module, of where
// answers go, and of the clock. The only file that calls delete() on its objects.
import { describe, internalFailure, read } from '../../shared/bindings/answers';
import { FLOATS_PER_VERTEX, frameViews } from '../../shared/bindings/frame';
import {
  type ClothAnswer,
  type DeformationHandle,
  type DeformModule,
  type DeformReport,
  type FitAnswer,
  PROGRESS,
} from '../bindings/deform-module';
import type {
  DeformPost,
  DeformStatus,
  FromDeform,
  ShowMessage,
  ToDeform,
} from './deform-protocol';

/** Work for one pane before the next one, or a message, gets its turn [ms]. */
const DRAG_SLICE_MS = 16;
const SETTLE_SLICE_MS = 30;

/** As the core's own cap: a shape that is not found by then is reported as not converged. */
const MOST_LINEARISATIONS = 15;

export interface Turns {
  /** Has `advance` called once what is waiting has had its turn. */
  later(): void;
  nowMs(): number;
}

/**
 * What a pane is at: following the hand, on its way to the least energy from the shape at hand,
 * about to go back to rest, on its way from there to see if that ends lower, or done.
 */
type Stage = 'following' | 'here' | 'at_rest' | 'from_rest' | 'done';

interface Pane {
  stage: Stage;
  /** It has not been anywhere but at rest. */
  isFresh: boolean;
  /** A second way, from rest, may end lower. */
  triesRest: boolean;
  /** What holds it has moved since. */
  isBehind: boolean;
  /** It has work to do; while following, until the factor at hand leads no further. */
  isBusy: boolean;
  nLinearisations: number;
  converged: boolean;
  updateMs: number;
  /** Its shape has not been sent for want of a buffer. */
  isUnsent: boolean;
  buffers: ArrayBuffer[];
}

/** Serves one page. Call `receive` with each message, `advance` when told to, `close` at the end. */
export function createDeformCore(
  module: DeformModule,
  post: DeformPost,
  turns: Turns,
): { receive(message: ToDeform): void; advance(): void; close(): void } {
  let deformation: DeformationHandle | null = null;
  let cloth = -1;
  let nVertices = 0;
  let held: Int32Array = new Int32Array(0);
  let panes: Pane[] = [];
  let next = 0; // the pane whose turn it is
  let isWaiting = false; // for its turn

  type Refusable = Extract<FromDeform, { type: 'refused' }>['what'];

  /** The payload of an answer, or null when it was refused, which is told. */
  function granted<Payload>(what: Refusable, text: string): Payload | null {
    const answer = read<Payload>(text);
    if (answer.ok) return answer;
    post({ type: 'refused', what, failure: answer }, []);
    return null;
  }

  function wake(): void {
    if (isWaiting || !panes.some((pane) => pane.isBusy)) return;
    isWaiting = true;
    turns.later();
  }

  function statusOf(pane: Pane): DeformStatus {
    if (pane.stage === 'following') return 'dragging';
    if (pane.stage !== 'done') return 'settling';
    return pane.converged ? 'converged' : 'not_converged';
  }

  function send(run: DeformationHandle, index: number): void {
    const pane = panes[index];
    const buffer = pane?.buffers.pop();
    if (!pane) return;
    pane.isUnsent = buffer === undefined;
    if (!buffer) return;
    const report = read<DeformReport>(run.report(index));
    if (!report.ok) return;
    frameViews(buffer).positions.set(run.positions(index));
    const { updateMs } = pane;
    post({ type: 'frame', cloth, pane: index, buffer, status: statusOf(pane), report, updateMs }, [
      buffer,
    ]);
  }

  /** Steps until the slice is over; false when there is nothing left to do in this way. */
  function stepFor(run: DeformationHandle, index: number, pane: Pane, endMs: number): boolean {
    do {
      const mayLinearise = pane.stage !== 'following';
      const progress = run.step(index, mayLinearise);
      pane.converged = progress === PROGRESS.converged;
      if (progress === PROGRESS.converged || progress === PROGRESS.stuck) return false;
      if (progress === PROGRESS.linearised) pane.nLinearisations += 1;
      if (mayLinearise && pane.nLinearisations >= MOST_LINEARISATIONS) return false;
    } while (turns.nowMs() < endMs);
    return true;
  }

  /** The way from here is at its end. */
  function endStage(run: DeformationHandle, index: number, pane: Pane): void {
    pane.nLinearisations = 0;
    if (pane.stage === 'here' && pane.triesRest && !pane.isFresh) {
      pane.stage = 'at_rest';
      return;
    }
    if (pane.stage === 'from_rest') keepBetter(run, index, pane);
    pane.isBusy = false;
    pane.isFresh = false;
    if (pane.stage !== 'following') pane.stage = 'done';
  }

  function keepBetter(run: DeformationHandle, index: number, pane: Pane): void {
    run.keepBetter(index);
    const report = read<DeformReport>(run.report(index));
    pane.converged = report.ok && report.converged;
  }

  function work(run: DeformationHandle, index: number, pane: Pane): void {
    const beginMs = turns.nowMs();
    const isFollowing = pane.stage === 'following';
    if (pane.isBehind) {
      pane.updateMs = 0;
      if (pane.isFresh && !isFollowing) run.restart(index);
      else run.follow(index);
      pane.isBehind = false;
    }
    if (pane.stage === 'at_rest') {
      run.tryFromRest(index);
      pane.stage = 'from_rest';
    }
    const sliceMs = isFollowing ? DRAG_SLICE_MS : SETTLE_SLICE_MS;
    const goesOn = stepFor(run, index, pane, beginMs + sliceMs);
    const wasOnTrial = pane.stage === 'from_rest';
    if (!goesOn) endStage(run, index, pane);
    pane.updateMs += turns.nowMs() - beginMs;
    // The way from rest is not shown: only where it ends may be better.
    if (!wasOnTrial || pane.stage === 'done') send(run, index);
  }

  /** Whoever is on the way from rest goes on from the better of both shapes. */
  function endTrials(run: DeformationHandle): void {
    panes.forEach((pane, index) => {
      if (pane.stage !== 'from_rest') return;
      keepBetter(run, index, pane);
      pane.stage = 'here';
    });
  }

  /** Every pane has something new to do, from the shape that it has. */
  function begin(stage: 'following' | 'here', isMoved: boolean, triesRest = true): void {
    if (deformation) endTrials(deformation);
    for (const pane of panes) {
      pane.stage = stage;
      pane.triesRest = triesRest;
      pane.isBusy = true;
      pane.isBehind = pane.isBehind || isMoved;
      pane.nLinearisations = 0;
    }
    wake();
  }

  function open(message: Extract<ToDeform, { type: 'open' }>): void {
    deformation ??= new module.Deformation(message.fabricsText);
    const answer = granted<ClothAnswer>(
      'open',
      deformation.open(message.sceneText, message.objText),
    );
    if (!answer) return;
    cloth = message.cloth;
    nVertices = answer.n_vertices;
    held = new Int32Array(0);
    panes = [];
    const triangles = deformation.triangles().slice();
    post({ type: 'opened', cloth, answer, triangles }, [triangles.buffer]);
  }

  function freshPane(): Pane {
    const nBytes = 4 * FLOATS_PER_VERTEX * nVertices;
    return {
      stage: 'here',
      isFresh: true,
      triesRest: true,
      isBehind: true,
      isBusy: true,
      nLinearisations: 0,
      converged: false,
      updateMs: 0,
      isUnsent: false,
      buffers: [new ArrayBuffer(nBytes), new ArrayBuffer(nBytes)],
    };
  }

  function show(run: DeformationHandle, { form, weights }: ShowMessage): void {
    endTrials(run); // what they would be compared by changes
    const answer = granted<{ fresh: boolean[] }>(
      'show',
      run.show(JSON.stringify({ form, weights })),
    );
    if (!answer) return;
    post({ type: 'granted', what: 'show' }, []);
    const known = panes;
    panes = answer.fresh.map((isFresh, index) => {
      const pane = known[index] ?? freshPane();
      return isFresh ? { ...freshPane(), buffers: pane.buffers } : { ...pane, updateMs: 0 };
    });
    next = 0;
    begin('here', false);
  }

  function hold(run: DeformationHandle, vertices: Int32Array, places: Float64Array): void {
    if (granted('hold', run.hold(vertices, places)) === null) return;
    post({ type: 'granted', what: 'hold' }, []);
    held = vertices;
    begin('here', true);
  }

  function move(run: DeformationHandle, places: Float64Array): void {
    if (places.length !== 3 * held.length) return; // of an earlier hold
    run.moveHeld(places);
    begin('following', true);
  }

  function takeBack({ pane: index, buffer }: Extract<ToDeform, { type: 'return' }>): void {
    const pane = panes[index];
    if (!pane || !deformation) return;
    pane.buffers.push(buffer);
    if (pane.isUnsent) send(deformation, index);
  }

  function postSection(run: DeformationHandle, index: number): void {
    const answer = granted<{ cloth: object }>('section', run.clothSection());
    if (!answer) return;
    const positions = run.exactPositions(index).slice();
    post({ type: 'section', section: answer.cloth, positions }, [positions.buffer]);
  }

  function handle(message: ToDeform): void {
    if (message.type === 'open') return open(message);
    if (!deformation) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'show':
        return show(deformation, message);
      case 'hold':
        return hold(deformation, message.vertices, message.places);
      case 'move':
        return move(deformation, message.places);
      case 'rest':
        return begin('here', false, !message.isHeld);
      case 'return':
        if (message.cloth === cloth) takeBack(message);
        return;
      case 'fit': {
        const { measures } = message;
        const answer = granted<FitAnswer>('fit', deformation.fitMeasures(JSON.stringify(measures)));
        if (answer) post({ type: 'fitted', measures, answer }, []);
        return;
      }
      case 'section':
        return postSection(deformation, message.pane);
    }
  }

  function fail(what: Refusable, error: unknown): void {
    post({ type: 'refused', what, failure: internalFailure(describe(error)) }, []);
  }

  return {
    receive(message) {
      try {
        handle(message);
      } catch (error) {
        const isAnswered = ['open', 'show', 'hold', 'fit', 'section'].includes(message.type);
        fail(isAnswered ? (message.type as Refusable) : 'step', error);
      }
    },
    advance() {
      isWaiting = false;
      const run = deformation;
      for (let tried = 0; run && tried < panes.length; ++tried) {
        const index = next % panes.length;
        const pane = panes[index];
        next = (index + 1) % panes.length;
        if (!pane?.isBusy) continue;
        try {
          work(run, index, pane);
        } catch (error) {
          pane.isBusy = false;
          fail('step', error);
        }
        break;
      }
      wake();
    },
    close() {
      deformation?.delete();
      deformation = null;
    },
  };
}
