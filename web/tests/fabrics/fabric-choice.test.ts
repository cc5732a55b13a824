import { describe, expect, it } from 'vitest';
import { cellAfter } from '../../src/fabrics/panels/fabric-gallery';
import { isSpiky } from '../../src/fabrics/panels/term-reading';
import type { FabricChoice } from '../../src/fabrics/state/deform-state';
import {
  MOST_COMPARED,
  weightsOf,
  withShown,
  withToggled,
} from '../../src/fabrics/state/fabric-choice';
import { geometryOf } from '../../src/fabrics/state/fabric-geometry';
import { fabricNamed, fabrics } from '../../src/shared/fabric/fabric-data';

const named = (name: string): FabricChoice => ({ kind: 'named', name });
const own = (recovery: number): FabricChoice => ({
  kind: 'own',
  measures: { recovery, stretch: 1.05, bending: 0.99 },
});
const [silk, wool, linen] = [named('silk'), named('wool'), named('linen')];

describe('fabric-choice', () => {
  it('shows a fabric in the chosen pane and leaves the others', () => {
    const shown = withShown({ fabrics: [silk, wool], chosen: 1 }, linen);
    expect(shown).toEqual({ fabrics: [silk, linen], chosen: 1 });
  });

  it('chooses the pane that shows the fabric already', () => {
    const shown = withShown({ fabrics: [silk, wool], chosen: 1 }, silk);
    expect(shown).toEqual({ fabrics: [silk, wool], chosen: 0 });
  });

  it('gives an own fabric its new measures in the pane it has', () => {
    const shown = withShown({ fabrics: [own(0.9), wool], chosen: 1 }, own(0.95));
    expect(shown).toEqual({ fabrics: [own(0.95), wool], chosen: 0 });
  });

  it('adds a pane and chooses it, four at most', () => {
    expect(withToggled({ fabrics: [silk], chosen: 0 }, wool)).toEqual({
      fabrics: [silk, wool],
      chosen: 1,
    });
    const four = { fabrics: [silk, wool, linen, own(0.9)], chosen: 2 };
    expect(four.fabrics).toHaveLength(MOST_COMPARED);
    expect(withToggled(four, named('velvet'))).toMatch(/^4 fabrics at most/);
    expect(withToggled(four, silk)).toEqual({ fabrics: [wool, linen, own(0.9)], chosen: 1 });
  });

  it.each([
    [0, 1, 0],
    [1, 1, 1],
    [2, 1, 1],
    [2, 2, 1],
    [0, 0, 0],
  ])('with pane %i chosen and pane %i closed, chooses pane %i', (chosen, closed, left) => {
    const before = [silk, wool, linen];
    const after = withToggled({ fabrics: before, chosen }, before[closed] ?? silk);
    expect(after).toMatchObject({ chosen: left });
    if (typeof after === 'string' || chosen === closed) return;
    expect(after.fabrics[after.chosen]).toBe(before[chosen]);
  });

  it('keeps the last fabric', () => {
    expect(withToggled({ fabrics: [silk], chosen: 0 }, silk)).toMatch(/^One fabric stays/);
  });
});

describe('weightsOf', () => {
  it('keeps recomputed, printed and fitted weights apart', () => {
    const { recomputed, published } = geometryOf(fabricNamed('silk'));
    expect(weightsOf(silk, 'recomputed', null)).toEqual(recomputed);
    expect(weightsOf(silk, 'published', null)).toEqual(published);
    expect(published.stretch).toBeLessThan(0.2 * recomputed.stretch);
    expect(weightsOf(own(0.9), 'published', null)).toBeNull();
  });

  it('tells that silk makes a spike, and no other fabric', () => {
    const spiky = fabrics.filter((fabric) => isSpiky(geometryOf(fabric).recomputed));
    expect(spiky.map(({ name_en }) => name_en)).toEqual(['silk']);
  });
});

describe('fabric-gallery', () => {
  it.each([
    ['ArrowDown', 14, 14],
    ['ArrowUp', 0, 0],
    ['ArrowDown', 3, 4],
    ['ArrowUp', 3, 2],
    ['Home', 7, 0],
    ['End', 7, 14],
  ])('leads with %s from row %i to row %i', (key, from, to) => {
    expect(cellAfter(key, { row: from, column: 1 }, 15)).toEqual({ row: to, column: 1 });
  });

  it('leads sideways between a button and its check box, and nowhere with other keys', () => {
    expect(cellAfter('ArrowRight', { row: 2, column: 0 }, 15)).toEqual({ row: 2, column: 1 });
    expect(cellAfter('ArrowLeft', { row: 2, column: 1 }, 15)).toEqual({ row: 2, column: 0 });
    expect(cellAfter('Tab', { row: 2, column: 1 }, 15)).toBeNull();
  });
});
