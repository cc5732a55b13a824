// The three panes of a garment, which show one time: what each loads, how it gets to a frame, and its numbers.
import { frameViews } from '../../shared/bindings/frame';
import type { IsCurrent } from '../../shared/state/latest';
import type { Store } from '../../shared/state/store';
import type { SolidsAnswer } from '../bindings/refinement-module';
import { FRAME_S } from '../state/garment-frames';
import type { PlanFile } from '../state/plan-file';
import {
  comparedPanes,
  EMPTY_PANE,
  type FineFloor,
  type FrameSource,
  type GarmentPane,
  type PaneId,
  type RefinementState,
  showsFineCloth,
} from '../state/refinement-state';
import type { Advance, Described, GarmentMesh, GarmentScalar } from '../worker/garment-protocol';
import type { RecordingHead } from '../worker/recording';
import type { GarmentClient } from './garment-client';
import { createPaneRun, type PaneRun } from './garment-pane';
import { contentOf, floorOf } from './pane-content';
import type { FetchBytes } from './scene-files';

/** A run without records ends here [s]. */
const LONGEST_S = 10;

export interface ShownFrame {
  pane: PaneId;
  buffer: ArrayBuffer;
}

export interface TrioView {
  showMesh(pane: PaneId, mesh: GarmentMesh): void;
  /** Frames of one time. Buffers stay valid until the next call. */
  showFrames(frames: ShownFrame[], solids: SolidsAnswer | null): void;
}

/** The functions by which panes start their workers and fetch files. */
export interface PaneParts {
  start(onBroken: (reason: string) => void): GarmentClient;
  fetchBytes: FetchBytes;
}

function scalarOf({ colour }: RefinementState): GarmentScalar | null {
  return colour === 'curvature' || colour === 'distance' ? colour : null;
}

export class PaneSet {
  private readonly runs = new Map<PaneId, PaneRun>();
  /** The frame that is shown. */
  private at = 0;
  /** The computed panes show samples of the fine one, and start anew when they play. */
  private isPreview = false;

  constructor(
    private readonly store: Store<RefinementState>,
    private readonly view: TrioView,
    private readonly parts: PaneParts,
    /** Hears that the worker of a pane has ended. */
    private readonly broken: (reason: string) => void,
  ) {}

  private run(id: PaneId): PaneRun {
    const known = this.runs.get(id);
    if (known) return known;
    const client = this.parts.start((reason) => {
      if (this.runs.get(id) === run) this.broken(reason);
    });
    const run = createPaneRun(id, client, this.parts.fetchBytes);
    this.runs.set(id, run);
    return run;
  }

  /** Ends all workers; what is asked next is asked of others, which have nothing loaded. */
  renew(): void {
    for (const run of this.runs.values()) run.end();
    this.runs.clear();
  }

  private get fine(): PaneRun {
    return this.run('fine');
  }

  /** The panes that are in step, fine last; the other rival rests as it was. */
  private get panes(): PaneRun[] {
    return comparedPanes(this.store.get()).map((id) => this.run(id));
  }

  private get others(): PaneRun[] {
    return this.panes.filter((pane) => pane !== this.fine);
  }

  /** Any worker has answered. */
  hasStarted(): boolean {
    return [...this.runs.values()].some((run) => run.isLoaded());
  }

  isLoaded(): boolean {
    return this.panes.every((pane) => pane.isLoaded());
  }

  isComputed(): boolean {
    return this.panes.some(({ source }) => source === 'computed');
  }

  isAtEnd(): boolean {
    return this.at >= this.endFrame();
  }

  endFrame(): number {
    const lengths = this.panes.map(
      (pane) => pane.recording()?.n_frames ?? Number.POSITIVE_INFINITY,
    );
    return Math.min(...lengths, 1 + Math.round(LONGEST_S / FRAME_S)) - 1;
  }

  /** The time that is shown [s]. */
  timeS(): number {
    return this.at * FRAME_S;
  }

  /** The panes that compute what was to come with the page, and why. */
  missed(): { panes: PaneId[]; reason: string } | null {
    const panes = this.panes.filter((pane) => pane.missed() !== null);
    const reason = panes[0]?.missed() ?? null;
    return reason === null ? null : { panes: panes.map(({ id }) => id), reason };
  }

  async load(plan: PlanFile, isCurrent: IsCurrent): Promise<void> {
    const [floor] = await Promise.all([
      this.fetchFloor(),
      ...this.panes.map((pane) => this.loadPane(pane, plan, isCurrent)),
    ]);
    if (!isCurrent()) return;
    this.store.set({ floor });
    const { computeFine } = this.store.get();
    for (const pane of this.panes) {
      const isResting = pane === this.fine && !computeFine;
      pane.source = pane.recording() ? 'recorded' : isResting ? 'resting' : 'computed';
    }
    this.isPreview = false;
  }

  /** The first picture: where the link says if frames come with the page, else at the beginning. */
  async start(isCurrent: IsCurrent): Promise<void> {
    const first = Math.min(this.startFrame(), this.endFrame());
    const isComputed = this.isComputed();
    this.isPreview = isComputed && this.fine.source === 'recorded';
    for (const pane of this.panes) this.set(pane.id, { source: this.shownSource(pane) });
    await this.showAnew(isComputed && !this.isPreview ? 0 : first, isCurrent);
  }

  /** Everything anew, and then at that frame, to which nothing is computed; the numbers follow. */
  async restart(frame: number, isCurrent: IsCurrent): Promise<void> {
    await this.showAnew(frame, isCurrent);
    await this.describe(true, isCurrent);
  }

  /** Another time, to which nothing has to be computed. */
  async seek(timeS: number, isCurrent: IsCurrent): Promise<void> {
    this.at = Math.max(0, Math.min(this.endFrame(), Math.round(timeS / FRAME_S)));
    await this.advance(({ source }) => (source === 'recorded' ? 'recorded' : 'still'), isCurrent);
    await this.describe(false, isCurrent);
  }

  /** Leaves the samples, if they are what is shown: the panes are computed from the beginning. */
  async leavePreview(isCurrent: IsCurrent): Promise<boolean> {
    if (!this.isPreview) return false;
    this.isPreview = false;
    await this.restart(0, isCurrent);
    return true;
  }

  /** Goes on by some frames, by one at most when they are computed. Why a run ended, or null. */
  goOn(nFrames: number, isCurrent: IsCurrent): Promise<string | null> {
    this.at = Math.min(this.endFrame(), this.at + (this.isComputed() ? 1 : nFrames));
    const how = ({ source }: PaneRun): Advance => {
      if (source === 'recorded') return 'recorded';
      return source === 'computed' ? 'stepped' : 'still';
    };
    return this.advance(how, isCurrent);
  }

  /** The shown time in all panes, with numbers where they are due. */
  async describe(wantsNumbers: boolean, isCurrent: IsCurrent): Promise<void> {
    const { panes } = this;
    const last = await this.describePane(this.fine, null, wantsNumbers);
    const isInStep = this.fine.source !== 'resting';
    const fine = isInStep
      ? { places: frameViews(last.buffer).positions.slice(), folds: last.folds }
      : null;
    const answers = await Promise.all(
      this.others.map((pane) => this.describePane(pane, fine, wantsNumbers)),
    );
    if (!isCurrent()) return;
    const shown = panes.map((pane, index) => ({ pane, described: answers[index] ?? last }));
    if (wantsNumbers) for (const { pane, described } of shown) this.tell(pane, described);
    this.view.showFrames(
      shown.map(({ pane, described }) => ({ pane: pane.id, buffer: described.buffer })),
      answers[0]?.solids ?? null,
    );
    for (const { pane, described } of shown) pane.keep(described);
    this.store.set({ timeS: this.timeS() });
  }

  private async showAnew(frame: number, isCurrent: IsCurrent): Promise<void> {
    this.store.set({ fit: null });
    await Promise.all(this.panes.map((pane) => pane.reset()));
    if (!isCurrent()) return;
    this.at = frame;
    await this.advance(({ source }) => (source === 'recorded' ? 'recorded' : 'still'), isCurrent);
    await this.describe(false, isCurrent);
  }

  private isPreviewOf(pane: PaneRun): boolean {
    return this.isPreview && pane.source === 'computed';
  }

  /** A pane that shows the fine one's shape. */
  private isSampled(pane: PaneRun): boolean {
    if (pane === this.fine) return false;
    return this.isPreviewOf(pane) || showsFineCloth(this.store.get());
  }

  private shownSource(pane: PaneRun): FrameSource {
    return this.isPreviewOf(pane) ? 'sampled' : pane.source;
  }

  private set(id: PaneId, patch: Partial<GarmentPane>): void {
    const { panes } = this.store.get();
    this.store.set({ panes: { ...panes, [id]: { ...panes[id], ...patch } } });
  }

  private async loadPane(pane: PaneRun, plan: PlanFile, isCurrent: IsCurrent): Promise<void> {
    const loaded = await pane.load(contentOf(pane.id, this.store.get(), plan));
    if (!loaded || !isCurrent()) return;
    this.view.showMesh(pane.id, loaded.mesh);
    const nVertices = loaded.summary.n_vertices;
    const msPerFrame = loaded.recording?.ms_per_frame ?? null;
    const { source } = this.store.get().panes[pane.id];
    this.set(pane.id, { ...EMPTY_PANE, source, nVertices, msPerFrame });
    await this.showEarly(pane, loaded.recording, isCurrent);
  }

  /** The recorded frame that a pane will start with, before the other panes are there. */
  private async showEarly(
    pane: PaneRun,
    recording: RecordingHead | null,
    isCurrent: IsCurrent,
  ): Promise<void> {
    if (!recording) return;
    const frame = Math.min(this.startFrame(), recording.n_frames - 1);
    await pane.advance(frame, 'recorded');
    const described = await pane.describe({
      scalar: null,
      reference: null,
      fineFolds: null,
      takesSample: false,
      timeS: frame * FRAME_S,
      wantsFaults: false,
      wantsSurface: false,
    });
    if (!isCurrent()) return;
    this.view.showFrames([{ pane: pane.id, buffer: described.buffer }], described.solids);
    pane.keep(described);
  }

  /** How far apart two fine runs are; null where nobody measured it, or it cannot be fetched. */
  private async fetchFloor(): Promise<FineFloor | null> {
    const url = floorOf(this.store.get());
    const bytes = url && (await this.parts.fetchBytes(url).catch(() => null));
    if (!bytes) return null;
    const floor = JSON.parse(new TextDecoder().decode(bytes));
    return { foldsM: floor.folds_m, surfaceM: floor.surface_m };
  }

  private startFrame(): number {
    return Math.round(this.store.get().startS / FRAME_S);
  }

  private async advance(
    how: (pane: PaneRun) => Advance,
    isCurrent: IsCurrent,
  ): Promise<string | null> {
    const reasons = await Promise.all(
      this.panes.map(async (pane) => {
        const { fit, ended } = await pane.advance(this.at, how(pane));
        if (fit && isCurrent()) this.store.set({ fit });
        return ended && `${pane.id}: ${ended}`;
      }),
    );
    return reasons.find((reason) => reason !== null) ?? null;
  }

  private describePane(
    pane: PaneRun,
    fine: { places: Float32Array; folds: Float64Array | null } | null,
    wantsNumbers: boolean,
  ): Promise<Described> {
    const state = this.store.get();
    const isSampled = this.isSampled(pane);
    const isCompared = wantsNumbers || state.colour === 'distance' || isSampled;
    return pane.describe({
      scalar: scalarOf(state),
      reference: isCompared && fine ? fine.places : null,
      fineFolds: fine?.folds ?? null,
      takesSample: isSampled,
      timeS: this.timeS(),
      wantsFaults: wantsNumbers && (!state.playing || pane.source === 'recorded'),
      wantsSurface: wantsNumbers && !state.playing,
    });
  }

  /** Puts the numbers of one pane into the state. */
  private tell(pane: PaneRun, described: Described): void {
    const { compared, foldsM, surfaceM, faults, costs, warnings } = described;
    const isSampled = this.isSampled(pane);
    const patch: Partial<GarmentPane> = {
      distanceM: compared?.rms_m ?? null,
      lostM: compared?.lost_m ?? null,
      lostNormalsRad: compared?.lost_normals_rad ?? null,
      foldsM: isSampled ? null : foldsM,
      surfaceM: isSampled ? null : surfaceM,
      faults: isSampled ? null : faults,
      source: this.shownSource(pane),
      warnings,
    };
    if (pane.source === 'computed' && costs) Object.assign(patch, pane.costs(costs));
    this.set(pane.id, patch);
  }
}
