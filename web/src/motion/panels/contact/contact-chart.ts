// How touched vertices move along the normal after first contact, under both responses.

import type { ResponseStudy } from '../../../shared/bindings/pleat-module';
import { checkBox, element, setText } from '../../../shared/panels/element';
import { lineKey } from '../../../shared/panels/line-key';
import { digits, percent } from '../../../shared/panels/quantity';
import { type Store, watch } from '../../../shared/state/store';
import { ResponseSource, WINDOW_S } from '../../run/response-source';
import type { MotionState, ResponseStory } from '../../state/motion-state';
import { createTimePlot, type TimeChart } from '../chart/time-plot';

const WINDOW_MS = 1000 * WINDOW_S;

/** More points than the chart has pixels are not drawn. */
const MOST_POINTS = 300;

function speed(metresPerSecond: number): string {
  if (metresPerSecond >= 0.1) return `${digits(metresPerSecond, 2)}\u00a0m/s`;
  return `${digits(1000 * metresPerSecond, 2)}\u00a0mm/s`;
}

export function contactWords(story: ResponseStory): string {
  if (story === 'unasked') return '';
  if (story === 'coming') return 'Studying the scene beside the shown one …';
  if ('refused' in story) return `This scene tells nothing of it: ${story.refused}.`;
  const { first_contact_s, resting, uniform } = story;
  const ratio = resting.rms_normal_velocity_m_per_s / uniform.rms_normal_velocity_m_per_s;
  return [
    `First contact comes at ${digits(first_contact_s, 3)}\u00a0s.`,
    `In the ${WINDOW_MS}\u00a0ms after it, the ${resting.n_touched} vertices touched so far move along the normal with`,
    `${speed(resting.rms_normal_velocity_m_per_s)} (RMS) where the cloth rests, and`,
    `${uniform.n_touched} with ${speed(uniform.rms_normal_velocity_m_per_s)} where it bounces: ${percent(ratio)} of it.`,
    `Contact takes ${percent(resting.contact_share)} of a step.`,
  ].join(' ');
}

export function contactChart({ substep_s, resting, uniform }: ResponseStudy): TimeChart {
  const n = resting.normal_velocities_m_per_s.length;
  const stride = Math.ceil(n / MOST_POINTS);
  const thinned = (values: readonly number[]) => values.filter((_, index) => index % stride === 0);
  const times = Array.from({ length: n }, (_, index) => 1000 * substep_s * (index + 1));
  return {
    timeTitle: 'after first contact [ms]',
    valueTitle: 'along the normal [m/s]',
    times: thinned(times),
    lines: [
      { class: 'time-line response-resting', values: thinned(resting.normal_velocities_m_per_s) },
      { class: 'time-line response-uniform', values: thinned(uniform.normal_velocities_m_per_s) },
    ],
  };
}

/** A switch that lets the shown cloth bounce too. */
function createSwitch(store: Store<MotionState>): HTMLElement {
  const words = 'Let the shown cloth bounce, as textbooks do';
  const { input, label } = checkBox(words, (isOn) => {
    const { bounces: _, ...setting } = store.get().setting;
    store.set({ setting: isOn ? { ...setting, bounces: true } : setting });
  });
  watch(store, ['setting'], ({ setting }) => {
    input.checked = setting.bounces === true;
  });
  return label;
}

/** Returns what studies the shown scene if that is due. */
export function createContactChart(
  parent: HTMLDetailsElement,
  store: Store<MotionState>,
): ResponseSource {
  const plot = createTimePlot('contact-over-time');
  const legend = element(
    'ul',
    { class: 'marks line-keys' },
    lineKey('time-line response-resting', 'Rests: the normal velocity and force end'),
    lineKey('time-line response-uniform', 'Bounces: both are turned round'),
  );
  const words = element('figcaption');
  const figure = element('figure', { class: 'chart' }, legend);
  figure.append(plot.root, words);
  parent.append(figure, createSwitch(store));
  watch(store, ['response'], ({ response }) => {
    const isDrawn = typeof response === 'object' && 'resting' in response;
    plot.root.toggleAttribute('hidden', !isDrawn);
    legend.hidden = !isDrawn;
    setText(words, contactWords(response));
    if (isDrawn) plot.draw(contactChart(response));
  });
  return new ResponseSource(store, () => parent.open);
}
