// Answers each message to the worker of deformed cloth, as a function of the module, of where
// answers go, and of the clock. The only file that calls delete() on its objects.

import { granted, read } from '../../shared/bindings/answers';
import { FLOATS_PER_VERTEX, frameViews } from '../../shared/bindings/frame';
import { refusalOf } from '../../shared/bindings/refusals';
import { ModuleCore, type Post } from '../../shared/workers/serve';
import {
  type ClothAnswer,
  type DeformationHandle,
  type DeformModule,
  type DeformReport,
  type FitAnswer,
  PROGRESS,
  WAY,
} from '../bindings/deform-module';
import type { DeformFrame, FromDeform, ShowMessage, ToDeform } from './deform-protocol';

/** Work for one pane before the next one, or a message, gets its turn [ms]. */
const DRAG_SLICE_MS = 16;
const SETTLE_SLICE_MS = 30;

export interface Turns {
  /** Has `advance` called once what is waiting has had its turn. */
  later(): void;
  nowMs(): number;
}

/**
 * State of a pane: following the hand, about to settle, on its way to the least energy, on its
 * way there from rest to see if that ends lower, or done.
 */
type Stage = 'following' | 'to_settle' | 'from_here' | 'from_rest' | 'done';

interface Pane {
  stage: Stage;
  /** It has not been anywhere but at rest. */
  isFresh: boolean;
  /** A second way, from rest, may end lower. */
  triesRest: boolean;
  /** True when its holds have moved since. */
  isBehind: boolean;
  /** It has work to do; while following, until the factor at hand leads no further. */
  isBusy: boolean;
  updateMs: number;
  /** Its shape has not been sent for want of a buffer. */
  isUnsent: boolean;
  buffers: ArrayBuffer[];
}

/** Serves one page. Call `receive` with each message, `advance` when told to, `close` at the end. */
export class DeformCore extends ModuleCore<DeformModule, ToDeform, FromDeform> {
  private deformation: DeformationHandle | null = null;
  private cloth = -1;
  private nVertices = 0;
  private held: Int32Array = new Int32Array(0);
  private panes: Pane[] = [];
  private next = 0; // the pane whose turn it is
  private isWaiting = false; // its turn is asked for

  constructor(
    module: DeformModule,
    post: Post<FromDeform>,
    private readonly turns: Turns,
  ) {
    super(module, post);
  }

  private wake(): void {
    if (this.isWaiting || !this.panes.some((pane) => pane.isBusy)) return;
    this.isWaiting = true;
    this.turns.later();
  }

  private statusOf(pane: Pane, report: DeformReport): DeformFrame['status'] {
    if (pane.stage === 'following') return 'dragging';
    if (pane.stage !== 'done') return 'settling';
    return report.converged ? 'converged' : 'not_converged';
  }

  private send(run: DeformationHandle, index: number): void {
    const pane = this.panes[index];
    const buffer = pane?.buffers.pop();
    if (!pane) return;
    pane.isUnsent = buffer === undefined;
    if (!buffer) return;
    const report = read<DeformReport>(run.report(index));
    if (!report.ok) return;
    frameViews(buffer).positions.set(run.positions(index));
    const { updateMs } = pane;
    this.post(
      {
        type: 'frame',
        cloth: this.cloth,
        pane: index,
        buffer,
        status: this.statusOf(pane, report),
        report,
        updateMs,
      },
      [buffer],
    );
  }

  /** True while the same way goes on. */
  private stepAfterHand(run: DeformationHandle, index: number, pane: Pane): boolean {
    pane.isBusy = run.step(index) === PROGRESS.moved;
    if (!pane.isBusy) pane.isFresh = false;
    return pane.isBusy;
  }

  /** True while the same way goes on. */
  private settle(run: DeformationHandle, index: number, pane: Pane): boolean {
    if (pane.stage === 'to_settle') run.beginSettling(index, pane.triesRest && !pane.isFresh);
    const way = run.settle(index);
    pane.stage = way === WAY.fromRest ? 'from_rest' : 'from_here';
    if (way !== WAY.done) return way !== WAY.between;
    pane.stage = 'done';
    pane.isBusy = false;
    pane.isFresh = false;
    return false;
  }

  private work(run: DeformationHandle, index: number, pane: Pane): void {
    const beginMs = this.turns.nowMs();
    const isFollowing = pane.stage === 'following';
    if (pane.isBehind) {
      pane.updateMs = 0;
      if (pane.isFresh && !isFollowing) run.restart(index);
      else run.follow(index);
      pane.isBehind = false;
    }
    const endMs = beginMs + (isFollowing ? DRAG_SLICE_MS : SETTLE_SLICE_MS);
    const goesOn = isFollowing
      ? () => this.stepAfterHand(run, index, pane)
      : () => this.settle(run, index, pane);
    while (goesOn() && this.turns.nowMs() < endMs);
    pane.updateMs += this.turns.nowMs() - beginMs;
    // The way from rest is not shown: only where it ends may be better.
    if (pane.stage !== 'from_rest') this.send(run, index);
  }

  /** Every pane has something new to do, from the shape that it has. */
  private begin(stage: 'following' | 'to_settle', isMoved: boolean, triesRest = true): void {
    for (const pane of this.panes) {
      pane.stage = stage;
      pane.triesRest = triesRest;
      pane.isBusy = true;
      pane.isBehind = pane.isBehind || isMoved;
    }
    this.wake();
  }

  private open(message: Extract<ToDeform, { type: 'open' }>): void {
    this.deformation ??= new this.module.Deformation(message.fabricsText);
    const text = this.deformation.open(message.sceneText, message.objText);
    const answer = granted<ClothAnswer>(text);
    this.cloth = message.cloth;
    this.nVertices = answer.n_vertices;
    this.held = new Int32Array(0);
    this.panes = [];
    const triangles = this.deformation.triangles().slice();
    this.post({ type: 'opened', cloth: this.cloth, answer, triangles }, [triangles.buffer]);
  }

  private freshPane(): Pane {
    const nBytes = 4 * FLOATS_PER_VERTEX * this.nVertices;
    return {
      stage: 'to_settle',
      isFresh: true,
      triesRest: true,
      isBehind: true,
      isBusy: true,
      updateMs: 0,
      isUnsent: false,
      buffers: [new ArrayBuffer(nBytes), new ArrayBuffer(nBytes)],
    };
  }

  private show(run: DeformationHandle, { form, weights }: ShowMessage): void {
    const { fresh } = granted<{ fresh: boolean[] }>(run.show(JSON.stringify({ form, weights })));
    this.post({ type: 'granted', what: 'show' }, []);
    const known = this.panes;
    this.panes = fresh.map((isFresh, index) => {
      const pane = known[index] ?? this.freshPane();
      return isFresh ? { ...this.freshPane(), buffers: pane.buffers } : { ...pane, updateMs: 0 };
    });
    this.next = 0;
    this.begin('to_settle', false);
  }

  private hold(run: DeformationHandle, vertices: Int32Array, places: Float64Array): void {
    granted(run.hold(vertices, places));
    this.post({ type: 'granted', what: 'hold' }, []);
    this.held = vertices;
    this.begin('to_settle', true);
  }

  private move(run: DeformationHandle, places: Float64Array): void {
    if (places.length !== 3 * this.held.length) return; // places of an earlier hold
    run.moveHeld(places);
    this.begin('following', true);
  }

  private takeBack({ pane: index, buffer }: Extract<ToDeform, { type: 'return' }>): void {
    const pane = this.panes[index];
    if (!pane || !this.deformation) return;
    pane.buffers.push(buffer);
    if (pane.isUnsent) this.send(this.deformation, index);
  }

  private postSection(run: DeformationHandle, index: number): void {
    const { cloth: section } = granted<{ cloth: object }>(run.clothSection());
    const positions = run.exactPositions(index).slice();
    this.post({ type: 'section', section, positions }, [positions.buffer]);
  }

  protected handle(message: ToDeform): void {
    if (message.type === 'open') return this.open(message);
    if (!this.deformation) throw new Error(`${message.type} before open`);
    switch (message.type) {
      case 'show':
        return this.show(this.deformation, message);
      case 'hold':
        return this.hold(this.deformation, message.vertices, message.places);
      case 'move':
        return this.move(this.deformation, message.places);
      case 'rest':
        return this.begin('to_settle', false, !message.isHeld);
      case 'return':
        if (message.cloth === this.cloth) this.takeBack(message);
        return;
      case 'fit': {
        const { measures } = message;
        const answer = granted<FitAnswer>(this.deformation.fitMeasures(JSON.stringify(measures)));
        this.post({ type: 'fitted', measures, answer }, []);
        return;
      }
      case 'section':
        return this.postSection(this.deformation, message.pane);
    }
  }

  advance(): void {
    this.isWaiting = false;
    const run = this.deformation;
    for (let tried = 0; run && tried < this.panes.length; ++tried) {
      const index = this.next % this.panes.length;
      const pane = this.panes[index];
      this.next = (index + 1) % this.panes.length;
      if (!pane?.isBusy) continue;
      try {
        this.work(run, index, pane);
      } catch (error) {
        pane.isBusy = false;
        this.post(refusalOf(error), []);
      }
      break;
    }
    this.wake();
  }

  close(): void {
    this.deformation?.delete();
    this.deformation = null;
  }
}
