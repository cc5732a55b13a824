// Methods compared on one step: the button, the plot, its values and its words.
import { eventually, expectThat } from './harness.mjs';
import { button, choice, expectAccessible, PHONE } from './visitor.mjs';

const START = 'Compare methods on this step';

async function openComparison(page) {
  await page.getByText('Convergence: one step by every method').click();
  await button(page, START).waitFor();
}

/** The marks of the plot by their methods, as [rounds, what is left]: a power of ten is small. */
const waysOf = (page) =>
  page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll('.convergence-plot g[data-title]')].map((way) => [
        way.dataset.title,
        [...way.querySelectorAll('.way-point')].map((mark) =>
          /after (\d+) rounds?: .* ms, (\S+) left/
            .exec(mark.getAttribute('aria-label'))
            .slice(1)
            .map((text) => (text.includes('·') ? 1e-4 : Number(text))),
        ),
      ]),
    ),
  );

const reading = (page) => page.locator('.convergence .reading');

export async function checkConvergence({ check }, visit) {
  await check('methods are compared on a step, drawn, told in words, and read along a way', () =>
    visit(
      '#scene=swinging-sheet&level=0&start=0.25&stepper=multigrid&smoother=sor',
      async (page) => {
        await openComparison(page);
        await button(page, START).click();
        await page.locator('.convergence-plot').waitFor();
        const ways = await waysOf(page);
        const titles = Object.keys(ways).join();
        expectThat(
          titles === 'XPBD,PBD,Hierarchical PBD,Multigrid PBD,Multigrid PBD, as set',
          titles,
        );
        for (const [title, points] of Object.entries(ways)) {
          const rounds = points.map(([count]) => count);
          expectThat(
            [1, 2, 3, 5].every((count) => rounds.includes(count)),
            `${title}: ${rounds}`,
          );
          const [[, first]] = points;
          const [, last] = points.at(-1);
          expectThat(last < first && first < 1, `${title} leaves ${first} and then ${last}`);
        }
        // The usual cycles reach a hundredth in a few rounds, sweeps of one level do not.
        const roundsTo = (title, left) => ways[title].find((point) => point[1] <= left)?.[0];
        expectThat(roundsTo('Multigrid PBD', 0.01) <= 9, 'multigrid is slow');
        expectThat(roundsTo('PBD', 0.01) > 9, 'sweeps of one level are quick');
        const words = await reading(page).textContent();
        expectThat(/^First to 0\.1 is .*, after .* ms/.test(words), words);
        const first = page.locator('g[data-title=PBD] .way-point').first();
        await first.focus();
        await page.keyboard.press('ArrowRight');
        const values = await page.locator('.way-values').textContent();
        expectThat(/^PBD after 2 rounds: .* ms, .* left\.$/.test(values), values);
        const isWide = () => document.documentElement.scrollWidth > window.innerWidth;
        expectThat(!(await page.evaluate(isWide)), 'the page scrolls sideways');
        await expectAccessible(page, '.convergence details');
      },
      PHONE,
    ),
  );

  await check('a comparison stops at once, and says what it cannot compare', () =>
    visit('#scene=curtain&level=1', async (page) => {
      await openComparison(page);
      await choice(page, 'Springs').selectOption('Compliant');
      await button(page, START).click();
      await button(page, 'Cancel').click();
      await button(page, START).waitFor();
      expectThat((await reading(page).textContent()) === '', 'it says something');
      await page.getByLabel('Membrane and fitted bending').check();
      await button(page, START).click();
      await eventually(
        async () => /cannot be studied: \/model/.test(await reading(page).textContent()),
        'a sentence',
      );
      expectThat(!(await page.locator('.convergence-plot').isVisible()), 'there is a plot');
    }),
  );
}
