// Checks of the view of failures in a real browser.
import { expectThat, isReady, largestMove, positionsOf, stateOf, until } from './harness.mjs';
import { alertText, button, canvasOf, createVisitor, picture } from './visitor.mjs';

const isLoaded = (page) => until(page, (state) => state.phase === 'ready' && state.sides);
/** Of a side, as it is read above its pane. */
const badgeOf = (page, title) =>
  page.locator('.side-badge').filter({ hasText: title }).textContent();

export async function checkFailures(harness) {
  const { check, countColours } = harness;
  const { visit, checkAccess, checkWidths, checkWithoutModule } = createVisitor(
    harness,
    isLoaded,
    'failures: ',
  );

  await check(
    'failures: the naive cloth shows a sign and ours none, and a reset takes it back',
    () =>
      visit('#view=failures&case=rest_on_a_ball', async (page) => {
        const [naive, ours] = [await positionsOf(page, 0), await positionsOf(page, 1)];
        expectThat(largestMove(naive, ours) === 0, 'they begin in different places');
        const still = await picture(page);
        expectThat((await countColours(still)) > 100, 'the picture is blank');
        await button(page, 'Play').click();
        await until(page, (state) => state.timeS > 0.4);
        await button(page, 'Pause').click();
        const apart = largestMove(await positionsOf(page, 0), await positionsOf(page, 1));
        expectThat(apart > 0.01, `they are ${apart} m apart`);
        expectThat(!still.equals(await picture(page)), 'the picture is the same');
        const [fired, calm] = [await badgeOf(page, 'Naive'), await badgeOf(page, 'Ours')];
        expectThat(/equations left unsolved, 0\.2/.test(fired), `naive says: ${fired}`);
        expectThat(/looks right/.test(calm), `ours says: ${calm}`);
        await button(page, 'Reset').click();
        await until(page, (state) => state.phase === 'ready' && state.timeS === 0);
        expectThat(largestMove(naive, await positionsOf(page, 0)) === 0, 'it did not go back');
        expectThat(/not started/.test(await badgeOf(page, 'Naive')), 'the sign stays');
      }),
  );

  await check('failures: numbers without end never reach the screen', () =>
    visit('#view=failures&case=hundredfold_stiffness', async (page) => {
      const before = await positionsOf(page, 0);
      await canvasOf(page).focus();
      await page.keyboard.press('.');
      const { sides } = await until(page, (state) => state.timeS > 0);
      expectThat(sides.naive.ended !== null, 'the naive side goes on');
      expectThat(largestMove(before, await positionsOf(page, 0)) === 0, 'the last frame is gone');
      expectThat(/numbers without end/.test(await badgeOf(page, 'Naive')), 'no word of it');
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
  });
}
