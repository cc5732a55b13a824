// npm run picture: the README's picture, docs/views.png, from the built page: its five views, two above
// three. A chart stands beside the cloth whose sweep made it.
import { writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { crc32, deflateSync } from 'node:zlib';
import { isFound } from './fabrics.mjs';
import { createHarness, eventually, isReady, stateOf, until } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/views.png', import.meta.url));
const WIDTH_PX = 1440;
const GAP_PX = 8;
/** Colours are this far apart, so that shading packs well. */
const COLOUR_STEP = 6;
const SWEEP_MS = 240000;

/** Each view at its link, what it is waited for, and how many share its row. */
const VIEWS = [
  {
    hash: '#scene=tablecloth&fabric=silk&level=1&start=1.6',
    perRow: 2,
    async show(page) {
      await isReady(page);
      await page.getByLabel('Cloth to measure').selectOption({ label: 'The scene shown' });
      await page.getByRole('button', { name: 'Measure speed and error' }).click();
      const isSwept = ({ sweep }) => sweep.phase !== 'running' && sweep.rows.length > 0;
      await until(page, isSwept, SWEEP_MS);
      await eventually(async () => (await stateOf(page)).phase === 'ready', 'the cloth is back');
      await page.locator('#stage').evaluate((stage) => stage.scrollIntoView());
    },
  },
  {
    hash: '#view=refinement',
    perRow: 2,
    show: (page) =>
      until(
        page,
        ({ phase, panes }) => phase === 'ready' && panes.planned.lostM !== null,
        SWEEP_MS,
      ),
  },
  { hash: '#view=fabrics&scene=pull&gallery=on', perRow: 3, show: isFound },
  {
    hash: '#view=modes',
    perRow: 3,
    show: (page) =>
      until(page, (state) => state.phase === 'ready' && state.found && state.completion, SWEEP_MS),
  },
  {
    hash: '#view=failures&case=rest_on_a_ball',
    perRow: 3,
    async show(page) {
      await until(page, (state) => state.phase === 'ready' && state.sides);
      await page.getByRole('button', { name: 'Play', exact: true }).click();
      await until(page, (state) => state.timeS > 0.8);
      await page.getByRole('button', { name: 'Pause', exact: true }).click();
    },
  },
];

/** Draws pictures beside one another, left to right and downwards, in the browser; its colours. */
async function puzzle([tiles, width, gap, colourStep]) {
  const pictures = await Promise.all(
    tiles.map(async ({ text }) => {
      const picture = new Image();
      picture.src = text;
      await picture.decode();
      return picture;
    }),
  );
  let [x, y] = [0, 0];
  const places = tiles.map(({ perRow }, k) => {
    const across = (width - (perRow - 1) * gap) / perRow;
    const down = (across * pictures[k].height) / pictures[k].width;
    const place = [x, y, across, down];
    x += across + gap;
    if (x > width) [x, y] = [0, y + down + gap];
    return place;
  });
  const height = Math.round(y - gap);
  const context = new OffscreenCanvas(width, height).getContext('2d');
  context.fillStyle = 'white';
  context.fillRect(0, 0, width, height);
  context.imageSmoothingQuality = 'high';
  for (const [k, place] of places.entries()) context.drawImage(pictures[k], ...place);
  const rgb = context
    .getImageData(0, 0, width, height)
    .data.filter((_, byte) => byte % 4 < 3)
    .map((part) => colourStep * Math.round(part / colourStep));
  return { width, height, rgb: new Uint8Array(rgb.buffer).toBase64() };
}

/** A PNG file, its rows unfiltered. */
function pngOf({ width, height, rgb }) {
  const pixels = Buffer.from(rgb, 'base64');
  const rows = Buffer.alloc(height * (3 * width + 1));
  for (let y = 0; y < height; ++y)
    pixels.copy(rows, y * (3 * width + 1) + 1, 3 * width * y, 3 * width * (y + 1));
  const chunk = (name, data) => {
    const named = Buffer.concat([Buffer.from(name), data]);
    return Buffer.concat([uint32(data.length), named, uint32(crc32(named))]);
  };
  return Buffer.concat([
    Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]),
    chunk('IHDR', Buffer.concat([uint32(width), uint32(height), Buffer.from([8, 2, 0, 0, 0])])),
    chunk('IDAT', deflateSync(rows, { level: 9 })),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}

function uint32(number) {
  const bytes = Buffer.alloc(4);
  bytes.writeUInt32BE(number);
  return bytes;
}

const harness = await createHarness();
const tiles = [];
for (const { hash, perRow, show } of VIEWS) {
  const { page, close } = await harness.open(hash, {
    width: 1240,
    height: perRow === 2 ? 930 : 775,
  });
  await show(page);
  const png = await page.screenshot();
  tiles.push({ text: `data:image/png;base64,${png.toString('base64')}`, perRow });
  await close();
}
const { page, close } = await harness.open('');
writeFileSync(target, pngOf(await page.evaluate(puzzle, [tiles, WIDTH_PX, GAP_PX, COLOUR_STEP])));
await close();
await harness.finish();
