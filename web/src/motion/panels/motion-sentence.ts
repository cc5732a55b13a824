// The sentence that a screen reader says of the cloth in motion.
import type { MotionState } from '../state/motion-state';
import { PRESETS } from '../state/setting';

/** The sentence for a change, or null when nothing worth saying happened. */
export function motionSentence(state: MotionState, previous: MotionState): string | null {
  if (state.phase === 'ready' && previous.phase === 'loading' && state.summary) {
    const { title } = PRESETS[state.setting.preset];
    return `${title}, ${state.setting.fabric}, ${state.summary.n_vertices} vertices.`;
  }
  if (state.sweep.phase !== previous.sweep.phase) {
    if (state.sweep.phase === 'running') return 'The sweep has started.';
    if (state.sweep.phase === 'done') return `The sweep is done: ${state.sweep.rows.length} rows.`;
    if (state.sweep.phase === 'cancelled') return 'The sweep was cancelled.';
  }
  if (state.held !== previous.held) return state.held ? 'Holding the cloth.' : 'Let go.';
  if (state.playing !== previous.playing) return state.playing ? 'Playing.' : 'Paused.';
  return null;
}
