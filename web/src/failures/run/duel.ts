// Plays both sides of a case in step.

import type { Collider } from '../../shared/bindings/geometry';
import type { Store } from '../../shared/state/store';
import { InStep, type InStepParts, type InStepView } from '../../shared/workers/in-step';
import type { FrameMessage } from '../../shared/workers/motion-protocol';
import { caseNamed, SIDES, type Side, STEP_S, sceneTextOf } from '../state/failure-cases';
import { type FailuresState, freshSides, type SideState } from '../state/failures-state';

/** The picture of a duel. */
export interface DuelView extends InStepView {
  setColliders(colliders: Collider[]): void;
  /** Shows all of what begins. */
  frame(colliders: Collider[]): void;
  /** Goes with what stands in a pane. */
  follow(pane: number): void;
}

function sideAfter(before: SideState, { report, hasEnded }: FrameMessage, msPerStep: number) {
  if (!report) return before;
  const { numbers, message } = report;
  return {
    warnings: numbers.warnings,
    ended: hasEnded ? { sentence: message, timeS: numbers.time_s } : null,
    stretch: numbers.largest_stretch,
    msPerStep,
  };
}

export class Duel {
  private readonly both: InStep;

  constructor(
    private readonly store: Store<FailuresState>,
    private readonly view: DuelView,
    parts?: InStepParts,
  ) {
    const shown = () => caseNamed(store.get().caseId);
    const piece = {
      sceneTexts: () => SIDES.map((side) => sceneTextOf(shown(), side)),
      stepS: STEP_S,
      endS: () => shown().endS,
      begun: ([start]: readonly { colliders: Collider[] }[], isNew: boolean) =>
        this.begin(start?.colliders ?? [], isNew),
      stepped: (frames: readonly (FrameMessage | null)[], msPerStep: readonly number[]) =>
        this.receive(frames, msPerStep),
    };
    this.both = new InStep(store, view, piece, parts);
    store.subscribe((state, previous) => {
      if (state.caseId !== previous.caseId) this.both.open();
    });
    this.both.open();
  }

  play(): void {
    this.both.play();
  }

  pause(): void {
    this.both.pause();
  }

  step(): void {
    this.both.step();
  }

  reset(): Promise<void> {
    return this.both.reset();
  }

  private begin(colliders: Collider[], isNew: boolean): void {
    this.view.setColliders(colliders);
    if (isNew) this.view.frame(colliders);
    this.follow();
    this.store.set({ sides: freshSides() });
  }

  private receive(frames: readonly (FrameMessage | null)[], msPerStep: readonly number[]): void {
    const sides = { ...this.store.get().sides };
    frames.forEach((frame, pane) => {
      const side: Side | undefined = SIDES[pane];
      if (frame && side) sides[side] = sideAfter(sides[side], frame, msPerStep[pane] ?? 0);
    });
    const colliders = frames[SIDES.indexOf('ours')]?.colliders;
    if (colliders) this.view.setColliders(colliders);
    this.follow();
    this.store.set({ sides });
  }

  private follow(): void {
    if (caseNamed(this.store.get().caseId).isFollowed) this.view.follow(SIDES.indexOf('ours'));
  }
}
