// Coarser levels over the cloth, and the details of the methods that have them.
import { eventually, expectThat, isReady, stateOf, until } from './harness.mjs';
import { button, choice, expectAccessible, picture, placeOn } from './visitor.mjs';

/** Least share of the marks that is seen: some lie behind the cloth. */
const SEEN = 0.5;

const hasLevels = (page) =>
  until(page, ({ phase, coarseLevels }) => phase === 'ready' && coarseLevels !== null);

/** Places of the vertices that the first level keeps, in pixels of the picture. */
const keptPlaces = (page) =>
  page.evaluate(() => {
    const [{ vertices }] = window.pleat.state().coarseLevels.levels;
    return Array.from(vertices, (vertex) => window.pleat.project(vertex));
  });

const keptColour = (page) =>
  page.evaluate(() => {
    const text = getComputedStyle(document.documentElement).getPropertyValue('--level-kept').trim();
    return [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16));
  });

async function openLevels(page) {
  await page.getByText('Levels: coarser meshes of the cloth').click();
  await choice(page, 'Level').waitFor();
}

export async function checkLevels({ check, countAt }, visit) {
  /** The share of kept vertices that have their mark where they are seen. */
  const sharedMarks = async (page) => {
    const colour = await keptColour(page);
    const places = await keptPlaces(page);
    return (await countAt(await picture(page), places, colour)) / places.length;
  };

  await check('a level is chosen, drawn, told in words, and off again', () =>
    visit('#scene=curtain&level=1', async (page) => {
      const plain = await picture(page);
      await openLevels(page);
      await choice(page, 'Level').selectOption('2');
      await hasLevels(page);
      const legend = page.getByRole('group', { name: 'Coarser level' });
      await legend.waitFor();
      expectThat(
        /^Level 2kept: 18left out of level 1: 54/.test(await legend.textContent()),
        await legend.textContent(),
      );
      const words = page.locator('.coarse [aria-live]');
      expectThat(
        /^Level 2 keeps 18 vertices/.test(await words.textContent()),
        await words.textContent(),
      );
      await eventually(async () => !(await picture(page)).equals(plain), 'the picture is another');
      await choice(page, 'Made as by').selectOption({ label: 'Hierarchical PBD' });
      await until(
        page,
        (state) => state.coarseLevels?.levels[0]?.vertices && state.coarseAs === 'hpbd',
      );
      await expectAccessible(page);
      await choice(page, 'Level').selectOption('Off');
      await eventually(async () => (await picture(page)).equals(plain), 'the picture as before');
      expectThat(!(await legend.isVisible()), 'the legend stays');
    }),
  );

  await check('marks of a level are on its vertices, after a drag too, and after a reload', () =>
    visit('#scene=swinging-sheet&level=1&stepper=multigrid&coarse=1', async (page) => {
      await hasLevels(page);
      await eventually(async () => (await sharedMarks(page)) > SEEN, 'marks at the start');
      const [before, colour] = [await keptPlaces(page), await keptColour(page)];
      const { x, y } = await placeOn(page, await page.evaluate(() => window.pleat.inviting()));
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x + 40, y - 90, { steps: 4 });
      await until(page, (state) => state.held && state.numbers.time_s > 0.4);
      await page.mouse.up();
      await button(page, 'Pause').click();
      await until(page, (state) => !state.held && !state.playing);
      await eventually(async () => (await sharedMarks(page)) > SEEN, 'marks after the drag');
      const left = (await countAt(await picture(page), before, colour)) / before.length;
      expectThat(left < SEEN, `${left} of the marks are where they were`);
      await page.reload();
      await isReady(page);
      await hasLevels(page);
      expectThat((await stateOf(page)).coarse === 1, 'the level is another');
      await eventually(async () => (await sharedMarks(page)) > SEEN, 'marks after the reload');
    }),
  );

  await check('an OBJ mesh has levels too, of both kinds', () =>
    visit('#scene=obj&coarse=3&coarse_as=hpbd', async (page) => {
      const count = async () => {
        const { coarseLevels } = await hasLevels(page);
        return coarseLevels.levels.length;
      };
      expectThat((await count()) === 3, 'thinned');
      await choice(page, 'Made as by').selectOption({ label: 'Multigrid PBD' });
      await until(page, (state) => state.coarseAs === 'multigrid');
      expectThat((await count()) === 3, 'by quadrics');
    }),
  );

  await check('details of a method change it, stand in the link, and go back to the usual', () =>
    visit('#scene=free-fall-drape&level=0', async (page) => {
      await page.getByText('More of this method').click();
      expectThat(!(await page.getByLabel('Omega, factor of corrections').isVisible()), 'an omega');
      await choice(page, 'Smoother').selectOption({ label: 'SOR' });
      await page.getByLabel('Omega, factor of corrections').fill('1.3');
      await page.getByLabel('Coarser levels, number').fill('2');
      await page.getByLabel('Coarser levels, number').press('Enter');
      await until(page, ({ phase, setting }) => phase === 'ready' && setting.details?.levels === 2);
      await page.reload();
      await isReady(page);
      const { setting, problem } = await stateOf(page);
      expectThat(problem === null, problem?.sentence);
      const wanted = '{"levels":2,"smoother":"sor","omega":1.3}';
      expectThat(JSON.stringify(setting.details) === wanted, JSON.stringify(setting.details));
      await button(page, 'Step').click();
      await until(page, (state) => state.numbers.step === 1 && state.problem === null);
      await button(page, 'As usual').click();
      await until(page, (state) => state.phase === 'ready' && state.setting.details === undefined);
      await expectAccessible(page);
    }),
  );
}
