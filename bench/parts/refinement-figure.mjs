// The figure of what refinement by example saves, drawn from the bench's own rows.
const kPanel = { width: 350, height: 300, gap: 70, left: 64, top: 64 };
const kColours = { skirt: '#17638f', trousers: '#a34d00' };
const kInk = '#333';

/** The best reductions published, in shares of vertices and times faster. */
export const kPublished = [
  { label: "another paper's dress", removed: 73.8, faster: 9 },
  { label: "the paper's trousers", removed: 76.2 },
];

const text = (x, y, words, more = '') =>
  `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" ${more}>${words.replaceAll('<', '&lt;')}</text>`;

/** Round numbers from 0 to at least `most`. */
export function ticks(most, about = 5) {
  const raw = most / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((candidate) => candidate >= raw);
  return Array.from({ length: Math.ceil(most / step - 1e-9) + 1 }, (_, k) => k * step);
}

function mark(kind, x, y, colour) {
  const place = `transform="translate(${x.toFixed(1)} ${y.toFixed(1)})"`;
  if (kind === 'plan') return `<circle ${place} r="4.5" fill="${colour}"/>`;
  if (kind === 'chosen')
    return `<circle ${place} r="7" fill="none" stroke="${colour}" stroke-width="1.5"/><circle ${place} r="4.5" fill="${colour}"/>`;
  return `<path ${place} d="M-4.5-4.5H4.5V4.5H-4.5Z" fill="none" stroke="${colour}" stroke-width="1.5"/>`;
}

function panel(index, { title, xName, points, lines, xTicks, yTicks, xUnit }) {
  const { width, height, gap, left, top } = kPanel;
  const x0 = left + index * (width + gap);
  const [xMost, yMost] = [xTicks.at(-1), yTicks.at(-1)];
  const x = (value) => x0 + (width * value) / xMost;
  const y = (value) => top + height * (1 - value / yMost);
  const parts = [text(x0, top - 14, title, 'font-weight="600"')];
  for (const tick of xTicks)
    parts.push(
      `<path d="M${x(tick)} ${top}V${top + height}" stroke="#ddd"/>`,
      text(x(tick), top + height + 16, `${tick}${xUnit}`, 'text-anchor="middle"'),
    );
  for (const tick of yTicks)
    parts.push(
      `<path d="M${x0} ${y(tick)}H${x0 + width}" stroke="#ddd"/>`,
      text(x0 - 6, y(tick) + 4, String(Number(tick.toPrecision(3))), 'text-anchor="end"'),
    );
  parts.push(text(x0 + width / 2, top + height + 34, xName, 'text-anchor="middle"'));
  for (const [k, line] of lines.entries())
    parts.push(
      `<path d="M${x(line.at)} ${top}V${top + height}" stroke="${kInk}" stroke-dasharray="4 3"/>`,
      line.at > xMost / 2
        ? text(x(line.at) - 4, top + 12 + 14 * k, line.label, 'text-anchor="end" font-size="10"')
        : text(x(line.at) + 4, top + 12 + 14 * k, line.label, 'font-size="10"'),
    );
  for (const point of points)
    if (Number.isFinite(point.x) && Number.isFinite(point.y))
      parts.push(mark(point.kind, x(point.x), y(point.y), kColours[point.garment]));
  return parts.join('\n');
}

/**
 * SVG of vertices and time saved against what a mesh loses of the fine shapes.
 *
 * points  {garment, kind: "plan" | "chosen" | "uniform", removed: %, faster, lostMm}
 * notes   lines below: what it cost beforehand
 */
export function savingsFigure(points, notes) {
  const { width, height, gap, left, top } = kPanel;
  const shown = points.filter((point) => Number.isFinite(point.lostMm));
  const yTicks = ticks(Math.max(...shown.map(({ lostMm }) => lostMm)));
  const fastest = Math.max(...shown.map(({ faster }) => faster), 9);
  const panels = [
    {
      title: 'Vertices saved',
      xName: 'vertices removed from the fine mesh',
      xTicks: ticks(100),
      xUnit: ' %',
      points: shown.map((point) => ({ ...point, x: point.removed, y: point.lostMm })),
      lines: kPublished.map(({ label, removed }) => ({
        at: removed,
        label: `${label}: ${removed} %`,
      })),
    },
    {
      title: 'Time saved',
      xName: 'times faster than the fine mesh',
      xTicks: ticks(fastest),
      xUnit: '',
      points: shown.map((point) => ({ ...point, x: point.faster, y: point.lostMm })),
      lines: kPublished
        .filter(({ faster }) => faster)
        .map(({ label, faster }) => ({ at: faster, label: `${label}: ${faster}` })),
    },
  ];
  const legendTop = top + height + 62;
  const legend = Object.entries(kColours).flatMap(([garment, colour], k) => [
    mark('plan', left + 6 + 100 * k, legendTop - 4, colour),
    text(left + 16 + 100 * k, legendTop, garment),
  ]);
  const kinds = [
    ['plan', 'refined by example'],
    ['chosen', 'the one in the table'],
    ['uniform', 'uniform mesh'],
  ].flatMap(([kind, words], k) => [
    mark(kind, left + 226 + 160 * k, legendTop - 4, kInk),
    text(left + 240 + 160 * k, legendTop, words),
  ]);
  const whole = {
    width: left + 2 * width + gap + 20,
    height: legendTop + 14 + 16 * notes.length + 8,
  };
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${whole.width} ${whole.height}" width="${whole.width}" height="${whole.height}" font-family="system-ui, sans-serif" font-size="12" fill="${kInk}">`,
    `<rect width="100%" height="100%" fill="#fff"/>`,
    text(
      left,
      22,
      'Garments refined by example: what faces lose of the fine shapes [mm]',
      'font-size="14" font-weight="600"',
    ),
    ...panels.map((each, k) => panel(k, { ...each, yTicks })),
    ...legend,
    ...kinds,
    ...notes.map((note, k) => text(left, legendTop + 20 + 16 * k, note, 'font-size="11"')),
    '</svg>',
    '',
  ].join('\n');
}
