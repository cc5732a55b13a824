// The built page, served and opened in a headless browser; one line for every check.
import { chromium } from 'playwright-core';
import { preview } from 'vite';

const SWITCHES = [
  '--no-sandbox',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-dev-shm-usage',
  '--disable-gpu-compositing', // software composes a page at less cost without its WebGL
];

/** Words of the driver on a canvas that is composed by software. */
const READ_BACK = /GPU stall due to ReadPixels/;

/** Software rendering on a busy machine is slow, not broken [ms]. */
const PATIENCE_MS = 60000;

export async function createHarness() {
  const server = await preview({ preview: { port: 0 }, logLevel: 'error' });
  const address = server.resolvedUrls.local[0];
  const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: SWITCHES });
  const blank = await browser.newPage();
  let passed = 0;
  const failures = [];
  const visits = new Set();

  /** A page at a link, with what its console said. */
  async function open(hash, { width = 1280, height = 800, prepare, ...options } = {}) {
    // Without animations, a picture changes only when the cloth or the view does.
    const reducedMotion = 'reduce';
    const viewport = { width, height };
    const context = await browser.newContext({ viewport, reducedMotion, ...options });
    visits.add(context);
    const page = await context.newPage();
    const complaints = [];
    page.on('console', (message) => {
      if (READ_BACK.test(message.text())) return;
      complaints.push(`${message.type()}: ${message.text()}`);
    });
    page.on('pageerror', (error) => complaints.push(`exception: ${error.message}`));
    page.setDefaultTimeout(PATIENCE_MS);
    await prepare?.(page);
    await page.goto(address + hash);
    const close = async () => {
      visits.delete(context);
      await context.close();
    };
    return { page, complaints, close };
  }

  /** Why `work` failed, or null; no page of it stays open. */
  async function failureOf(work) {
    try {
      await work();
      return null;
    } catch (error) {
      return error.message.split('\n').slice(0, 3).join(' ');
    } finally {
      for (const context of visits) await context.close();
      visits.clear();
    }
  }

  /** A browser that shares its cores may miss a moment: what fails is asked once more, and both are told. */
  async function check(name, work) {
    const begin = performance.now();
    const first = await failureOf(work);
    const second = first && (await failureOf(work));
    const seconds = `${((performance.now() - begin) / 1000).toFixed(1)} s`;
    if (second) {
      failures.push(`${name}: ${second}`);
      console.log(`FAILED  ${name}: ${second} (twice, ${seconds}; first: ${first})`);
      return;
    }
    passed += 1;
    console.log(`ok      ${name} (${seconds}${first ? `; not at first: ${first}` : ''})`);
  }

  /** Number of different colours in a picture. */
  async function countColours(png) {
    return blank.evaluate(
      async (text) => {
        const picture = await createImageBitmap(await (await fetch(text)).blob());
        const canvas = new OffscreenCanvas(picture.width, picture.height);
        const context = canvas.getContext('2d');
        context.drawImage(picture, 0, 0);
        const { data } = context.getImageData(0, 0, picture.width, picture.height);
        return new Set(new Uint32Array(data.buffer)).size;
      },
      `data:image/png;base64,${png.toString('base64')}`,
    );
  }

  /** How many of these places of a picture have a colour, [red, green, blue], within some pixels. */
  async function countAt(png, places, colour) {
    return blank.evaluate(
      async ([text, at, wanted]) => {
        const REACH_PX = 2;
        const MOST_OFF = 12;
        const picture = await createImageBitmap(await (await fetch(text)).blob());
        const canvas = new OffscreenCanvas(picture.width, picture.height);
        const context = canvas.getContext('2d');
        context.drawImage(picture, 0, 0);
        const isThere = ({ x, y }) => {
          const side = 2 * REACH_PX + 1;
          const [left, top] = [Math.round(x) - REACH_PX, Math.round(y) - REACH_PX];
          const { data } = context.getImageData(left, top, side, side);
          for (let byte = 0; byte < data.length; byte += 4)
            if (wanted.every((part, k) => Math.abs(data[byte + k] - part) < MOST_OFF)) return true;
          return false;
        };
        return at.filter(isThere).length;
      },
      [`data:image/png;base64,${png.toString('base64')}`, places, colour],
    );
  }

  async function finish() {
    await browser.close();
    await server.close();
    for (const failure of failures) console.log(`FAILED  ${failure}`);
    console.log(`${passed} passed, ${failures.length} failed`);
    return failures.length === 0;
  }

  return { open, check, countColours, countAt, finish };
}

export function expectThat(condition, sentence) {
  if (!condition) throw new Error(sentence);
}

export const stateOf = (page) => page.evaluate(() => window.pleat.state());
/** Positions in one pane of a view with panes. */
export const positionsOf = (page, pane = 0) =>
  page.evaluate((at) => window.pleat.positions(at), pane);

/** Waits until `probe`, asked again and again, answers true. */
export async function eventually(probe, what, patienceMs = PATIENCE_MS) {
  const end = performance.now() + patienceMs;
  while (!(await probe())) {
    if (performance.now() > end) throw new Error(`waited in vain: ${what}`);
    await new Promise((resume) => setTimeout(resume, 50));
  }
}

/** Waits until what `look` sees on the page is something that fulfils `test`. */
async function untilSeen(page, look, given, test, patienceMs) {
  let seen = null;
  await eventually(
    async () => {
      seen = await page.evaluate(look, given);
      return seen !== null && test(seen);
    },
    test.toString(),
    patienceMs,
  );
  return seen;
}

/** Waits until the page's state fulfils `test`. */
export const until = (page, test, patienceMs = PATIENCE_MS) =>
  untilSeen(page, () => window.pleat?.state() ?? null, null, test, patienceMs);

/**
 * Waits as `until` does, and tells the places and the words of `selector` at the very moment of that state:
 * what is read a moment later may be of another one.
 */
export const momentUntil = (page, test, selector = 'title') =>
  untilSeen(
    page,
    (at) => ({
      state: window.pleat.state(),
      places: window.pleat.positions(0),
      words: document.querySelector(at)?.textContent ?? '',
    }),
    selector,
    ({ state }) => test(state),
    PATIENCE_MS,
  );

export const isReady = (page) =>
  until(page, (state) => state.phase === 'ready' && state.ahead === null);

/** Largest distance that a vertex moved between two sets of positions [m]. */
export function largestMove(before, after) {
  let most = 0;
  for (let v = 0; v < before.length; v += 3) {
    const move = Math.hypot(
      after[v] - before[v],
      after[v + 1] - before[v + 1],
      after[v + 2] - before[v + 2],
    );
    most = Math.max(most, move);
  }
  return most;
}
