// A visitor of a knitted cloth can see its stitches, change its numbers, and be told which cannot be.
import { eventually, expectThat, isReady, stateOf, until } from './harness.mjs';
import { button, choice, expectAccessible, picture } from './visitor.mjs';

const numberOf = (page, title) => page.getByLabel(title, { exact: true });

async function openForm(page) {
  await numberOf(page, 'Columns').waitFor();
}

async function setNumber(page, title, value) {
  await numberOf(page, title).fill(String(value));
  await numberOf(page, title).press('Enter');
}

const hasVertices = (page, n) =>
  until(page, (state) => state.phase === 'ready' && state.summary.n_vertices === n);

export async function checkKnit({ check }, visit) {
  await check('a knit has as many particles as its form says, and its link has them', () =>
    visit('#scene=curtain', async (page) => {
      await choice(page, 'Scene').selectOption({ label: 'Wool on a ball' });
      await openForm(page);
      await hasVertices(page, 576);
      await setNumber(page, 'Columns', 12);
      await hasVertices(page, 288);
      await page.reload();
      await isReady(page);
      const { summary, problem } = await stateOf(page);
      expectThat(summary.n_vertices === 288 && problem === null, JSON.stringify(problem));
      await openForm(page);
      await button(page, 'Reset the knit').click();
      await hasVertices(page, 576);
      await button(page, 'Step').click();
      await until(page, (state) => state.numbers.step === 1 && state.problem === null);
    }),
  );

  await check('a number that no knit can have is refused in a sentence, with what can be', () =>
    visit('#scene=wool', async (page) => {
      await openForm(page);
      await setNumber(page, 'Particle mass, g', -1);
      const { problem } = await until(page, (state) => state.phase === 'refused');
      const sentence = 'Particle mass: expected a number > 0.0, got -0.001 kg.';
      expectThat(problem.sentence === sentence, problem.sentence);
      await button(page, 'Take 1 g').click();
      await until(page, (state) => state.phase === 'ready' && state.problem === null);
      await setNumber(page, 'Rows', 5000);
      const said = page.locator('.knit [role=status]');
      await eventually(async () => /at most 128/.test(await said.textContent()), 'a bound');
      expectThat((await numberOf(page, 'Rows').inputValue()) === '24', 'the number stayed');
    }),
  );

  await check('damping as printed asks for shorter explicit steps, told before any is taken', () =>
    visit('#scene=wool', async (page) => {
      await openForm(page);
      await choice(page, 'Method').selectOption({ label: 'Explicit' });
      const form = page.locator('.knit');
      await eventually(async () => /in substeps of 9\d µs/.test(await form.textContent()), 'per m');
      await choice(page, 'Unit of damping').selectOption({ label: 'N s/mm (as printed)' });
      await eventually(async () => /in substeps of 0\.13 µs/.test(await form.textContent()), 'mm');
      expectThat((await stateOf(page)).numbers.step === 0, 'it runs');
    }),
  );

  await check('lace is seen, and goes with its columns', () =>
    visit('#scene=wool', async (page) => {
      await page.getByLabel('Edges of the mesh').check();
      await openForm(page);
      await page.waitForTimeout(500);
      const laced = await picture(page);
      await setNumber(page, 'Lace columns', 0);
      await isReady(page);
      await eventually(async () => !(await picture(page)).equals(laced), 'all plain');
      await button(page, 'Reset the knit').click();
      await eventually(async () => (await picture(page)).equals(laced), 'lace again');
      await expectAccessible(page);
    }),
  );
}
