// Each naive side shows the sign that its case promises, and ours none.
import { describe, expect, it } from 'vitest';
import {
  CASES,
  type FailureCase,
  type Side,
  type Sign,
  STEP_S,
  sceneTextOf,
} from '../../src/failures/state/failure-cases';
import type { RunNumbers } from '../../src/shared/bindings/pleat-module';
import { fabricsText } from '../../src/shared/fabric/fabric-data';
import { loadFirst } from '../support/built-module';

/** All signs of a side until its end. */
async function signsOf(one: FailureCase, side: Side): Promise<Sign[]> {
  const module = await loadFirst();
  const simulation = new module.Simulation(fabricsText);
  expect(JSON.parse(simulation.load(sceneTextOf(one, side)))).toMatchObject({ ok: true });
  const nSteps = Math.round(one.endS / STEP_S);
  let hasEnded = false;
  for (let step = 0; step < nSteps && !hasEnded; ++step) hasEnded = simulation.step(1) !== 0;
  const { warnings } = JSON.parse(simulation.numbers()) as RunNumbers;
  const areFinite = simulation.exactPositions().every(Number.isFinite);
  simulation.delete();
  expect(areFinite).toBe(true);
  return [...warnings.map(({ kind }): Sign => kind), ...(hasEnded ? (['ended'] as const) : [])];
}

describe('nine cases', () => {
  it('differ', () => {
    expect(CASES).toHaveLength(9);
    expect(new Set(CASES.map(({ id }) => id)).size).toBe(9);
    expect(new Set(CASES.map(({ title }) => title)).size).toBe(9);
  });
});

describe('a case', () => {
  for (const one of CASES) {
    it(`${one.id}: the naive side shows "${one.sign}", ours nothing`, {
      timeout: 60000,
    }, async () => {
      expect(await signsOf(one, 'naive')).toContain(one.sign);
      expect(await signsOf(one, 'ours')).toEqual([]);
    });
  }
});
