// Contact of the cloth with itself in the read-out: what it costs, and how much of the motion is its guard's.
import './cloth-contact.css';
import { element, setText } from '../../../shared/panels/element';
import { milliseconds, percent, smallLength } from '../../../shared/panels/quantity';
import { unbroken } from '../../../shared/panels/unbroken';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';

const COST_MEANING =
  'Wall time of one step that goes into keeping the cloth from passing through itself, on this device.';
const HELD_MEANING =
  'Mean share of the vertices whose way was cut short in a substep, and the way that they lost: RMS over all vertices.';

type Known = Pick<MotionState, 'numbers' | 'timing'>;

/** Cost of a step's contact and its share of the step; a dash before it was measured. */
export function clothContactCost({ timing }: Known): { value: string; detail: string } {
  if (timing?.clothContactMs === undefined) return { value: '–', detail: '' };
  const { clothContactMs: ms, totalMs } = timing;
  return { value: milliseconds(ms), detail: `${percent(ms / totalMs)} of a step` };
}

/** Words on the motion that the guard took; empty where the cloth passes through itself. */
export function heldBackWords({ numbers }: Known): string {
  const contact = numbers?.cloth_contact;
  if (!contact) return '';
  const { held_back_share: share, rms_motion_lost_m: lost } = contact;
  if (share === 0) return 'Held back: no vertex.';
  return unbroken(`Held back: ${percent(share)} of the vertices, ${smallLength(lost)} a substep.`);
}

/** Adds both to the strip of numbers, seen where the shown cloth meets itself. */
export function createClothContact(strip: HTMLElement, store: Store<MotionState>): void {
  const value = element('dd');
  const detail = element('dd', { class: 'detail' });
  const cell = element(
    'div',
    { title: COST_MEANING, class: 'cell-narrow cloth-contact' },
    element('dt', {}, 'Self-contact'),
    value,
    detail,
  );
  const line = element('p', { class: 'held-back', title: HELD_MEANING });
  const list = strip.querySelector('.numbers');
  list?.querySelector('.cell-wide')?.after(cell);
  list?.after(line);
  watch(store, ['numbers', 'timing'], (state) => {
    const words = heldBackWords(state);
    const cost = clothContactCost(state);
    for (const part of [cell, line]) part.hidden = words === '';
    setText(line, words);
    setText(value, cost.value);
    setText(detail, cost.detail);
  });
}
