import { describe, expect, it } from 'vitest';
import { stiffnessSentence } from '../../src/fabrics/panels/fabric-card';
import { orderedQuantity, orderNote } from '../../src/fabrics/panels/fabric-gallery';
import { paneNumber } from '../../src/fabrics/panels/pane-badges';
import { ORDERS, orderedFabrics, quantityOf } from '../../src/fabrics/state/fabric-order';
import { decodeFabricsLink } from '../../src/fabrics/state/fabrics-link';
import { initialFabricsState } from '../../src/fabrics/state/fabrics-state';
import {
  confidenceMeaning,
  fabricNamed,
  fabrics,
  inRun,
} from '../../src/shared/fabric/fabric-data';

const names = (order: (typeof ORDERS)[number]) => orderedFabrics(order).map((one) => one.name_en);

describe('order of fabrics', () => {
  it('has the stiffest first by forces, where linen comes after canvas, wool and leather', () => {
    expect(names('bending').slice(0, 3)).toEqual(['canvas', 'wool', 'leather']);
    expect(names('bending').indexOf('linen')).toBeGreaterThan(3);
    expect(names('bending').at(-1)).toBe('chiffon');
    expect(names('weight')[0]).toBe('leather');
    expect(names('stretch').at(-1)).toBe('spandex');
  });

  it.each(ORDERS)('lists every fabric once by %s, no value below one that follows', (order) => {
    expect(names(order).toSorted()).toEqual(fabrics.map((one) => one.name_en).toSorted());
    const key = quantityOf(order);
    const values = key ? orderedFabrics(order).map((one) => inRun(one, key).value) : [];
    values.slice(1).forEach((value, k) => {
      expect(value).toBeLessThanOrEqual(values[k] ?? 0);
    });
  });

  it('writes numbers with units, and marks what was not measured', () => {
    expect(orderedQuantity(fabricNamed('wool'), 'bending')).toBe('~78 µN·m');
    expect(orderedQuantity(fabricNamed('polyester'), 'bending')).toBe('8.3 µN·m');
    expect(orderedQuantity(fabricNamed('wool'), 'source')).toBe('');
    expect(stiffnessSentence(fabricNamed('linen'))).toMatch(
      /~35 µN·m \(estimated\): number 6 of 15 .* ~170 g\/m² .* bending length of ~28 mm/,
    );
  });

  it.each(ORDERS)('says by %s that shapes of weights do not tell which is stiffer', (order) => {
    expect(orderNote(order)).toMatch(/the panes show .*shapes by (them|weights)/i);
    expect(orderNote(order)).toContain('do not say which of two fabrics is stiffer');
  });

  it('says that neighbours marked ~ may be in another order', () => {
    expect(orderedQuantity(fabricNamed('canvas'), 'bending')).toBe('~82 µN·m');
    expect(orderNote('bending')).toContain('Ordered by bending rigidity');
    expect(confidenceMeaning.estimated).toContain('factor of 2');
    expect(orderNote('bending')).toMatch(/~ .* factor of 2: neighbours .* in another order/);
  });

  it('says of the number in a pane what it is', () => {
    const pane = { fabric: { kind: 'named', name: 'wool' } as const, energy: 3 };
    expect(paneNumber(pane, 'bending').meaning).toMatch(/ordered by; the shape .* not show it/);
    expect(paneNumber(pane, 'source').meaning).toContain('What the shape costs');
  });

  it('orders the panes of the gallery too, and stands in the link', () => {
    const { link, problems } = decodeFabricsLink('#view=fabrics&gallery=on&order=bending');
    expect(problems).toEqual([]);
    const { panes } = initialFabricsState(link, []);
    expect(panes.map(({ fabric }) => fabric)).toEqual(
      names('bending').map((name) => ({ kind: 'named', name })),
    );
    expect(decodeFabricsLink('#view=fabrics&order=colour').problems[0]).toMatch(/^order: expected/);
  });
});
