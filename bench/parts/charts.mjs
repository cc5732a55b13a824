// Pictures that benches make of their own rows, as SVG.
const kInk = '#333';
const kStrong = 'font-weight="600"';

const rounded = (value) => Number(value.toFixed(1));
const text = (x, y, words, more = '') =>
  `<text x="${rounded(x)}" y="${rounded(y)}" ${more}>${words.replaceAll('<', '&lt;')}</text>`;

/** A picture of these parts under its title, whose baseline starts at x, y. */
function picture(title, [x, y], [width, height], parts) {
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="system-ui, sans-serif" font-size="12" fill="${kInk}">`,
    '<rect width="100%" height="100%" fill="#fff"/>',
    text(x, y, title, `font-size="14" ${kStrong}`),
    ...parts,
    '</svg>\n',
  ].join('\n');
}

const kChart = { width: 350, height: 300, gap: 70, left: 64, top: 64 };
const kColours = { skirt: '#17638f', trousers: '#a34d00' };

/** The best reductions published, in shares of vertices and times faster. */
const kPublished = [
  { label: "another paper's dress", removed: 73.8, faster: 9 },
  { label: "the paper's trousers", removed: 76.2 },
];

/** Round numbers from 0 to at least `most`. */
export function ticks(most, about = 5) {
  const raw = most / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((candidate) => candidate >= raw);
  return Array.from({ length: Math.ceil(most / step - 1e-9) + 1 }, (_, k) => k * step);
}

function mark(kind, x, y, colour) {
  const place = `transform="translate(${x.toFixed(1)} ${y.toFixed(1)})"`;
  const dot = `<circle ${place} r="4.5" fill="${colour}"/>`;
  const line = `fill="none" stroke="${colour}" stroke-width="1.5"`;
  if (kind === 'plan') return dot;
  if (kind === 'chosen') return `<circle ${place} r="7" ${line}/>${dot}`;
  return `<path ${place} d="M-4.5-4.5H4.5V4.5H-4.5Z" ${line}/>`;
}

/** A chart of points {kind, garment, x, y} with vertical lines {at, label}. */
function chart(index, { title, xName, points, lines, xTicks, yTicks, xUnit }) {
  const { width, height, gap, left, top } = kChart;
  const x0 = left + index * (width + gap);
  const [xMost, yMost] = [xTicks.at(-1), yTicks.at(-1)];
  const x = (value) => x0 + (width * value) / xMost;
  const y = (value) => top + height * (1 - value / yMost);
  const upright = (at, look) => `<path d="M${x(at)} ${top}V${top + height}" ${look}/>`;
  const middle = 'text-anchor="middle"';
  const end = 'text-anchor="end"';
  return [
    text(x0, top - 14, title, kStrong),
    ...xTicks.flatMap((tick) => [
      upright(tick, 'stroke="#ddd"'),
      text(x(tick), top + height + 16, `${tick}${xUnit}`, middle),
    ]),
    ...yTicks.flatMap((tick) => [
      `<path d="M${x0} ${y(tick)}H${x0 + width}" stroke="#ddd"/>`,
      text(x0 - 6, y(tick) + 4, String(Number(tick.toPrecision(3))), end),
    ]),
    text(x0 + width / 2, top + height + 34, xName, middle),
    ...lines.flatMap(({ at, label }, k) => {
      const [side, look] = at > xMost / 2 ? [-4, `${end} font-size="10"`] : [4, 'font-size="10"'];
      return [
        upright(at, `stroke="${kInk}" stroke-dasharray="4 3"`),
        text(x(at) + side, top + 12 + 14 * k, label, look),
      ];
    }),
    ...points
      .filter((point) => Number.isFinite(point.x) && Number.isFinite(point.y))
      .map((point) => mark(point.kind, x(point.x), y(point.y), kColours[point.garment])),
  ].join('\n');
}

/**
 * Vertices and time saved against what a mesh loses of the fine shapes.
 *
 * points  {garment, kind: "plan" | "chosen" | "uniform", removed: %, faster, lostMm}
 * notes   lines below: what it cost beforehand
 */
export function savingsFigure(points, notes) {
  const { width, height, gap, left, top } = kChart;
  const shown = points.filter((point) => Number.isFinite(point.lostMm));
  const yTicks = ticks(Math.max(...shown.map(({ lostMm }) => lostMm)));
  const panel = (key, unit, title, xName, xTicks) => ({
    title,
    xName,
    xTicks,
    yTicks,
    xUnit: unit,
    points: shown.map((point) => ({ ...point, x: point[key], y: point.lostMm })),
    lines: kPublished
      .filter((one) => one[key])
      .map((one) => ({ at: one[key], label: `${one.label}: ${one[key]}${unit}` })),
  });
  const fastest = Math.max(...shown.map(({ faster }) => faster), 9);
  const panels = [
    panel('removed', ' %', 'Vertices saved', 'vertices removed from the fine mesh', ticks(100)),
    panel('faster', '', 'Time saved', 'times faster than the fine mesh', ticks(fastest)),
  ];
  const below = top + height + 62;
  const named = (kind, x, words, colour) => [
    mark(kind, x, below - 4, colour),
    text(x + 14, below, words),
  ];
  const kinds = {
    plan: 'refined by example',
    chosen: 'the one in the table',
    uniform: 'uniform mesh',
  };
  const title = 'Garments refined by example: what faces lose of the fine shapes [mm]';
  const size = [left + 2 * width + gap + 20, below + 22 + 16 * notes.length];
  return picture(title, [left, 22], size, [
    ...panels.map((each, k) => chart(k, each)),
    ...Object.entries(kColours).flatMap(([garment, colour], k) =>
      named('plan', left + 6 + 100 * k, garment, colour),
    ),
    ...Object.entries(kinds).flatMap(([kind, words], k) =>
      named(kind, left + 226 + 160 * k, words, kInk),
    ),
    ...notes.map((note, k) => text(left, below + 20 + 16 * k, note, 'font-size="11"')),
  ]);
}

const kMesh = { width: 300, height: 320, gap: 24, left: 20, top: 52, title: 40 };
const kTurned = '#c2185b';
const kStrayed = '#d97706';

const minus = (a, b) => a.map((x, k) => x - b[k]);
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const areaVector = ([x0, x1, x2]) => cross(minus(x1, x0), minus(x2, x0));
const cornersOf = ({ positions }, triangle) => triangle.map((v) => positions[v]);
const keyOf = (place) => place.join();

/** Border edges as places of their ends: those of one triangle. */
function bordersOf(mesh) {
  const sides = new Map();
  for (const t of mesh.triangles)
    for (const k of [0, 1, 2]) {
      const side = [t[k], t[(k + 1) % 3]];
      const key = [Math.min(...side), Math.max(...side)].join();
      sides.set(key, sides.has(key) ? null : side);
    }
  return [...sides.values()].filter((side) => side).map((side) => cornersOf(mesh, side));
}

/** Mean normals of the finest mesh, by place. */
function normalsOf(finest) {
  const normals = new Map(finest.positions.map((place) => [keyOf(place), [0, 0, 0]]));
  for (const triangle of finest.triangles) {
    const corners = cornersOf(finest, triangle);
    const area = areaVector(corners);
    for (const corner of corners) {
      const normal = normals.get(keyOf(corner));
      for (const k of [0, 1, 2]) normal[k] += area[k];
    }
  }
  return normals;
}

/** Turned against the normals of its corners, or without area, as `level_faults` counts them. */
function isTurned(corners, normals) {
  const area = areaVector(corners);
  const sides = [0, 1, 2].map((k) => Math.hypot(...minus(corners[k], corners[(k + 1) % 3])));
  const unit = (v) => v.map((x) => x / Math.hypot(...v));
  const along = corners.reduce((sum, one) => sum + dot(area, unit(normals.get(keyOf(one)))), 0);
  return along < 0 || Math.hypot(...area) < 1e-3 * Math.max(...sides) ** 2;
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
  const scale = Math.min(kMesh.width / size(across), (kMesh.height - kMesh.title) / size(up));
  const middle = (k) => (range[k].low + range[k].high) / 2;
  return {
    at: (place) =>
      [
        kMesh.width / 2 + scale * (place[across] - middle(across)),
        kMesh.title + scale * (range[up].high - place[up]),
      ].map((x) => x.toFixed(1)),
    isInFront: (place) => isLying || place[depth] >= middle(depth),
  };
}

function meshPanel(index, columns, { title, finest, level, note }) {
  const normals = normalsOf(finest);
  const rim = bordersOf(finest);
  const borders = new Set(rim.flat().map(keyOf));
  const { at, isInFront } = viewOf(finest);
  const paths = (list, end) =>
    list.map((corners) => `M${corners.map((one) => at(one).join(' ')).join('L')}${end}`).join('');
  const isShown = (corners) => corners.every(isInFront);
  const shown = level.triangles.map((t) => cornersOf(level, t)).filter(isShown);
  const turned = shown.filter((corners) => isTurned(corners, normals));
  const strayed = bordersOf(level).filter(
    (side) => isShown(side) && !side.every((place) => borders.has(keyOf(place))),
  );
  const { width, height, gap, left, top } = kMesh;
  const x = left + (index % columns) * (width + gap);
  const y = top + Math.floor(index / columns) * (height + gap);
  return [
    `<g transform="translate(${x} ${y})" stroke-linejoin="round" stroke-linecap="round">`,
    text(0, 12, title, kStrong),
    text(0, 28, note, 'font-size="11"'),
    `<path d="${paths(rim.filter(isShown), '')}" fill="none" stroke="#aaa" stroke-dasharray="3 3"/>`,
    `<path d="${paths(shown, 'Z')}" fill="#dbe7f0" stroke="#17638f" stroke-width="0.7"/>`,
    `<path d="${paths(turned, 'Z')}" fill="${kTurned}" stroke="${kTurned}" stroke-width="2"/>`,
    `<path d="${paths(strayed, '')}" fill="none" stroke="${kStrayed}" stroke-width="2.5"/>`,
    '</g>',
  ].join('\n');
}

/**
 * Levels of hierarchies with and without guards, seen from the front, `columns` beside each other.
 *
 * panels  {title, finest, level: {positions, triangles}, note}
 */
export function guardsFigure(panels, columns) {
  const { width, height, gap, left, top } = kMesh;
  const legend = (k, words, colour) => [
    `<path d="M${left + 420 + 200 * k} 22h18" stroke="${colour}" stroke-width="3"/>`,
    text(left + 444 + 200 * k, 26, words),
  ];
  const nRows = Math.ceil(panels.length / columns);
  const size = [2 * left + columns * (width + gap) - gap, top + nRows * (height + gap)];
  return picture('Coarser levels with and without guards', [left, 26], size, [
    ...legend(0, 'turned over or without area', kTurned),
    ...legend(1, 'border edge that is on no border of the cloth', kStrayed),
    ...panels.map((each, k) => meshPanel(k, columns, each)),
  ]);
}
