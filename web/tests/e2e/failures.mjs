// Checks of the view of failures in a real browser.
import { expectThat, isReady, largestMove, positionsOf, stateOf, until } from './harness.mjs';
import { alertText, button, canvasOf, createVisitor, expectInWindow, picture } from './visitor.mjs';

/** A picture that is drawn soon, without a graphics card. */
const SMALL = { width: 760, height: 420 };

/** Cases by the warnings that lead to them. */
const LED_TO = {
  stretch: 'gathered_curtain',
  soft: 'gathered_curtain',
  speed: 'long_step',
  unsolved: 'heavy_bead',
};

const isLoaded = (page) => until(page, (state) => state.phase === 'ready' && state.sides);
/** Words of a side, read above its pane. */
const badgeOf = (page, title) =>
  page.locator('.side-badge').filter({ hasText: title }).textContent();

export async function checkFailures(harness) {
  const { check, countColours } = harness;
  const { visit, checkAccess, checkSizes, checkWidths, checkWithoutModule } = createVisitor(
    harness,
    isLoaded,
    'failures: ',
  );

  async function withMotion(hash, work) {
    const { page, close } = await harness.open(hash);
    await isReady(page);
    await work(page);
    await close();
  }

  await check('failures: each case shows its sign within 2 s, ours none, and a reset ends it', () =>
    visit(
      '#view=failures',
      async (page) => {
        const titles = await page.locator('.case-list button').allTextContents();
        expectThat(titles.length === 10, `${titles.length} cases`);
        await until(page, (state) => state.timeS > 0); // the first is shown later than its start
        for (const title of [...titles.slice(1), ...titles.slice(0, 1)]) {
          await button(page, title).click();
          await until(page, (state) => state.phase === 'ready' && state.timeS === 0);
          const [naive, ours] = [await positionsOf(page, 0), await positionsOf(page, 1)];
          expectThat(naive.length >= 3 * 625, `${title}: ${naive.length / 3} vertices`);
          expectThat(largestMove(naive, ours) === 0, `${title}: they begin in different places`);
          expectThat((await countColours(await picture(page))) > 100, `${title}: a blank picture`);
          await button(page, 'Play').click();
          await until(page, (state) => state.timeS > 0 && !state.playing);
          const [fired, calm] = [await badgeOf(page, 'Naive'), await badgeOf(page, 'Ours')];
          const since = Number(/from ([\d.]+) s on/.exec(fired)?.[1] ?? Number.NaN);
          expectThat(since <= 2, `${title}: naive says ${fired}`);
          expectThat(/looks right/.test(calm), `${title}: ours says ${calm}`);
          const apart = largestMove(await positionsOf(page, 0), await positionsOf(page, 1));
          expectThat(apart > 0.05, `${title}: they are ${apart} m apart`);
          await button(page, 'Reset').click();
          await until(page, (state) => state.phase === 'ready' && state.timeS === 0);
          expectThat(largestMove(naive, await positionsOf(page, 0)) === 0, `${title}: no way back`);
          expectThat(/not started/.test(await badgeOf(page, 'Naive')), `${title}: the sign stays`);
        }
      },
      SMALL,
    ),
  );

  await check('failures: a hand takes the cloth in either pane, and play goes on', () =>
    visit('#view=failures&case=tumbling', async (page) => {
      const box = await canvasOf(page).boundingBox();
      for (const pane of [0, 1]) {
        await button(page, 'Reset').click();
        await until(page, (state) => state.phase === 'ready' && state.timeS === 0);
        const before = await positionsOf(page, pane);
        const vertex = before.length / 3 - 13; // middle of the last row
        const at = await page.evaluate(([v, p]) => window.pleat.project(v, p), [vertex, pane]);
        const [x, y] = [box.x + at.x, box.y + at.y];
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + 20, y - 80, { steps: 4 });
        await until(page, (state) => state.playing && state.timeS > 0.3);
        const after = await positionsOf(page, pane);
        const up = after[3 * vertex + 1] - before[3 * vertex + 1];
        const other = (await positionsOf(page, 1 - pane))[3 * vertex + 1] - before[3 * vertex + 1];
        await page.mouse.up();
        expectThat(up > 0.05 && other < 0.05, `pane ${pane}: up by ${up} m, the other ${other} m`);
        await button(page, 'Pause').click();
      }
    }),
  );

  await check('failures: a worker that ends is noticed, said and replaced', () =>
    visit('#view=failures&case=rest_on_a_ball', async (page) => {
      for (const worker of [0, 1]) {
        await button(page, 'Play').click();
        await until(page, (state) => state.timeS > 0.1);
        await page.workers()[worker].evaluate(() => self.close());
        await until(page, (state) => state.problem !== null, 5000);
        const sentence = await alertText(page);
        expectThat(/ended by itself.*started again.*back at their start/.test(sentence), sentence);
        await until(page, (state) => state.phase === 'ready' && state.timeS === 0);
        await button(page, 'Dismiss').click();
      }
      await button(page, 'Play').click();
      await until(page, (state) => state.timeS > 0.1);
    }),
  );

  await check('failures: a warning of the view of motion leads to its case', () =>
    withMotion('#scene=tablecloth&level=2&stepper=xpbd&substeps=1', async (page) => {
      await button(page, 'Play').click();
      const { problem } = await until(page, (state) => state.problem?.warning);
      await page.getByRole('link', { name: 'See why' }).click();
      const { caseId } = await isLoaded(page);
      const shown = page.locator('.case-list button[aria-pressed="true"]');
      expectThat((await shown.textContent()) !== '', 'no case is chosen');
      expectThat(caseId === LED_TO[problem.warning], `${problem.warning} leads to ${caseId}`);
      expectThat(page.url().includes(`case=${caseId}`), `${problem.warning}: ${page.url()}`);
    }),
  );

  await check('failures: opens on a curtain that has failed, and stands still', () =>
    visit('#view=failures', async (page) => {
      const { timeS, playing } = await until(page, (state) => state.timeS > 0);
      expectThat(Math.abs(timeS - 1) < 1e-6 && !playing, `at ${timeS} s, playing: ${playing}`);
      expectThat(/stretched beyond its load/.test(await badgeOf(page, 'Naive')), 'no sign');
      expectThat(/looks right/.test(await badgeOf(page, 'Ours')), 'ours fails');
    }),
  );

  await check('failures: another case is a press away, and in the address', () =>
    visit('#view=failures', async (page) => {
      await button(page, 'A bead on a net').click();
      await until(page, (state) => state.caseId === 'heavy_bead' && state.phase === 'ready');
      await page.waitForFunction(() => window.location.hash.includes('case=heavy_bead'));
      await page.reload();
      await isLoaded(page);
      expectThat((await stateOf(page)).caseId === 'heavy_bead', 'it is forgotten');
    }),
  );

  await check('failures: a broken link gives the first case and a message', () =>
    visit('#view=failures&case=moon', async (page) => {
      expectThat(/case: expected one of/.test(await alertText(page)), await alertText(page));
    }),
  );

  await check('failures: a first visit of the page fetches nothing of it', async () => {
    const { page, close } = await harness.open('');
    await isReady(page);
    const names = await page.evaluate(() =>
      performance.getEntriesByType('resource').map(({ name }) => name),
    );
    const own = names.filter((name) => /failures-/.test(name));
    expectThat(own.length === 0 && names.length > 2, `of ${names.length}: ${own.join()}`);
    await close();
  });

  await checkSizes(
    'Play is in sight',
    '#view=failures',
    [
      [390, 844],
      [1280, 800],
    ],
    (page) => expectInWindow(button(page, 'Play')),
  );

  await checkAccess('#view=failures', '#failures details');

  await checkWidths('#view=failures', [
    [320, 568],
    [390, 844],
    [720, 700],
    [1440, 900],
  ]);

  await checkWithoutModule('#view=failures', 'its words stay', async (page) => {
    const words = await page.locator('#failures').textContent();
    expectThat(/What breaks cloth/.test(words), 'the cases are gone');
    await button(page, 'Try again').click();
    await isLoaded(page);
  });
}
