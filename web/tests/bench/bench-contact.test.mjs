import { describe, expect, it } from 'vitest';
import { costGoals } from '../../../bench/parts/contact-cost.mjs';
import { crossingGoals } from '../../../bench/parts/contact-crossings.mjs';
import { knotPlaces, wavePlaces } from '../../../bench/parts/contact-places.mjs';
import { heightOf, outOfOrder, restGoals } from '../../../bench/parts/contact-rest.mjs';
import { kForAll, kForSome, kOfMeshes, withContact } from '../../../bench/parts/contact-scenes.mjs';

const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));
const lines = (goals) => goals.map(({ line }) => line);

describe('scenes of self-contact', () => {
  it('have a napkin that is folded without stretch, its halves a cell apart', () => {
    const { cloth, start } = kForAll.napkin(20);
    const { rows, columns, height_m } = cloth.sheet;
    const cell = height_m / rows;
    const at = (row, column) => start.positions_m[row * (columns + 1) + column];
    expect(start.positions_m).toHaveLength((rows + 1) * (columns + 1));
    for (let row = 0; row < rows; ++row) {
      const share = distance(at(row, 3), at(row + 1, 3)) / cell;
      expect(share).toBeLessThanOrEqual(1 + 1e-12);
      expect(share).toBeGreaterThan(0.8);
    }
    expect(distance(at(0, 5), at(rows, 5))).toBeCloseTo(cell, 12);
  });

  it('have hooks at places of the upper edge, which keep their order', () => {
    const { cloth, pins } = kForSome.curtain(24);
    const width = cloth.sheet.width_m;
    const ends = pins.map(({ vertices: [vertex], motion }) => {
      expect(vertex).toBeLessThanOrEqual(cloth.sheet.columns);
      return (vertex / cloth.sheet.columns - 0.5) * width + motion.offset_m[0];
    });
    const steps = ends.slice(1).map((end, k) => end - ends[k]);
    expect(Math.min(...steps)).toBeGreaterThan(0);
    expect(ends.at(-1) - ends[0]).toBeCloseTo(0.14 * width, 12);
  });

  it('twist a ribbon that is long enough for its turn', () => {
    const { cloth, pins } = kForSome.twist(10);
    const { width_m, height_m } = cloth.sheet;
    const up = pins.find(({ part }) => part === 'lower_left').motion.offset_m[1];
    expect(Math.hypot(height_m - up, Math.PI * width_m)).toBeLessThan(height_m);
    const [across, , out] = pins[0].motion.offset_m;
    expect(2 * Math.hypot(across - width_m / 2, out)).toBeLessThan(width_m);
  });

  it('start as long between their vertices as they are at rest, a knot within a fifth', () => {
    for (const [name, strain] of Object.entries({
      threeFolds: 1e-12,
      tenFolds: 1e-12,
      spunSheet: 1e-12,
      rolledTube: 1e-12,
      tightKnot: 0.2,
    })) {
      const { cloth, start } = { ...kForAll, ...kForSome }[name]();
      const { rows, columns, width_m, height_m } = cloth.sheet;
      const at = (row, column) => start.positions_m[row * (columns + 1) + column];
      expect(start.positions_m, name).toHaveLength((rows + 1) * (columns + 1));
      const shares = [];
      for (let row = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
          const here = at(row, column);
          shares.push((distance(here, at(row + 1, column)) * rows) / height_m);
          shares.push((distance(here, at(row, column + 1)) * columns) / width_m);
        }
      expect(Math.max(...shares), name).toBeLessThan(1 + strain);
      expect(Math.min(...shares), name).toBeGreaterThan(1 - strain);
    }
  });

  it('have a knot whose strands are apart by its ribbon’s width where it meets itself', () => {
    const columns = 2;
    const places = knotPlaces(columns, 120, 0.01, 0.02);
    const row = (v) => Math.floor(v / (columns + 1));
    let least = Number.POSITIVE_INFINITY;
    places.forEach((place, v) => {
      for (let w = 0; w < v; ++w)
        if (row(v) - row(w) > 10) least = Math.min(least, distance(place, places[w]));
    });
    expect(least).toBeGreaterThan(0.015);
    expect(least).toBeLessThan(0.03);
  });

  it('have waves whose slope is as said, and which end as deep as they began', () => {
    const { places, height } = wavePlaces(1, 400, 0.01, 2, 0.8, 3);
    const [y, z] = [1, 2].map((k) => places.at(-1)[k]);
    expect(z).toBeCloseTo(0, 12);
    expect(y).toBeCloseTo(3 - height, 12);
    expect(height / 4).toBeCloseTo(0.8463, 4); // J0(0.8)
  });

  it('have sheets that nothing joins, one upon the other', () => {
    const { positions_m, triangles } = kOfMeshes.threeSheets(12).cloth.mesh;
    expect(positions_m).toHaveLength(3 * 13 * 13);
    expect(triangles).toHaveLength(3 * 2 * 12 * 12);
    const sheetOf = (v) => Math.floor(v / 169);
    for (const [a, b, c] of triangles) {
      expect(sheetOf(b)).toBe(sheetOf(a));
      expect(sheetOf(c)).toBe(sheetOf(a));
    }
    expect(outOfOrder(positions_m, triangles, 169)).toBe(0);
    const swapped = positions_m.with(84, positions_m[84 + 169]).with(84 + 169, positions_m[84]);
    expect(outOfOrder(swapped, triangles, 169)).toBeGreaterThan(0);
  });

  it('are looked at after every step, and switched on and off', () => {
    const on = withContact(kForAll.edge(), { stepper: 'rk4' }, true);
    expect(on.record.every_s).toBe(on.method.step_s);
    expect(on.world.self_contact).toBe(true);
    expect(on.fabric.overrides.damping_ratio).toBe(0);
    const off = withContact(kForAll.edge(), { stepper: 'implicit' }, false);
    expect(off.world.self_contact).toBe(false);
    expect(off.fabric.overrides).toBeUndefined();
  });
});

describe('a height along a direction', () => {
  it('is where the triangle is met, and none beside it or behind', () => {
    const triangle = [
      [-1, 2, -1],
      [3, 2, -1],
      [-1, 2, 3],
    ];
    expect(heightOf(triangle, [0, 1, 0])).toBeCloseTo(2, 12);
    expect(heightOf(triangle.toReversed(), [0, 0.5, 0])).toBeCloseTo(4, 12);
    expect(heightOf(triangle, [0, -1, 0])).toBeNaN();
    expect(heightOf(triangle, [2, 1, 2])).toBeNaN();
  });
});

describe('goals of self-contact', () => {
  it('are of the stepper that comes to rest last, and want every run finished', () => {
    const rest = (name, more) => ({
      case: name,
      status: 'ok',
      rest_energy_j: 1e-9,
      drift_mm: 0.01,
      crossings: 0,
      ...more,
    });
    const ten = [rest('ten_layers'), rest('ten_layers', { rest_energy_j: 2e-6, drift_mm: 0.3 })];
    const three = [rest('three_sheets', { out_of_order: 1 }), rest('three_sheets')];
    expect(lines(restGoals([...ten, ...three]))).toEqual([
      'goal rest_energy_ten_layers_J 0.000002 at-most 0.000001 short',
      'goal drift_ten_layers_mm 0.3 at-most 0.1 short',
      'goal rest_energy_three_sheets_J 1e-9 at-most 0.000001 ok',
      'goal drift_three_sheets_mm 0.01 at-most 0.1 ok',
      'goal out_of_order_three_sheets 1 at-most 0 short',
      'goal crossings_at_rest 0 at-most 0 ok',
    ]);
    const refused = rest('ten_layers', { status: 'refused' });
    expect(lines(restGoals([refused, ...three]))[0]).toMatch(/short$/);
  });

  const row = (more) => ({
    scene: 'napkin',
    status: 'ok',
    crossings: 0,
    lost_mm_per_frame: 0,
    cloth_contact: { held_back_share: 0 },
    ...more,
  });

  it('add up crossings, of which a missing count is none', () => {
    const walking = row({ scene: 'skirt walking' });
    expect(lines(crossingGoals([row(), walking]))[0]).toMatch(/crossings_with_guard 0 .* ok$/);
    const crossed = [row({ crossings: 2 }), walking, row({ crossings: 3 })];
    expect(lines(crossingGoals(crossed))[0]).toMatch(/crossings_with_guard 5 .* short$/);
    const missing = [row({ crossings: undefined }), walking];
    expect(lines(crossingGoals(missing))[0]).toMatch(/short$/);
  });

  it('are about the dearest garment that walks', () => {
    const held = (share) =>
      row({ scene: 'skirt walking', cloth_contact: { held_back_share: share } });
    const found = lines(crossingGoals([held(0.001), held(0.02)]));
    expect(found).toContain('goal held_back_walking 0.02 at-most 0.01 short');
  });

  it('tell the growth of the scene that grows most, and the cost of 10 000 faces', () => {
    const cost = (name, n, ms) => ({
      case: name,
      n_faces: 2 * n * n,
      cost_ms: ms,
      us_per_face: (1e3 * ms) / (2 * n * n),
      status: 'ok',
    });
    const rows = [32, 72, 160].flatMap((n) => [
      cost('swinging', n, 1e-4 * n * n),
      cost('curtain', n, 1e-6 * n ** 3),
    ]);
    expect(lines(costGoals(rows, 2))).toEqual([
      'goal us_per_face_10000 0.05 at-most 2 ok',
      'goal growth_exponent 1.5 at-most 1.15 short',
    ]);
  });
});
