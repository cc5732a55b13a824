// The stretch at which woven cloth tears: a hand gives cloth no more of it, and both sentences that name it agree.
import { describe, expect, it } from 'vitest';
import { pullSentence } from '../../src/motion/panels/numbers/pull-words';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import { warningSentence } from '../../src/shared/panels/warning-words';
import { loadFirst } from '../support/built-module';
import { begin, isNear, STEPS_PER_SECOND, sceneOf, type Vertex } from '../support/scene-run';
import { aWarning } from '../support/trial-worker';

/** Length of woven cloth over that at rest that it bears, as the page says it. */
const BORNE = 1.1;

describe('what woven cloth bears', () => {
  it('is the same in the words on a pull and in those on a warning', () => {
    const numbers = { asked_stretch: 2.5 } as RunNumbers;
    expect(pullSentence({ held: true, numbers })).toContain(`tears at about ${BORNE},`);
    const percent = Math.round(100 * (BORNE - 1));
    expect(warningSentence({ ...aWarning, value: 0.5 })).toContain(`tears at about ${percent} %`);
  });

  it('is as far as a hand stretches it, which gives way', async () => {
    const module = await loadFirst();
    const method = { stepper: 'implicit', step_s: 1 / STEPS_PER_SECOND };
    const scene = { ...sceneOf('swinging_sheet'), refinement: { level: 0 }, method };
    const { rest, simulation, at } = begin(module, scene);
    const held = rest.find(({ x, z }) => isNear(x, 0) && isNear(z, 0.5)) as Vertex;
    simulation.grab(held.id);
    simulation.moveGrab(held.x, held.y, held.z + 5);
    at(2);
    const { asked_stretch, largest_stretch } = JSON.parse(simulation.numbers());
    simulation.delete();
    expect(asked_stretch).toBeGreaterThan(4);
    expect(1 + largest_stretch).toBeLessThan(BORNE + 0.001);
    expect(1 + largest_stretch).toBeGreaterThan(BORNE - 0.005);
  });
});
