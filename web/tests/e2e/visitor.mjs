// Acts as a visitor and reads the page, for the checks of every view.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { eventually, expectThat, until } from './harness.mjs';

const axeText = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** Only the shown view has a canvas that can be seen. */
export const canvasOf = (page) => page.locator('canvas').filter({ visible: true });
export const picture = (page) => canvasOf(page).screenshot();
export const button = (page, name) => page.getByRole('button', { name, exact: true });
export const choice = (page, name) => page.getByRole('combobox', { name, exact: true });
/** The shown view's words on what went wrong. */
export const alertText = (page) => page.getByRole('alert').filter({ visible: true }).textContent();

/** Nothing serious or critical is found by axe, once what `details` matches is opened. */
export async function expectAccessible(page, details = null) {
  for (const box of details ? await page.locator(details).all() : []) {
    await box.evaluate((element) => element.setAttribute('open', ''));
  }
  await page.evaluate(axeText);
  const { violations } = await page.evaluate(() => window.axe.run());
  const findings = violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id} at ${nodes.map((node) => node.target.join(' ')).join(', ')}`);
  expectThat(findings.length === 0, findings.join('; '));
}

/** All of it lies in the window, as it is scrolled. */
export async function expectInWindow(target) {
  const seen = await target.evaluate((element) => {
    const { top, bottom } = element.getBoundingClientRect();
    return top >= 0 && bottom <= window.innerHeight;
  });
  expectThat(seen, 'it is out of the window');
}

/** Nothing lies on its corners or its middle. */
export async function expectUncovered(target) {
  const covering = await target.evaluate((element) => {
    const { left, right, top, bottom } = element.getBoundingClientRect();
    const points = [
      [left + 1, top + 1],
      [right - 2, bottom - 2],
      [(left + right) / 2, (top + bottom) / 2],
    ];
    const seen = points.map(([x, y]) => document.elementFromPoint(x, y));
    return seen.find((one) => !element.contains(one))?.className ?? null;
  });
  expectThat(covering === null, `it is covered by ${covering}`);
}

/**
 * Visits to one view, which is there once `isReady` of its page, and the checks that every view is
 * put to. `prefix` begins their names.
 */
export function createVisitor({ open, check }, isReady, prefix = '') {
  /** Runs `work` on a page at `hash`; whatever it does, the console has to stay empty. */
  async function visit(hash, work, options) {
    const { page, complaints, close } = await open(hash, options);
    try {
      await isReady(page);
      await work(page);
      expectThat(complaints.length === 0, `console: ${complaints.join(' | ')}`);
    } finally {
      await close();
    }
  }

  async function checkAccess(hash, details) {
    await check(`${prefix}axe finds nothing serious, light and dark`, () =>
      visit(hash, async (page) => {
        for (const colorScheme of ['light', 'dark']) {
          await page.emulateMedia({ colorScheme });
          await twoPictures(page);
          await expectAccessible(page, details);
        }
      }),
    );
  }

  /** One visit, in windows of these sizes one after another. */
  async function checkSizes(title, hash, sizes, work) {
    const [[firstWidth, firstHeight]] = sizes;
    const inAll = async (page) => {
      for (const [width, height] of sizes) {
        await page.setViewportSize({ width, height });
        await twoPictures(page);
        await work(page, `${width} px`);
      }
    };
    await check(`${prefix}${title}`, () =>
      visit(hash, inAll, { width: firstWidth, height: firstHeight }),
    );
  }

  async function checkWidths(hash, sizes) {
    await checkSizes('nothing scrolls sideways', hash, sizes, async (page) => {
      const [content, view] = await page.evaluate(() => [
        document.documentElement.scrollWidth,
        window.innerWidth,
      ]);
      expectThat(content <= view, `${content} px of content in ${view} px`);
    });
  }

  /** A sentence tells that WebAssembly is missing; `work` looks at what is left, and once it can be had again. */
  async function checkWithoutModule(hash, what, work) {
    await check(`${prefix}without its WebAssembly file a sentence, and ${what}`, async () => {
      const files = '**/pleat*.wasm';
      const { page, close } = await open(hash, {
        prepare: (fresh) => fresh.context().route(files, (route) => route.abort()),
      });
      try {
        await until(page, (state) => state.phase === 'broken');
        const sentence = await alertText(page);
        expectThat(/WebAssembly/.test(sentence), `it says: ${sentence}`);
        await page.context().unroute(files);
        await work(page);
      } finally {
        await close();
      }
    });
  }

  return { visit, checkAccess, checkSizes, checkWidths, checkWithoutModule };
}

/** The view of motion works, whatever became of the one that was shown first. */
export async function expectMotionWorks(page) {
  await page.getByRole('link', { name: /Speed and error/ }).click();
  await until(page, (state) => state.setting && state.phase === 'ready');
}

/** Another picture than `before` is seen, at once or soon. */
export const expectOtherPicture = (page, before) =>
  eventually(async () => !before.equals(await picture(page)), 'another picture');

/** Two more pictures are drawn: what was laid out anew has its size by then. */
const twoPictures = (page) =>
  page.evaluate(
    () => new Promise((resume) => requestAnimationFrame(() => requestAnimationFrame(resume))),
  );

/** Place of a vertex of the first pane on the page, once it is the same in two pictures. */
export async function placeOn(page, vertex) {
  const place = async () => {
    await twoPictures(page);
    const at = await page.evaluate((v) => window.pleat.project(v), vertex);
    const box = await canvasOf(page).boundingBox();
    return { x: box.x + at.x, y: box.y + at.y };
  };
  let [before, now] = [await place(), await place()];
  const isStill = () => Math.hypot(now.x - before.x, now.y - before.y) < 0.5;
  for (let look = 0; look < 20 && !isStill(); ++look) {
    before = now;
    now = await place();
  }
  return now;
}

/** A screen that is touched. */
export const PHONE = { width: 390, height: 844, hasTouch: true, isMobile: true };

/** Fingers: what they do, and the place of each that touches the screen then. */
export async function createTouch(page) {
  const session = await page.context().newCDPSession(page);
  return (type, ...touchPoints) => session.send('Input.dispatchTouchEvent', { type, touchPoints });
}

/** A square cloth of `size` metres that stands upright, in a text of two triangles a cell. */
export function squareObj(size, cells = 6) {
  const at = (row, column) => row * (cells + 1) + column + 1;
  const lines = [];
  for (let row = 0; row <= cells; ++row)
    for (let column = 0; column <= cells; ++column)
      lines.push(`v ${(size * column) / cells} ${size * (2 - row / cells)} 0`);
  for (let row = 0; row < cells; ++row)
    for (let column = 0; column < cells; ++column) {
      const [a, b, c, d] = [
        at(row, column),
        at(row + 1, column),
        at(row + 1, column + 1),
        at(row, column + 1),
      ];
      lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
    }
  return `${lines.join('\n')}\n`;
}

/** Drops a file on the page, as a visitor's hand does. */
export async function drop(page, name, text) {
  const transfer = await page.evaluateHandle(
    ([fileName, content]) => {
      const made = new DataTransfer();
      made.items.add(new File([content], fileName));
      return made;
    },
    [name, text],
  );
  await canvasOf(page).dispatchEvent('dragover', { dataTransfer: transfer });
  await canvasOf(page).dispatchEvent('drop', { dataTransfer: transfer });
}
