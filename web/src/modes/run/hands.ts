// Actions of a visitor, whichever control they come from.
import type { Store } from '../../shared/state/store';
import type { Energy } from '../bindings/modal-module';
import { enclosedVolume, farthestMove } from '../state/mix';
import type { ModesState } from '../state/modes-state';
import { KeyEditor } from './key-editor';
import type { ModesRun } from './modes-run';
import { Pull } from './pull';

/** A step of the timeline by a key press, in keys. */
const TIME_STEP = 0.05;

/** Nothing moves unasked where the visitor's system says so. */
function mayMove(): boolean {
  return !window.matchMedia('(prefers-reduced-motion: reduce)').matches;
}

export class Hands {
  readonly editor: KeyEditor;
  readonly pull: Pull;

  constructor(
    private readonly store: Store<ModesState>,
    private readonly run: ModesRun,
  ) {
    this.editor = new KeyEditor(run);
    this.pull = new Pull(store, run, mayMove);
  }

  togglePlaying(): void {
    const { playing, phase } = this.store.get();
    if (phase === 'ready') this.store.set({ playing: !playing, invited: false });
  }

  toggleShowing(): void {
    const { showing } = this.store.get();
    this.store.set({ showing: showing === 'modes' ? 'keys' : 'modes' });
  }

  /** One mode and no other, as far as it keeps a volume; it swings at once, unless motion is not wanted. */
  playAlone(mode: number): void {
    const { found, energy, surface } = this.store.get();
    if (mode >= (found?.modes.length ?? 0)) return;
    const quiet = surface?.closed ? (this.run.present?.quiet(energy, mode) ?? 1) : 1;
    const amplitudes = Array.from({ length: mode + 1 }, (_, at) => (at === mode ? quiet : 0));
    const playing = this.store.get().phase === 'ready' && mayMove();
    this.store.set({ amplitudes, showing: 'modes', playing, invited: false });
  }

  setAmplitude(mode: number, amplitude: number): void {
    const { amplitudes } = this.store.get();
    const length = Math.max(amplitudes.length, mode + 1);
    this.store.set({
      amplitudes: Array.from({ length }, (_, at) =>
        at === mode ? amplitude : (amplitudes[at] ?? 0),
      ),
      showing: 'modes',
    });
  }

  moveTime(by: number): void {
    const { time, keys } = this.store.get();
    const end = Math.max(0, keys.length - 1);
    const next = Math.min(end, Math.max(0, time + by));
    this.store.set({ time: next, playing: false, showing: 'keys' });
  }

  key(name: string): boolean {
    if (name === ' ') this.togglePlaying();
    else if (name === 'm') this.toggleShowing();
    else if (name === 'k') this.editor.keep();
    else if (name === ',') this.moveTime(-TIME_STEP);
    else if (name === '.') this.moveTime(TIME_STEP);
    else if (/^[1-9]$/.test(name)) this.playAlone(Number(name) - 1);
    else return false;
    return true;
  }

  /** The present mix of an energy at its full swing; empty before there is a body. */
  private mixed(energy: Energy): Float64Array {
    const body = this.run.present;
    const positions = new Float64Array(body?.shape.length ?? 0);
    body?.mix(positions, energy, this.store.get().amplitudes);
    return positions;
  }

  move(): number {
    const shape = this.run.present?.shape ?? [];
    return farthestMove(this.mixed(this.store.get().energy), shape);
  }

  /** Volume of the mix over that at rest; null of an open surface. */
  volumeOf(energy: Energy): number | null {
    const body = this.run.present;
    if (!body || !this.store.get().surface?.closed) return null;
    const { triangles, shape } = body;
    return enclosedVolume(this.mixed(energy), triangles) / enclosedVolume(shape, triangles);
  }
}
