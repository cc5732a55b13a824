import { describe, expect, it, vi } from 'vitest';
import { contactChart, contactWords } from '../../src/motion/panels/contact/contact-chart';
import type { StartMeasuring } from '../../src/motion/run/measuring-client';
import { ResponseSource } from '../../src/motion/run/response-source';
import { decodeMotionLink, encodeMotionLink } from '../../src/motion/state/motion-link';
import { initialMotionState } from '../../src/motion/state/motion-state';
import { presetSetting, sceneOf } from '../../src/motion/state/setting';
import type { ToStudy } from '../../src/motion/worker/measuring-protocol';
import { studyResponse } from '../../src/motion/worker/response-core';
import { Refused } from '../../src/shared/bindings/answers';
import type { ResponseStudy } from '../../src/shared/bindings/pleat-module';
import { createStore } from '../../src/shared/state/store';
import { createFakeModule } from '../support/fake-module';

const run = (speeds: number[], rms: number) => ({
  normal_velocities_m_per_s: speeds,
  rms_normal_velocity_m_per_s: rms,
  n_touched: 16,
  contact_share: 0.24,
});

const STUDY: ResponseStudy = {
  first_contact_s: 0.17346,
  substep_s: 1e-4,
  resting: run(Array(500).fill(0.003), 0.003),
  uniform: run(Array(500).fill(1.2), 1.2),
};

describe('words of contact', () => {
  it('tell both responses and what contact takes', () => {
    const words = contactWords(STUDY).replaceAll('\u00a0', ' ');
    expect(words).toContain('First contact comes at 0.173 s.');
    expect(words).toContain('16 vertices touched so far move along the normal with 3.0 mm/s');
    expect(words).toContain('1.2 m/s where it bounces: 0.25 % of it.');
    expect(words).toContain('Contact takes 24 % of a step.');
  });

  it('say why a scene tells nothing of it', () => {
    expect(contactWords({ refused: 'expected a solid, got none' })).toBe(
      'This scene tells nothing of it: expected a solid, got none.',
    );
  });
});

describe('chart of contact', () => {
  it('has a time for each value, and no more than it can show', () => {
    const { times, lines } = contactChart(STUDY);
    expect(times).toHaveLength(250);
    expect(times[1]).toBeCloseTo(0.3);
    expect(lines.map(({ values }) => values.length)).toEqual([250, 250]);
  });
});

describe('cloth that bounces', () => {
  it('is said in the scene and in the link', () => {
    const wool = presetSetting('wool');
    expect(sceneOf(wool).world).not.toHaveProperty('contact_response');
    const bouncing = { ...wool, bounces: true };
    expect(sceneOf(bouncing).world).toMatchObject({
      colliders: expect.any(Array),
      contact_response: 'uniform',
    });
    const { link } = decodeMotionLink('');
    const text = encodeMotionLink({ ...link, setting: bouncing });
    expect(decodeMotionLink(text).link.setting.bounces).toBe(true);
    expect(decodeMotionLink('response=rubber').problems.join()).toMatch(/resting or uniform/);
  });
});

describe('model of a preset', () => {
  it('keeps what the preset says of its own model, and of no other', () => {
    expect(sceneOf(presetSetting('wool')).model).toEqual({
      elasticity: 'springs',
      damping: 'isotropic',
    });
    const curtain = presetSetting('curtain');
    expect(sceneOf({ ...curtain, model: 'membrane' }).model).toEqual({ elasticity: 'membrane' });
  });
});

describe('study of contact', () => {
  const question = (world: object): ToStudy => ({
    type: 'studyResponse',
    fabricsText: '',
    sceneText: JSON.stringify({ world }),
    windowS: 0.05,
  });

  it('answers with the study or why there is none, and deletes what it made', () => {
    const { module, alive } = createFakeModule();
    expect(studyResponse(module, question({ colliders: [{}] }))).toMatchObject({
      type: 'studied',
      study: { first_contact_s: 0.2, resting: { n_touched: 2 } },
    });
    expect(studyResponse(module, question({}))).toMatchObject({
      type: 'refused',
      failure: { where: '/world/colliders' },
    });
    expect(alive()).toBe(0);
  });

  function sourceOf(answer: () => Promise<unknown>, isWanted = () => true) {
    const asked: string[] = [];
    let nEnded = 0;
    const start: StartMeasuring = () => ({
      ask: (message) => {
        asked.push(message.sceneText);
        return answer() as never;
      },
      tell: () => undefined,
      terminate: () => {
        nEnded += 1;
      },
    });
    const { link } = decodeMotionLink('scene=wool');
    const store = createStore(initialMotionState(link, []));
    const source = new ResponseSource(store, isWanted, start);
    return { store, source, asked, ended: () => nEnded };
  }

  it('is made once for a scene, whether it bounces or not, and anew for another', async () => {
    vi.useFakeTimers();
    const { store, asked, ended } = sourceOf(async () => ({
      type: 'studied',
      study: STUDY,
    }));
    expect(store.get().response).toBe('coming');
    await vi.runAllTimersAsync();
    expect(store.get().response).toEqual(STUDY);
    const { setting } = store.get();
    store.set({ setting: { ...setting, bounces: true } });
    await vi.runAllTimersAsync();
    expect(asked).toHaveLength(1);
    store.set({ setting: { ...setting, substeps: 3 } });
    await vi.runAllTimersAsync();
    expect(asked).toHaveLength(2);
    expect(ended()).toBe(2);
    vi.useRealTimers();
  });

  it('is not made unasked, and says what the scene lacks', async () => {
    vi.useFakeTimers();
    let isWanted = false;
    const failure = { ok: false, kind: 'input', where: '/duration_s', what: 'expected a time' };
    const { store, source, asked } = sourceOf(
      () => Promise.reject(new Refused(failure as never)),
      () => isWanted,
    );
    await vi.runAllTimersAsync();
    expect(asked).toHaveLength(0);
    isWanted = true;
    source.follow();
    await vi.runAllTimersAsync();
    expect(store.get().response).toEqual({ refused: 'expected a time' });
    vi.useRealTimers();
  });
});
