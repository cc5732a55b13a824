// The picture of the view of modes and what lies on it, all of one store.
import { createInvitation } from '../shared/panels/invitation';
import { openStage } from '../shared/panels/open-stage';
import { type Store, watch } from '../shared/state/store';
import { columnsFor, createEnergyBadges, type EnergyBadges } from './panels/energy-badges';
import type { Hands } from './run/hands';
import type { ModesRun } from './run/modes-run';
import { shownEnergies } from './run/showing';
import { createModesStage, type ModesStage } from './stage/modes-stage';
import type { ModesState } from './state/modes-state';

export class Picture {
  stage: ModesStage | null = null;
  private badges: EnergyBadges | null = null;
  private readonly invitation;
  private nPanes = 1;

  constructor(
    private readonly box: HTMLElement,
    private readonly store: Store<ModesState>,
  ) {
    this.invitation = createInvitation(box);
  }

  /** Opens the stage where the browser can draw it. */
  open(canvas: HTMLCanvasElement, hands: Hands): void {
    const { store, box } = this;
    this.stage = openStage(canvas, store, (pictureLost) =>
      createModesStage(box, canvas, {
        key: (name) => hands.key(name),
        grab: (vertex, pane) => hands.pull.grab(vertex, pane),
        moveGrab: (target) => hands.pull.move(target),
        releaseGrab: () => hands.pull.release(),
        drawn: ({ x, y }) => this.invitation.place(x, y),
        pictureLost,
      }),
    );
    this.badges = createEnergyBadges(box, store, shownEnergies, (energy) => hands.volumeOf(energy));
    new ResizeObserver(() => this.layOut()).observe(box);
    watch(store, ['edges'], ({ edges }) => this.stage?.setEdges(edges));
    watch(store, ['invited', 'phase', 'playing'], ({ invited, phase, playing }) =>
      this.invitation.setShown(invited && phase === 'ready' && !playing),
    );
  }

  setPanes(count: number): void {
    if (count === this.nPanes) return;
    this.nPanes = count;
    this.layOut();
  }

  private layOut(): void {
    const nColumns = columnsFor(this.nPanes, this.box.clientWidth);
    this.stage?.setPanes(this.nPanes, nColumns);
    this.badges?.setColumns(nColumns);
  }
}

/** Modes whose full swings the camera sees; higher ones go no farther. */
const SEEN_MODES = 4;

/** Has the camera see the body, its keys and its full swings. */
export function frame(stage: ModesStage, { keys, energy }: ModesState, run: ModesRun): void {
  const body = run.present;
  if (!body) return;
  const places: number[] = [];
  const swing = new Float64Array(body.shape.length);
  for (let mode = 0; mode < SEEN_MODES; ++mode)
    for (const amplitude of [-1, 1]) {
      body.mix(swing, energy, [...new Array<number>(mode).fill(0), amplitude]);
      for (const place of swing) places.push(place);
    }
  stage.frame([...body.shape, ...keys.flatMap(({ positions }) => [...positions])], places);
  stage.invite(body.liveliest(keys, energy));
}
