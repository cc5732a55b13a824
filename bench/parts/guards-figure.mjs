// The figure of hierarchies with and without guards: levels from the front.
const kPanel = { width: 300, height: 320, gap: 24, left: 20, top: 52, title: 40 };
const kInk = '#333';
const kTurned = '#c2185b';
const kStrayed = '#d97706';

const minus = (a, b) => a.map((x, k) => x - b[k]);
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const areaVector = ([x0, x1, x2]) => cross(minus(x1, x0), minus(x2, x0));
const cornersOf = ({ positions }, triangle) => triangle.map((v) => positions[v]);
const keyOf = (place) => place.join();

/** Border edges as pairs of vertices: those of one triangle. */
function bordersOf({ triangles }) {
  const sides = new Map();
  for (const t of triangles)
    for (const k of [0, 1, 2]) {
      const side = [t[k], t[(k + 1) % 3]];
      const key = [Math.min(...side), Math.max(...side)].join();
      sides.set(key, sides.has(key) ? null : side);
    }
  return [...sides.values()].filter((side) => side);
}

/** Mean normals of the finest mesh, by place; places of its border. */
function surfaceOf(finest) {
  const normals = new Map(finest.positions.map((place) => [keyOf(place), [0, 0, 0]]));
  for (const triangle of finest.triangles) {
    const corners = cornersOf(finest, triangle);
    const area = areaVector(corners);
    for (const corner of corners) {
      const normal = normals.get(keyOf(corner));
      for (const k of [0, 1, 2]) normal[k] += area[k];
    }
  }
  const borders = new Set(bordersOf(finest).flatMap((side) => cornersOf(finest, side).map(keyOf)));
  return { normals, borders };
}

/** A view along the axis in which the mesh is thinnest, upright where it has a height. */
function viewOf({ positions }) {
  const range = [0, 1, 2].map((k) => {
    const values = positions.map((place) => place[k]);
    return { low: Math.min(...values), high: Math.max(...values) };
  });
  const isLying = range[1].high - range[1].low < 1e-9;
  const [across, up, depth] = isLying ? [0, 2, 1] : [0, 1, 2];
  const size = (k) => range[k].high - range[k].low;
  const scale = Math.min(kPanel.width / size(across), (kPanel.height - kPanel.title) / size(up));
  const middle = (k) => (range[k].low + range[k].high) / 2;
  return {
    at: (place) =>
      [
        kPanel.width / 2 + scale * (place[across] - middle(across)),
        kPanel.title + scale * (range[up].high - place[up]),
      ].map((x) => x.toFixed(1)),
    isInFront: (place) => isLying || place[depth] >= middle(depth),
  };
}

const text = (x, y, words, more = '') => `<text x="${x}" y="${y}" ${more}>${words}</text>`;

function panel(index, columns, { title, finest, level, note }) {
  const { normals, borders } = surfaceOf(finest);
  const { at, isInFront } = viewOf(finest);
  const path = (corners, end) => `M${corners.map((place) => at(place).join(' ')).join('L')}${end}`;
  const isShown = (corners) => corners.every(isInFront);
  const isTurned = (corners) => {
    const area = areaVector(corners);
    const longest = Math.max(
      ...[0, 1, 2].map((k) => Math.hypot(...minus(corners[k], corners[(k + 1) % 3]))),
    );
    const unit = (v) => v.map((x) => x / Math.hypot(...v));
    const looksAgainst = corners.reduce(
      (sum, corner) => sum + dot(area, unit(normals.get(keyOf(corner)))),
      0,
    );
    return looksAgainst < 0 || Math.hypot(...area) < 1e-3 * longest ** 2; // as level_faults
  };
  const shown = level.triangles.map((t) => cornersOf(level, t)).filter(isShown);
  const turned = shown.filter(isTurned);
  const strayed = bordersOf(level)
    .map((side) => cornersOf(level, side))
    .filter((side) => isShown(side) && !side.every((place) => borders.has(keyOf(place))));
  const rim = bordersOf(finest).map((side) => cornersOf(finest, side));
  const joined = (list, end) => list.map((corners) => path(corners, end)).join('');
  const { width, height, gap, left, top } = kPanel;
  const x = left + (index % columns) * (width + gap);
  const y = top + Math.floor(index / columns) * (height + gap);
  return [
    `<g transform="translate(${x} ${y})" stroke-linejoin="round" stroke-linecap="round">`,
    text(0, 12, title, 'font-weight="600"'),
    text(0, 28, note, 'font-size="11"'),
    `<path d="${joined(rim.filter(isShown), '')}" fill="none" stroke="#aaa" stroke-dasharray="3 3"/>`,
    `<path d="${joined(shown, 'Z')}" fill="#dbe7f0" stroke="#17638f" stroke-width="0.7"/>`,
    `<path d="${joined(turned, 'Z')}" fill="${kTurned}" stroke="${kTurned}" stroke-width="2"/>`,
    `<path d="${joined(strayed, '')}" fill="none" stroke="${kStrayed}" stroke-width="2.5"/>`,
    '</g>',
  ].join('\n');
}

/**
 * SVG of levels, `columns` beside each other.
 *
 * panels  {title, finest, level: {positions, triangles}, note}
 */
export function guardsFigure(panels, columns) {
  const { width, height, gap, left, top } = kPanel;
  const whole = {
    width: 2 * left + columns * width + (columns - 1) * gap,
    height: top + Math.ceil(panels.length / columns) * (height + gap),
  };
  const legend = [
    ['turned over or without area', kTurned],
    ['border edge that is on no border of the cloth', kStrayed],
  ].flatMap(([words, colour], k) => [
    `<path d="M${left + 420 + 200 * k} 22h18" stroke="${colour}" stroke-width="3"/>`,
    text(left + 444 + 200 * k, 26, words),
  ]);
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${whole.width} ${whole.height}" width="${whole.width}" height="${whole.height}" font-family="system-ui, sans-serif" font-size="12" fill="${kInk}">`,
    '<rect width="100%" height="100%" fill="#fff"/>',
    text(left, 26, 'Coarser levels with and without guards', 'font-size="14" font-weight="600"'),
    ...legend,
    ...panels.map((each, k) => panel(k, columns, each)),
    '</svg>',
    '',
  ].join('\n');
}
