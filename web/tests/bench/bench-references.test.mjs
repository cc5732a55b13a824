import { describe, expect, it } from 'vitest';
import { strip, tipErrors, triangulations } from '../../../bench/parts/cantilever.mjs';
import { journalFaults, rowFaults } from '../../../bench/parts/killed-sweep.mjs';

/** Twice the area of a triangle that lies in the plane of x and z, by its sense. */
const doubleArea = ([a, b, c]) => (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);

describe('strips', () => {
  it.each(triangulations)('are sound and whole: %s', (triangulation) => {
    const { positions, triangles } = strip(triangulation);
    const areas = triangles.map((triangle) => doubleArea(triangle.map((i) => positions[i])));
    expect(Math.min(...areas)).toBeGreaterThan(0.1 * Math.max(...areas));
    expect(areas.reduce((sum, area) => sum + area) / 2).toBeCloseTo(0.205 * 0.05, 12);
    const edges = triangles.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]);
    expect(new Set(edges).size).toBe(edges.length); // wound alike, at most two at an edge
    expect(new Set(triangles.flat()).size).toBe(positions.length);
  });

  it('differ by triangulation and are the same every time', () => {
    const texts = triangulations.map((name) => JSON.stringify(strip(name)));
    expect(new Set(texts).size).toBe(triangulations.length);
    expect(triangulations.map((name) => JSON.stringify(strip(name)))).toEqual(texts);
  });

  it('are moved inside alone, by a fifth of an edge each way', () => {
    const { positions, line } = strip('irregular');
    const still = strip('one_way').positions;
    const ways = positions.map((place, i) =>
      Math.max(Math.abs(place[0] - still[i][0]), Math.abs(place[2] - still[i][2])),
    );
    const inside = (i) => i >= 2 * line && i < 41 * line && i % line > 0 && i % line < line - 1;
    expect(Math.max(...ways.filter((_, i) => inside(i)))).toBeCloseTo(0.001, 5);
    expect(Math.max(...ways.filter((_, i) => !inside(i)))).toBe(0);
  });

  it('have their error at the tip', () => {
    const flat = strip('one_way').positions;
    const bent = (extent, height) =>
      flat.flatMap(([x, , z], i) => (i < 41 * 11 ? [x, 0, z] : [extent, -height, z]));
    const right = bent(0.08, 0.16);
    expect(tipErrors(right, right).percent).toBe(0);
    const found = bent(0.08, 0.16);
    found[3 * 41 * 11 + 1] -= 0.022; // one corner, lower
    const errors = tipErrors(found, right);
    expect(errors.percent).toBeCloseTo((100 * 0.022) / 0.2, 10); // (-0.12, -0.16) is its way
    expect(errors.height_percent).toBeCloseTo((100 * 0.002) / 0.16, 10);
    expect(errors.height_percent_of_length).toBeCloseTo(1, 10);
    expect(errors.extent_percent).toBeCloseTo(0, 10);
    expect(tipErrors([], right).percent).toBeNaN();
  });
});

describe('a sweep that was killed', () => {
  const line = (setting, round, ms = 1) => JSON.stringify({ setting, round, ms_per_frame: ms });
  const whole = [line(0, 0), line(1, 0), line(0, 1), line(1, 1)];

  it('is right when its journal went on where it stood', () => {
    expect(journalFaults([whole.slice(0, 1), whole.slice(0, 3)], whole, 4)).toEqual({
      lost: 0,
      repeated: 0,
    });
  });

  it('has lost what its journal lacks', () => {
    expect(journalFaults([], whole.slice(0, 3), 4).lost).toBe(1);
    expect(journalFaults([whole.slice(0, 2)], [], 4)).toEqual({ lost: 4, repeated: 2 });
  });

  it('has repeated what stands there twice or otherwise', () => {
    expect(journalFaults([], [...whole, line(0, 1, 2)], 4)).toEqual({ lost: 0, repeated: 1 });
    const again = [line(0, 0, 3), line(1, 0, 3), ...whole.slice(2)];
    expect(journalFaults([whole.slice(0, 2)], again, 4).repeated).toBe(2);
  });

  it('has a row for each setting', () => {
    const settings = [{ '/a': 1, '/b': 2 }, { '/a': 2 }];
    const row = (setting) => ({ setting });
    const both = [row({ '/b': 2, '/a': 1 }), row({ '/a': 2 })];
    expect(rowFaults(settings, both)).toEqual({ lost: 0, repeated: 0 });
    expect(rowFaults(settings, both.slice(1))).toEqual({ lost: 1, repeated: 0 });
    expect(rowFaults(settings, [...both, both[0]])).toEqual({ lost: 0, repeated: 1 });
  });
});
