// Plays both sides of a case in step, with a hand that pulls one of them beyond its end.
import type { Collider, Triple } from '../../shared/bindings/geometry';
import type { Store } from '../../shared/state/store';
import {
  InStep,
  type InStepParts,
  type InStepView,
  type Piece,
} from '../../shared/workers/in-step';
import type { FrameMessage } from '../../shared/workers/motion-protocol';
import type { SideRun, SideStart } from '../../shared/workers/side-run';
import { caseNamed, type FailureCase, SIDES, STEP_S, sceneTextOf } from '../state/failure-cases';
import { type FailuresState, freshSides } from '../state/failures-state';
import { sideAfter } from './side-reading';

const OURS = SIDES.indexOf('ours');

const WORDS = {
  again: 'It was started again, and both cloths are back at their start.',
  twice: 'That happened twice.',
};

/** The picture of a duel. */
export interface DuelView extends InStepView {
  setColliders(colliders: Collider[]): void;
  /** Shows all of what begins. */
  frame(colliders: Collider[]): void;
  /** Goes with what stands in a pane. */
  follow(pane: number): void;
}

type Frames = readonly (FrameMessage | null)[];

export class Duel {
  private readonly both: InStep;
  private held: SideRun | null = null;
  private isPulled = false; // a hand took the cloth since it began

  constructor(
    private readonly store: Store<FailuresState>,
    private readonly view: DuelView,
    parts?: InStepParts,
  ) {
    const piece: Piece = {
      sceneTexts: () => SIDES.map((side) => sceneTextOf(this.shownCase(), side)),
      stepS: STEP_S,
      endS: () => (this.isPulled ? Number.POSITIVE_INFINITY : this.shownCase().endS),
      words: WORDS,
      lostPhase: 'broken',
      begun: (starts, isNew) => this.begin(starts, isNew),
      stepped: (frames, msPerStep) => this.readAll(frames, msPerStep),
      passed: (pane, frame) => this.read(pane, frame),
    };
    this.both = new InStep(store, view, piece, parts);
    store.subscribe((state, previous) => {
      if (state.caseId === previous.caseId) return;
      // A problem of the case before tells nothing of this one.
      const problem = state.problem === previous.problem ? null : state.problem;
      store.set({ sides: freshSides(), timeS: 0, problem });
      this.retry();
    });
    this.retry();
  }

  play = () => this.both.play();
  pause = () => this.both.pause();
  step = () => this.both.step();
  reset = () => this.both.reset();
  showAt = (timeS: number) => this.both.showAt(timeS);

  /** Opens the case, by other workers where there are none. */
  retry(): void {
    if (this.store.get().phase === 'broken') this.store.set({ problem: null });
    this.store.set({ speed: this.shownCase().speed ?? 1 });
    this.both.open();
  }

  /** A hand takes the cloth of a pane: it moves, for as long as it is let. */
  grab(vertex: number, pane: number): void {
    if (this.store.get().phase !== 'ready') return;
    this.isPulled = true;
    this.held = this.both.side(pane) ?? null;
    this.held?.grab(vertex);
    if (!this.store.get().playing) this.play();
  }

  moveGrab(target: Triple): void {
    this.held?.moveGrab(target);
  }

  releaseGrab(): void {
    this.held?.releaseGrab();
    this.held = null;
  }

  private shownCase(): FailureCase {
    return caseNamed(this.store.get().caseId);
  }

  private begin([first]: readonly SideStart[], isNew: boolean): void {
    const colliders = first?.colliders ?? [];
    this.view.setColliders(colliders);
    if (isNew) this.view.frame(colliders);
    this.follow();
    this.held = null;
    this.isPulled = false;
    this.store.set({ sides: freshSides() });
  }

  /** Reads a frame of a side; its steps took so long each [ms], or as long as before. */
  private read(pane: number, frame: FrameMessage, msPerStep?: number): void {
    const measure = this.isPulled ? undefined : this.shownCase().measure;
    const { sides } = this.store.get();
    const side = SIDES[pane];
    if (!side) return;
    const after = sideAfter(sides[side], frame, msPerStep ?? sides[side].msPerStep, measure);
    this.store.set({ sides: { ...sides, [side]: after } });
  }

  private readAll(frames: Frames, msPerStep: readonly number[]): void {
    frames.forEach((frame, pane) => {
      if (frame) this.read(pane, frame, msPerStep[pane]);
    });
    const colliders = frames[OURS]?.colliders;
    if (colliders) this.view.setColliders(colliders);
    this.follow();
  }

  private follow(): void {
    if (this.shownCase().isFollowed) this.view.follow(OURS);
  }
}
