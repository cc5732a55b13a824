import { describe, expect, it } from 'vitest';
import { costGoals } from '../../../bench/parts/contact-cost.mjs';
import { crossingGoals } from '../../../bench/parts/contact-crossings.mjs';
import { kForAll, kForSome, withContact } from '../../../bench/parts/contact-scenes.mjs';

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

describe('goals of self-contact', () => {
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
