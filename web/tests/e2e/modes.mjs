// Checks of the view of modes in a real browser.
import { eventually, expectThat, largestMove, positionsOf, stateOf, until } from './harness.mjs';
import {
  alertText,
  button,
  canvasOf,
  choice,
  createVisitor,
  drop,
  expectInWindow,
  expectMotionWorks,
  picture,
  placeOn,
  squareObj,
} from './visitor.mjs';

/** The body, its modes and its in-betweens are there. */
const isFound = (page) =>
  until(page, (state) => state.phase === 'ready' && state.found && state.completion);

export async function checkModes(harness) {
  const { check, countColours } = harness;
  const { visit, checkAccess, checkSizes, checkWidths, checkWithoutModule } = createVisitor(
    harness,
    isFound,
    'modes: ',
  );

  await check('modes: loads still, a bar half way between its keys beside a pinched ghost', () =>
    visit('#view=modes&show=keys', async (page) => {
      const { keys, time, completion, ghost } = await stateOf(page);
      expectThat(keys.length === 2 && time === 0.5 && ghost, `${keys.length} keys at ${time}`);
      const rest = completion.frames[0].volume_m3;
      const { volume_m3, straight_volume_m3 } = completion.frames[8];
      expectThat(Math.abs(volume_m3 / rest - 1) < 0.02, `it has ${volume_m3} m³ of ${rest}`);
      expectThat(straight_volume_m3 / rest < 0.9, 'the ghost is not pinched');
      const [before, still] = [await positionsOf(page), await picture(page)];
      expectThat((await countColours(still)) > 100, 'the picture is blank');
      expectThat(await page.getByText('Pull me').filter({ visible: true }).isVisible(), 'no word');
      await page.waitForTimeout(300);
      expectThat(largestMove(before, await positionsOf(page)) === 0, 'it moves unasked');
      await page.getByLabel('Straight ghost').uncheck();
      await eventually(async () => !still.equals(await picture(page)), 'the ghost is gone');
    }),
  );

  await check('modes: opens on a mode, which a drag bends and which keeps its volume', () =>
    visit('#view=modes', async (page) => {
      const { showing, amplitudes } = await stateOf(page);
      expectThat(showing === 'modes' && amplitudes[0] > 0, `${showing}, ${amplitudes}`);
      const badge = page.locator('.energy-badge').filter({ visible: true }).first();
      for (const mode of [1, 2, 7]) {
        await page.getByRole('button', { name: new RegExp(`^${mode} ?[\\d.]+ Hz`) }).click();
        await page.waitForTimeout(100);
        const words = await badge.textContent();
        const change = Number(/by ([\d.]+)/.exec(words)?.[1] ?? 0);
        expectThat(/volume|swells|shrinks/.test(words) && change <= 2, `mode ${mode}: ${words}`);
      }
      const before = await positionsOf(page);
      const { x, y } = await placeOn(page, await page.evaluate(() => window.pleat.inviting()));
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x, y - 40, { steps: 5 });
      await eventually(
        async () => largestMove(before, await positionsOf(page)) > 0.01,
        'a drag bends it',
      );
      await page.mouse.up();
    }),
  );

  await check('modes: a worker that ends is noticed, said and replaced', () =>
    visit('#view=modes&cells=2&mix=3:0.5', async (page) => {
      await page.workers()[0].evaluate(() => self.close());
      await until(page, (state) => state.problem !== null, 5000);
      const sentence = await alertText(page);
      expectThat(/ended by itself.*started again/.test(sentence), sentence);
      const { amplitudes, keys } = await isFound(page);
      expectThat(amplitudes[2] === 0.5 && keys.length === 2, 'it is another body');
      await page.getByRole('button', { name: /^2 ?[\d.]+ Hz/ }).click();
      await until(page, (state) => state.amplitudes[1] !== 0 && state.phase === 'ready');
    }),
  );

  await check('modes: plays along its keys and swings a mode, in positions and in pixels', () =>
    visit('#view=modes&cells=2', async (page) => {
      for (const showing of ['Key frames', 'Modes']) {
        await page.getByRole('radio', { name: showing, exact: true }).check({ force: true });
        const [before, still] = [await positionsOf(page), await picture(page)];
        await button(page, 'Play').click();
        await eventually(
          async () => largestMove(before, await positionsOf(page)) > 0.02,
          `${showing} play`,
        );
        expectThat(!still.equals(await picture(page)), 'the picture is the same');
        await button(page, 'Pause').click();
      }
      await eventually(async () => {
        const [paused, pictured] = [await positionsOf(page), await picture(page)];
        await page.waitForTimeout(200);
        const stands = largestMove(paused, await positionsOf(page)) === 0;
        return stands && pictured.equals(await picture(page));
      }, 'it stands still');
    }),
  );

  await check('modes: a slider mixes a mode in; a mode alone needs one press', () =>
    visit('#view=modes&cells=2&show=modes&mix=', async (page) => {
      const [before, still] = [await positionsOf(page), await picture(page)];
      const slider = page.getByLabel('Amplitude of mode 3', { exact: true });
      const { x, y, width, height } = await slider.boundingBox();
      await page.mouse.move(x + width / 2, y + height / 2);
      await page.mouse.down();
      await page.mouse.move(x + 0.8 * width, y + height / 2, { steps: 4 });
      await page.mouse.up();
      await until(page, (state) => state.amplitudes[2] > 0.3);
      expectThat(largestMove(before, await positionsOf(page)) > 0.01, 'the body stays');
      await eventually(async () => !still.equals(await picture(page)), 'another picture');
      await slider.focus();
      await page.keyboard.press('Home');
      await until(page, (state) => state.amplitudes[2] === -1);
      await page.getByRole('button', { name: /^2 ?[\d.]+ Hz/ }).click();
      await until(page, ({ amplitudes }) => amplitudes[1] > 0 && amplitudes[2] !== -1);
    }),
  );

  await check('modes: a hand bends the body, or leads it along its keys', () =>
    visit('#view=modes&cells=2&show=keys&time=0', async (page) => {
      const pull = async (dx, dy, during) => {
        const vertex = await page.evaluate(() => window.pleat.inviting());
        const { x, y } = await placeOn(page, vertex);
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + dx, y + dy, { steps: 5 });
        await during();
        await page.mouse.up();
      };
      await pull(40, -50, () => until(page, (state) => state.time > 0.1));
      await page.getByRole('radio', { name: 'Modes', exact: true }).check({ force: true });
      await button(page, 'All to zero').click();
      const before = await positionsOf(page);
      await pull(0, -30, () => until(page, ({ amplitudes }) => amplitudes.some((a) => a !== 0)));
      expectThat(largestMove(before, await positionsOf(page)) > 0.01, 'it does not bend');
    }),
  );

  await check('modes: keys are kept, replaced and deleted, and the timeline follows', () =>
    visit('#view=modes&cells=2&mix=2:0.5', async (page) => {
      await button(page, 'Keep as key').click();
      await until(
        page,
        (state) => state.keys.length === 3 && state.completion.frames.length === 33,
      );
      await button(page, '2 Mix').waitFor();
      await page.getByLabel('Amplitude of mode 1', { exact: true }).fill('40');
      await button(page, 'Replace').click();
      await until(page, ({ keys }) => keys[1].origin.amplitudes[0] === 0.4);
      await page.getByLabel('Amplitude of mode 1', { exact: true }).fill('-70');
      await button(page, '2 Mix').click(); // whose mix the sliders take up
      await until(page, ({ amplitudes }) => amplitudes[0] === 0.4 && amplitudes[1] === 0.5);
      await page.getByLabel('Time, in keys').fill('1.5');
      await until(page, (state) => state.time === 1.5 && state.showing === 'keys');
      await button(page, 'Delete').click();
      await until(
        page,
        (state) => state.keys.length === 2 && state.completion.frames.length === 17,
      );
      expectThat(await button(page, 'Delete').isDisabled(), 'two keys are not the least');
      const timeline = page.getByRole('region', { name: 'Timeline' });
      for (const word of ['Volume [%', 'Energy', '[J]', 'half way'])
        expectThat((await timeline.textContent()).includes(word), `no ${word}`);
    }),
  );

  await check('modes: the draped cloth has hertz of its own fabric and shares of its drape', () =>
    visit('#view=modes&model=cloth', async (page) => {
      const { found, drapeShares } = await stateOf(page);
      expectThat(
        found.modes.every(({ hz }) => hz > 0.1 && hz < 100),
        'a mode has no frequency',
      );
      expectThat(drapeShares.at(-1) > drapeShares[0], 'shares do not climb');
      await page.getByRole('radio', { name: 'Both', exact: true }).check({ force: true });
      const { modes } = (await until(page, (state) => state.compares && state.found)).found;
      expectThat(
        modes.every(({ hz }) => hz === null),
        'a shell has hertz',
      );
      const list = await page.getByRole('region', { name: 'Modes', exact: true }).textContent();
      expectThat(/thickness is made up/.test(list), `it says: ${list}`);
    }),
  );

  await check('modes: a reload restores model, mix, keys and time', () =>
    visit(
      '#view=modes&cells=2&energy=surface&count=6&mix=2:-0.4&time=0.25&ghost=off&keys=rest;bent-90;surface-3:0.5',
      async (page) => {
        const before = [await stateOf(page), await positionsOf(page)];
        await page.reload();
        await isFound(page);
        const after = [await stateOf(page), await positionsOf(page)];
        for (const key of ['model', 'cells', 'energy', 'count', 'amplitudes', 'time', 'ghost']) {
          const [a, b] = [before, after].map(([state]) => JSON.stringify(state[key]));
          expectThat(a === b, `${key} was ${a}, is ${b}`);
        }
        expectThat(after[0].amplitudes[1] === -0.4 && !after[0].ghost, 'it is not as in the link');
        expectThat(after[0].keys.length === 3, `${after[0].keys.length} keys`);
        expectThat(largestMove(before[1], after[1]) < 1e-6, 'the shape is another');
      },
    ),
  );

  await check('modes: an OBJ file has modes; a bad one is a sentence and the body stays', () =>
    visit('#view=modes&cells=2&show=modes', async (page) => {
      await drop(page, 'banner.obj', squareObj(1));
      await until(page, (state) => state.model === 'own' && state.phase === 'ready');
      await isFound(page);
      const before = await positionsOf(page);
      expectThat(before.length === 3 * 49, 'it has other vertices');
      await drop(page, 'torn.obj', `${squareObj(1)}f 1 2 999\n`);
      await until(page, (state) => state.problem !== null);
      const sentence = await alertText(page);
      expectThat(/torn\.obj: line \d+: expected/.test(sentence), `it says: ${sentence}`);
      expectThat((await stateOf(page)).model === 'own', 'the body is another');
      await button(page, 'Dismiss').click();
      await page.getByText('The volume that carries it').click();
      await choice(page, 'Volume').selectOption({ label: 'Cubes inside' });
      await until(
        page,
        ({ problem, volume, phase, completion }) =>
          /closed surface/.test(problem?.what) &&
          volume === 'auto' &&
          phase === 'ready' &&
          completion,
      );
      await page.getByLabel('OBJ files of keys').setInputFiles({
        name: 'small.obj',
        mimeType: 'model/obj',
        buffer: Buffer.from(squareObj(1, 3)),
      });
      await until(page, (state) => /expected a key with the 49 vertices/.test(state.problem?.what));
    }),
  );

  await check('modes: what takes long says so and is given up; the body before comes back', () =>
    visit('#view=modes&cells=2&mix=3:0.5', async (page) => {
      await drop(page, 'large.obj', squareObj(1, 90));
      await page.getByRole('progressbar', { name: 'Computing' }).waitFor();
      await button(page, 'Cancel').click();
      const { model, amplitudes, working } = await until(
        page,
        (state) => state.model === 'bar' && state.phase === 'ready' && state.completion,
      );
      expectThat(working === null, `it is at ${working}`);
      expectThat(amplitudes[2] === 0.5, `${model} with ${amplitudes}`);
    }),
  );

  await check('modes: a first visit of the page fetches nothing of it', async () => {
    const { page, close } = await harness.open('');
    await until(page, (state) => state.phase === 'ready' && state.ahead === null);
    const names = await page.evaluate(() =>
      performance.getEntriesByType('resource').map(({ name }) => name),
    );
    const own = names.filter((name) => /\/(mod(al|es)|pleat-rest)-/.test(name));
    expectThat(own.length === 0 && names.length > 2, `of ${names.length}: ${own.join()}`);
    await close();
  });

  await check('modes: keys play, step and choose, only with the stage in focus', () =>
    visit('#view=modes&cells=2&show=keys', async (page) => {
      await page.keyboard.press('Space');
      expectThat(!(await stateOf(page)).playing, 'space played without the focus');
      await canvasOf(page).focus();
      await page.keyboard.press('.');
      await until(page, (state) => Math.abs(state.time - 0.55) < 1e-9);
      await page.keyboard.press('m');
      await until(page, (state) => state.showing === 'modes');
      await page.keyboard.press('4');
      await until(page, ({ amplitudes }) => amplitudes[3] > 0 && amplitudes[0] === 0);
      await page.keyboard.press('k');
      await until(page, (state) => state.keys.length === 3);
      await page.keyboard.press('Space');
      await until(page, (state) => state.playing);
    }),
  );

  await check('modes: a broken link gives defaults and a message', () =>
    visit('#view=modes&model=moon&mix=1:7', async (page) => {
      const sentence = await alertText(page);
      for (const part of ['model:', 'mix:'])
        expectThat(sentence.includes(part), `it says: ${sentence}`);
      expectThat((await stateOf(page)).model === 'bar', 'it shows something else');
    }),
  );

  await checkSizes(
    'Play is in sight',
    '#view=modes&cells=2',
    [
      [390, 844],
      [1280, 800],
    ],
    (page) => expectInWindow(button(page, 'Play')),
  );

  await checkSizes(
    'no name of a key is cut',
    '#view=modes&model=cloth&show=keys',
    [[390, 844]],
    async (page, size) => {
      const cut = await page
        .locator('.key-mark span')
        .evaluateAll((names) =>
          names
            .filter((name) => name.scrollWidth > name.clientWidth + 1 || name.clientWidth === 0)
            .map((name) => name.textContent),
        );
      expectThat(cut.length === 0, `${cut.join(', ')} at ${size}`);
    },
  );

  await checkAccess('#view=modes&cells=2', '#modes details');

  await checkWidths('#view=modes&cells=2', [
    [320, 568],
    [390, 844],
    [720, 700],
    [1440, 900],
  ]);

  await checkWithoutModule('#view=modes', 'once it comes other views work', expectMotionWorks);
}
