// The light: what it says changed, and the number that decides, against the module's monitor.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, it } from 'vitest';
import type { FitAnswer, RefinementModule } from '../../src/refinement/bindings/refinement-module';
import {
  anewSentence,
  exampleSentence,
  fitReading,
  ruleSentence,
} from '../../src/refinement/panels/fit-words';
import type { ExampleClient } from '../../src/refinement/run/garment-client';
import { ExamplePlanner } from '../../src/refinement/run/planner';
import { sceneFiles } from '../../src/refinement/run/scene-files';
import { type Fit, LastingShare } from '../../src/refinement/state/fit';
import { FRAMES_TO_FIRE, LARGEST_SHARE } from '../../src/refinement/state/garment-frames';
import { MOTIONS, sceneText } from '../../src/refinement/state/garments';
import type { PlanStory } from '../../src/refinement/state/plan-file';
import {
  canPlanAnew,
  DEFAULT_LINK,
  initialRefinementState,
  isExample,
} from '../../src/refinement/state/refinement-state';
import type { ToExample } from '../../src/refinement/worker/garment-protocol';
import { readRecording } from '../../src/refinement/worker/recording';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadModule } from '../support/built-module';
import { recordBytes } from '../support/garment-workers';

let module: RefinementModule;
beforeAll(async () => {
  module = await loadModule();
});

const STORY: PlanStory = {
  examples: ['skirt_walk'],
  patterns: [],
  nVertices: 900,
  hasLimits: true,
  nSplits: 30,
  nForBalance: 4,
  isByShape: true,
  rule: { kind: 'demand', value: 3 },
};

const FIT: Fit = {
  share: 0.01,
  worst_share: 0.09,
  lasting_share: 0.02,
  n_in_a_row: 0,
  n_frames: 30,
  fires: false,
  first_fired: null,
};

/** A frame of the fast walk in which next to no face bends too far. */
const CALM_FRAME = 24;

const STATE = initialRefinementState(DEFAULT_LINK, []);
const FIRED = { ...FIT, lasting_share: 0.0612, fires: true, first_fired: 34 };

describe('the light', () => {
  it('is lit by what the monitor says', () => {
    const light = (fit: Fit | null, story: PlanStory | null = STORY) =>
      fitReading(fit, story, STATE).light;
    expect(light(null)).toBe('unknown');
    expect(light(FIT, null)).toBe('unknown');
    expect(light(FIT)).toBe('fits');
    expect(light({ ...FIT, share: 0.2, n_in_a_row: 3 })).toBe('uneasy');
    expect(light(FIRED)).toBe('fires');
    // A second of motion has to be seen before it is said to fit, not before it is said not to.
    expect(light({ ...FIT, n_frames: 29 })).toBe('watching');
    expect(light({ ...FIRED, n_frames: 12 })).toBe('fires');
    // Once it has fired the plan stays doubtful.
    expect(light({ ...FIRED, fires: false })).toBe('fires');
  });

  it('tells the number that decides, not that of the worst frame, beside the bound', () => {
    const calm = fitReading(FIT, STORY, STATE).detail;
    expect(calm).toContain('At most 2.0 % of the faces bent too far for 10 frames in a row; 5.0 %');
    expect(calm).not.toContain('9.0');
    expect(fitReading(FIRED, STORY, STATE).detail).toContain('Up to 6.1 %');
    const uneasy = fitReading({ ...FIT, share: 0.2, n_in_a_row: 3 }, STORY, STATE).detail;
    expect(uneasy).toContain('3 of 10 frames');
    expect(ruleSentence(STORY)).toMatch(/more than 5\.0 % .* 10 frames in a row/);
  });

  it('says what the example is, and that this is it or in what it differs', () => {
    const of = (patch: Partial<typeof STATE>) => exampleSentence({ ...STATE, ...patch });
    expect(of({ motion: 'walk' })).toBe('This is the example.');
    expect(of({ motion: 'fast_walk' })).toBe(
      'The example is the normal walk; this is the fast walk.',
    );
    expect(of({ motion: 'walk', fabric: 'silk' })).toBe(
      'The example is in fine cotton; this is in silk.',
    );
    expect(of({ motion: 'squat', fabric: 'silk' })).toBe(
      'The example is the normal walk in fine cotton; this is the squat in silk.',
    );
    // A further example is of the shown fabric.
    const further = ['squat'] as const;
    expect(of({ motion: 'squat', fabric: 'silk', further })).toBe('This is one of the examples.');
    expect(of({ motion: 'walk', fabric: 'silk', further })).toBe(
      'The examples are the normal walk in fine cotton and the squat in silk; this is the normal walk in silk.',
    );
    expect(of({ motion: 'turn', further })).toBe(
      'The examples are the normal walk and the squat; this is the turn on the spot.',
    );
    expect(fitReading(FIRED, STORY, { ...STATE, fabric: 'silk' }).detail).toContain(
      'this is the fast walk in silk',
    );
  });

  it('stands on a first picture without a word on a change: nobody made one', () => {
    const first = fitReading({ ...FIT, n_frames: 1 }, STORY, STATE);
    expect(first.light).toBe('watching');
    expect(`${first.title} ${first.detail}`).not.toMatch(/chang/i);
  });

  it('is not contradicted by the name of a motion, whatever it says', () => {
    for (const { title } of MOTIONS) expect(title).not.toMatch(/example|like/);
  });

  it('is followed by an offer of a plan for a motion that did not fit and is no example', () => {
    const squat = { ...STATE, phase: 'ready' as const, motion: 'squat' as const, fit: FIRED };
    expect(canPlanAnew(squat)).toBe(true);
    expect(anewSentence(squat)).toContain('on the fine mesh');
    expect(canPlanAnew({ ...squat, fit: FIT })).toBe(false);
    expect(anewSentence({ ...squat, fit: FIT })).toContain('once the light says so');
    expect(canPlanAnew({ ...squat, phase: 'loading' })).toBe(false);
    const known = { ...squat, further: ['squat' as const] };
    expect(canPlanAnew(known)).toBe(false);
    expect(anewSentence(known)).toContain('already');
    // The example that comes with the page is of one fabric.
    const walk = { ...squat, motion: 'walk' as const };
    expect(isExample(walk)).toBe(true);
    expect(canPlanAnew({ ...walk, fabric: 'silk' })).toBe(true);
  });

  it('foretells how many frames of how many vertices that plan takes', async () => {
    const fine = { ...STATE.panes.fine, nVertices: 10500 };
    const fired = { ...STATE, phase: 'ready' as const, motion: 'squat' as const, fit: FIRED };
    const words = anewSentence({ ...fired, panes: { ...STATE.panes, fine } });
    const [, frames] = /: (\d+) frames of 10\u202f500 vertices\.$/.exec(words) ?? [];
    const asked: ToExample[] = [];
    const ask = async (question: ToExample) => {
      asked.push(question);
      return { share: 1, plan: {} };
    };
    const planner = new ExamplePlanner(() => ({ ask }) as unknown as ExampleClient, recordBytes);
    await planner.plan({ ...STATE, further: ['squat'] });
    const begun = asked.find(({ type }) => type === 'begin');
    if (begun?.type !== 'begin') throw new Error('no example was begun');
    expect(Number(frames)).toBe(Math.round(begun.toS / begun.frameS));
  });

  it('goes by no share before as many frames were seen as it has to last', () => {
    const lasting = new LastingShare();
    const found = Array.from({ length: FRAMES_TO_FIRE }, () => lasting.add(0.2));
    expect(found).toEqual([...Array(FRAMES_TO_FIRE - 1).fill(0), 0.2]);
  });

  it('goes by a number that exceeds its bound in the very frame in which the monitor fires', async () => {
    const root = fileURLToPath(new URL('../../..', import.meta.url));
    const path = `${root}/assets/recordings/skirt_walk/plan.json`;
    const plan = JSON.parse(readFileSync(path, 'utf8'));
    const run = new module.GarmentRun(fabricsText);
    const text = sceneText('skirt', 'walk', 'fine cotton', { plan });
    expect(JSON.parse(run.load(text, await sceneFiles('skirt', recordBytes)))).toMatchObject({
      ok: true,
    });
    const file = await recordBytes('assets/recordings/skirt_fast_walk/planned.recording');
    const record = await readRecording(new Uint8Array(file), run.parents().slice());
    const calm = record?.frames[CALM_FRAME] ?? new Float32Array(0);
    const crumpled = calm.map((value, k) => value + 0.03 * Math.sin(7.7 * k));
    const lasting = new LastingShare();
    const isCrumpled = (frame: number) => (frame > 3 && frame < 12) || frame > 14;
    for (let frame = 0; frame < 30; ++frame) {
      run.put(isCrumpled(frame) ? crumpled : calm, frame / 30);
      const seen: FitAnswer = JSON.parse(run.addShownFrame());
      expect(seen.share > LARGEST_SHARE).toBe(isCrumpled(frame));
      expect(lasting.add(seen.share) > LARGEST_SHARE).toBe(seen.first_fired !== null);
      expect(seen.first_fired !== null).toBe(frame >= 24);
    }
    run.delete();
  });
});
