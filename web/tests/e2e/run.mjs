// The page in a real browser: `npm run e2e` after `npm run build`.
import { readFileSync } from 'node:fs';
import { checkConvergence } from './convergence.mjs';
import { checkFabrics } from './fabrics.mjs';
import { checkFailures } from './failures.mjs';
import {
  createHarness,
  eventually,
  expectThat,
  isReady,
  largestMove,
  momentUntil,
  positionsOf,
  stateOf,
  until,
} from './harness.mjs';
import { checkKnit } from './knit.mjs';
import { checkLevels } from './levels.mjs';
import { checkModes } from './modes.mjs';
import { checkMotion } from './motion.mjs';
import { checkRefinement } from './refinement.mjs';
import { checkSweepTable } from './sweep-table.mjs';
import { checkTearing } from './tearing.mjs';
import {
  button,
  canvasOf,
  choice,
  createTouch,
  createVisitor,
  drop,
  expectAccessible,
  PHONE,
  picture,
  placeOn,
  squareObj,
} from './visitor.mjs';

/** A whole sweep may take this long on a busy machine [ms]. */
const SWEEP_MS = 300000;

const diverging = JSON.parse(
  readFileSync(new URL('../support/diverging.json', import.meta.url), 'utf8'),
);
const harness = await createHarness();
const { open, check, countColours, finish } = harness;

const { visit, checkAccess, checkWidths, checkWithoutModule } = createVisitor(harness, isReady);

for (const preset of [
  'curtain',
  'swags',
  'tablecloth',
  'swinging-sheet',
  'free-fall-drape',
  'wind',
  'ball',
  'wool',
  'obj',
]) {
  await check(`${preset}: loads still, then moves, in positions and in pixels`, () =>
    visit(`#scene=${preset}`, async (page) => {
      const [before, still] = [await positionsOf(page), await picture(page)];
      expectThat((await stateOf(page)).numbers.time_s === 0, 'the cloth moved before play');
      expectThat((await countColours(still)) > 100, 'the picture is blank');
      await button(page, 'Play').click();
      await until(page, (state) => state.numbers.time_s > 0.4);
      await button(page, 'Pause').click();
      const move = largestMove(before, await positionsOf(page));
      expectThat(move > 0.01, `the cloth moved ${move} m`);
      expectThat(!still.equals(await picture(page)), 'the picture is the same');
    }),
  );
}

await check('first visit: runs ahead to a draped curtain and stands still', () =>
  visit('', async (page) => {
    const { numbers, playing } = await stateOf(page);
    expectThat(numbers.time_s > 0.1 && !playing, `at ${numbers.time_s} s, playing: ${playing}`);
    const before = await positionsOf(page);
    await page.waitForTimeout(300);
    expectThat(largestMove(before, await positionsOf(page)) === 0, 'the cloth moves unasked');
  }),
);

await check('a start time in the link is met to the step, whatever a step costs', () =>
  visit('#scene=curtain&level=0&start=0.7', async (page) => {
    const { numbers } = await stateOf(page);
    expectThat(numbers.step === 42, `step ${numbers.step} instead of 42`);
  }),
);

await check('a drag pulls the cloth, starts it, and lets go', () =>
  visit('#scene=curtain', async (page) => {
    const vertex = await page.evaluate(() => window.pleat.inviting());
    const at = await placeOn(page, vertex);
    const before = await positionsOf(page);
    const { x, y } = at;
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 60, y - 40, { steps: 4 });
    await until(page, (state) => state.held && state.playing && state.numbers.time_s > 0.3);
    const after = await positionsOf(page);
    await page.mouse.up();
    await until(page, (state) => !state.held);
    const part = (positions) => positions.slice(3 * vertex, 3 * vertex + 3);
    const move = largestMove(part(before), part(after));
    expectThat(move > 0.05, `the held corner moved ${move} m`);
  }),
);

await check('a pull beyond what cloth bears is told in the moment, and is no explosion', () =>
  visit('#scene=curtain', async (page) => {
    const { x, y } = await placeOn(page, await page.evaluate(() => window.pleat.inviting()));
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 250, y + 250, { steps: 8 });
    const { state, words } = await momentUntil(
      page,
      ({ held, numbers: now }) => held && now.asked_stretch > 1.1,
      '.verdict',
    );
    const { numbers } = state;
    expectThat(/^You pull it to [\d.]+ times its length/.test(words), words);
    expectThat(numbers.largest_stretch < 0.35, `it is stretched by ${numbers.largest_stretch}`);
    await page.mouse.up();
    await until(page, (shown) => !shown.held && shown.numbers.time_s > numbers.time_s + 2.5);
    const { problem } = await stateOf(page);
    expectThat(problem === null, `it says: ${problem?.sentence}`);
  }),
);

await check('a finger pulls the cloth, and its loss lets go', () =>
  visit(
    '#scene=curtain&level=1',
    async (page) => {
      const at = await placeOn(page, await page.evaluate(() => window.pleat.inviting()));
      const by = (dx, dy) => ({ x: at.x + dx, y: at.y + dy });
      const touch = await createTouch(page);
      await touch('touchStart', by(0, 0));
      await touch('touchMove', by(-20, -30));
      await touch('touchMove', by(-40, -60));
      await until(page, (state) => state.held && state.numbers.time_s > 0.2);
      await touch('touchCancel');
      await until(page, (state) => !state.held);
    },
    PHONE,
  ),
);

await check('a hand stops at the floor, in a scene that has none for the cloth', () =>
  visit('#scene=tablecloth&level=0', async (page) => {
    const vertex = await page.evaluate(() => window.pleat.inviting());
    const { x, y } = await placeOn(page, vertex);
    const box = await canvasOf(page).boundingBox();
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x, box.y + box.height + 200, { steps: 4 });
    const heightOf = async () => (await positionsOf(page))[3 * vertex + 1];
    await until(page, (state) => state.held && state.numbers.time_s > 0.2);
    const isAtFloor = async () => Math.abs(await heightOf()) < 1e-3;
    await eventually(isAtFloor, 'the held corner is at the floor');
    // It stays there while the pointer is below.
    const { numbers } = await stateOf(page);
    await eventually(
      async () => (await stateOf(page)).numbers.time_s > numbers.time_s + 0.2,
      'the cloth goes on',
    );
    const height = await heightOf();
    await page.mouse.up();
    expectThat(Math.abs(height) < 1e-3, `the held corner is at ${height} m`);
  }),
);

await check('two fingers beside the cloth zoom, and leave the cloth alone', () =>
  visit(
    '#scene=tablecloth&level=0',
    async (page) => {
      const box = await page.locator('canvas').boundingBox();
      const before = await positionsOf(page);
      const corners = [0, before.length / 3 - 1];
      const widthOnScreen = async () => {
        const [a, b] = await page.evaluate((vs) => vs.map((v) => window.pleat.project(v)), corners);
        return Math.hypot(a.x - b.x, a.y - b.y);
      };
      const touch = await createTouch(page);
      const beside = (offset, id) => ({
        x: box.x + box.width / 2 + offset,
        y: box.y + box.height - 12,
        id,
      });
      const send = (type, ...offsets) => touch(type, ...offsets.map(beside));
      const pinch = async (from, to) => {
        await send('touchStart', -from, from);
        for (const part of [1 / 3, 2 / 3, 1]) {
          const half = from + part * (to - from);
          await send('touchMove', -half, half);
        }
        await send('touchEnd');
      };
      const start = await widthOnScreen();
      await pinch(60, 120);
      const closer = await widthOnScreen();
      expectThat(closer > 1.5 * start, `apart: ${start} px became ${closer} px`);
      await pinch(120, 60);
      const back = await widthOnScreen();
      expectThat(Math.abs(back / start - 1) < 0.1, `and together: ${back} px, not ${start} px`);
      expectThat(largestMove(before, await positionsOf(page)) === 0, 'the cloth moved');
      expectThat(!(await stateOf(page)).held, 'the cloth is held');
    },
    PHONE,
  ),
);

await check('a drag off the cloth turns the view and leaves the cloth alone', () =>
  visit('#scene=curtain', async (page) => {
    const [positions, still] = [await positionsOf(page), await picture(page)];
    const box = await page.locator('canvas').boundingBox();
    await page.mouse.move(box.x + 20, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + 120, box.y + 40, { steps: 3 });
    await page.mouse.up();
    expectThat(!still.equals(await picture(page)), 'the view did not turn');
    expectThat(largestMove(positions, await positionsOf(page)) === 0, 'the cloth moved');
    await button(page, 'View').click();
    await eventually(async () => still.equals(await picture(page)), 'the first view');
  }),
);

await check('keys play, step, reset, turn, take and let go, only with the stage in focus', () =>
  visit('#scene=curtain&level=1', async (page) => {
    await page.keyboard.press('Space');
    expectThat(!(await stateOf(page)).playing, 'space played without the focus');
    await page.locator('canvas').focus();
    await page.keyboard.press('.');
    await until(page, (state) => state.numbers.step === 1);
    await page.keyboard.press('g');
    await until(page, (state) => state.held && state.playing);
    for (let press = 0; press < 5; ++press) await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Escape');
    await until(page, (state) => !state.held);
    await page.keyboard.press('Space');
    await until(page, (state) => !state.playing);
    await page.keyboard.press('r');
    await until(page, (state) => state.phase === 'ready' && state.numbers.time_s === 0);
  }),
);

await check('an OBJ file, chosen or dropped, becomes the cloth, and stays over other scenes', () =>
  visit('#scene=obj', async (page) => {
    expectThat((await stateOf(page)).mesh.name === 'skirt.obj', 'the skirt is not shown');
    await page.getByLabel('OBJ file').setInputFiles({
      name: 'banner.obj',
      mimeType: 'model/obj',
      buffer: Buffer.from(squareObj(1)),
    });
    await until(page, (state) => state.mesh.name === 'banner.obj' && state.phase === 'ready');
    expectThat((await positionsOf(page)).length === 3 * 49, 'it has other vertices');
    await choice(page, 'Scene').selectOption({ label: 'Curtain' });
    await isReady(page);
    await drop(page, 'small.obj', squareObj(0.01, 4));
    await until(page, (state) => state.mesh.name === 'small.obj' && state.phase === 'ready');
    const note = await page.locator('.mesh').textContent();
    expectThat(/threads run downward/.test(note) && /no link carries it/.test(note), note);
    await choice(page, 'Scene').selectOption({ label: 'Tablecloth on a ball' });
    await isReady(page);
    await choice(page, 'Scene').selectOption({ label: 'Your OBJ' });
    await isReady(page);
    expectThat((await stateOf(page)).mesh.name === 'small.obj', 'it is gone');
  }),
);

for (const size of [0.01, 100]) {
  await check(`a mesh of ${size} m fills the picture as one of a metre does, and moves`, () =>
    visit('#scene=obj', async (page) => {
      const spanOnScreen = async () => {
        const [a, b] = await page.evaluate(() => [0, 48].map((v) => window.pleat.project(v)));
        return Math.hypot(a.x - b.x, a.y - b.y);
      };
      await drop(page, 'metre.obj', squareObj(1));
      await until(page, (state) => state.mesh.name === 'metre.obj' && state.phase === 'ready');
      await picture(page);
      const expected = await spanOnScreen();
      await drop(page, 'scaled.obj', squareObj(size));
      await until(page, (state) => state.mesh.name === 'scaled.obj' && state.phase === 'ready');
      expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
      const span = await spanOnScreen();
      expectThat(Math.abs(span / expected - 1) < 0.01, `${span} px instead of ${expected} px`);
      const before = await positionsOf(page);
      await choice(page, 'Held by').selectOption({ label: 'Nothing' });
      await isReady(page);
      await button(page, 'Play').click();
      // A centimetre of cloth is on its floor within a step, where it crumples, and is told of.
      const seenS = size < 1 ? 0.04 : 0.2;
      await until(page, ({ numbers }) => numbers.time_s > seenS);
      const move = largestMove(before, await positionsOf(page));
      expectThat(move > 0.001 * size, `it moved ${move} m`);
    }),
  );
}

await check('a mesh in millimetres is noticed, and its unit can be chosen', () =>
  visit('#scene=obj', async (page) => {
    await drop(page, 'banner.obj', squareObj(950));
    await until(page, (state) => state.mesh.name === 'banner.obj' && state.phase === 'ready');
    const note = await page.locator('.mesh').textContent();
    expectThat(/It is 950 m across.*probably the millimetre/.test(note), `it says: ${note}`);
    await choice(page, 'Unit of the file').selectOption('millimetres');
    await until(page, (state) => state.mesh.unit === 'mm' && state.phase === 'ready');
    const highest = Math.max(...(await positionsOf(page)));
    expectThat(Math.abs(highest - 1.9) < 1e-5, `the highest place is ${highest} m`);
  }),
);

await check('a large OBJ file shows that it is read, is given up, and the cloth goes on', () =>
  visit('#scene=curtain&level=1', async (page) => {
    await drop(page, 'large.obj', squareObj(1, 300));
    await page.getByRole('progressbar', { name: 'Reading the file' }).waitFor();
    await button(page, 'Step').click();
    await until(page, (state) => state.numbers.step === 1);
    await button(page, 'Cancel').click();
    const { reading, setting, problem } = await stateOf(page);
    expectThat(reading === null && setting.preset === 'curtain', 'it goes on');
    expectThat(problem === null, `it says: ${problem?.sentence}`);
  }),
);

await check('a bad OBJ file is a sentence with its line, and the cloth goes on', () =>
  visit('#scene=tablecloth&level=1', async (page) => {
    await button(page, 'Play').click();
    await until(page, (state) => state.numbers.time_s > 0.1);
    await drop(page, 'torn.obj', `${squareObj(1)}f 1 2 999\n`);
    const alert = page.getByRole('alert');
    await alert.waitFor();
    const sentence = await alert.textContent();
    expectThat(/torn\.obj: line 122: expected/.test(sentence), `it says: ${sentence}`);
    const { setting, numbers, phase } = await stateOf(page);
    expectThat(setting.preset === 'tablecloth' && phase === 'ready', 'the scene is another');
    await until(page, (state) => state.playing && state.numbers.time_s > 0.3);
    expectThat(numbers.time_s > 0.1, 'it started anew');
    await button(page, 'Dismiss').click();
    await drop(page, 'shirt.stl', 'solid');
    await until(page, (state) => /no OBJ file/.test(state.problem?.sentence));
  }),
);

await check('the model changes, disables what cannot run it, and stands in the link', () =>
  visit('#scene=curtain&level=0&stepper=xpbd', async (page) => {
    await page.getByLabel('Membrane and fitted bending').check();
    await isReady(page);
    const { setting, summary } = await stateOf(page);
    expectThat(setting.stepper === 'implicit' && summary.n_springs === 0, 'springs are left');
    const xpbd = choice(page, 'Method').locator('option', { hasText: 'XPBD' });
    expectThat(await xpbd.isDisabled(), 'XPBD can be chosen');
    expectThat(/needs springs/.test(await xpbd.textContent()), 'no reason is given');
    for (const stepper of ['Newton (exact, slow)', 'Runge-Kutta 4']) {
      await choice(page, 'Method').selectOption({ label: stepper });
      await isReady(page);
      await button(page, 'Step').click();
      await until(page, (state) => state.numbers.step > 0 && state.problem === null);
    }
    await page.reload();
    await isReady(page);
    const after = (await stateOf(page)).setting;
    expectThat(after.model === 'membrane' && after.stepper === 'rk4', JSON.stringify(after));
    await choice(page, 'Scene').selectOption({ label: 'Your OBJ' });
    await isReady(page);
    expectThat(await page.getByLabel('Springs', { exact: true }).isDisabled(), 'mesh of springs');
  }),
);

await check('heat map: legend with unit and ends, pixels change', () =>
  visit('#scene=swinging-sheet&level=1', async (page) => {
    const still = await picture(page);
    await choice(page, 'Colour shows').selectOption({ index: 1 });
    const legend = page.getByLabel('Colour scale');
    await legend.waitFor();
    expectThat(/%/.test(await legend.textContent()), 'the legend has no unit');
    expectThat(!still.equals(await picture(page)), 'the picture is the same');
    await choice(page, 'Scale').selectOption({ label: 'up to 5 %' });
    await eventually(async () => /5\.0 %/.test(await legend.textContent()), 'the fixed end');
  }),
);

await check('a reference tells how far off the cloth is, in words and as a heat map', () =>
  visit('#scene=swinging-sheet&heat=distance', async (page) => {
    await until(page, (state) => state.numbers.reference !== null);
    const verdict = page.locator('.verdict');
    expectThat(/has a reference/.test(await verdict.textContent()), 'it is not announced');
    const legend = page.getByLabel('Colour scale');
    await eventually(async () => /mm/.test(await legend.textContent()), 'the legend in mm');
    await button(page, 'Play').click();
    await until(page, (state) => state.numbers.time_s > 0.3);
    await button(page, 'Pause').click();
    const sentence = await verdict.textContent();
    expectThat(/mm from the reference \(known to/.test(sentence), `it says: ${sentence}`);
    await until(page, ({ heatScale, numbers }) => heatScale.most > numbers.reference.distance_m);
    await page.locator('canvas').focus();
    await page.keyboard.press('g');
    await page.keyboard.press('Escape');
    await eventually(async () => /pulled or changed/.test(await verdict.textContent()), 'a hand');
    await button(page, 'Pause').click();
    await choice(page, 'Fabric').selectOption({ index: 5 });
    await isReady(page);
    expectThat(/nobody has measured/.test(await verdict.textContent()), 'silk has a reference');
    const option = choice(page, 'Colour shows').locator('option', { hasText: 'Distance' });
    expectThat(await option.isDisabled(), 'distance can be chosen');
  }),
);

await check('fabric, level and stepper change while it moves, and the motion goes on', () =>
  visit('#scene=tablecloth&level=1', async (page) => {
    await button(page, 'Play').click();
    await until(page, (state) => state.numbers.time_s > 0.2);
    const change = async (act) => {
      const { numbers, summary } = await stateOf(page);
      await act();
      await until(page, (state) => state.phase === 'ready' && state.playing);
      await until(page, (state) => state.numbers.time_s > numbers.time_s);
      return summary;
    };
    await change(() => choice(page, 'Fabric').selectOption({ index: 5 }));
    const before = await change(() => page.getByLabel('Level 2').check({ force: true }));
    expectThat(
      (await stateOf(page)).summary.n_vertices > before.n_vertices,
      'the mesh is the same',
    );
    for (const stepper of ['Projective', 'XPBD', 'Explicit', 'Runge-Kutta 4']) {
      await change(() => choice(page, 'Method').selectOption({ label: stepper }));
    }
    const { problem, setting } = await stateOf(page);
    expectThat(problem === null, `problem: ${problem?.sentence}`);
    expectThat(setting.fabric === 'silk' && setting.stepper === 'rk4', 'wrong setting');
  }),
);

await check('a setting that cannot run is a sentence, and the page goes on', () =>
  visit('#scene=curtain&level=1', async (page) => {
    await choice(page, 'Method').selectOption({ label: 'Explicit' });
    await isReady(page);
    await page.getByRole('spinbutton', { name: 'Substeps' }).fill('1');
    await page.getByRole('spinbutton', { name: 'Substeps' }).press('Enter');
    await until(page, (state) => state.phase === 'refused');
    const sentence = await page.getByRole('alert').textContent();
    expectThat(/substeps/.test(sentence), `the sentence is: ${sentence}`);
    await page.getByRole('spinbutton', { name: 'Substeps' }).fill('0');
    await page.getByRole('spinbutton', { name: 'Substeps' }).press('Enter');
    await isReady(page);
    expectThat((await stateOf(page)).problem === null, 'the sentence stays');
  }),
);

await check(
  'a run that diverges says where, keeps its last frame, and a reset brings it back',
  () =>
    visit(
      '#scene=swinging-sheet&level=0&stepper=explicit',
      async (page) => {
        const start = await positionsOf(page);
        await button(page, 'Play').click();
        await until(page, (state) => state.phase === 'stopped');
        const banner = page.getByRole('alert');
        const sentence = await banner.textContent();
        expectThat(
          /stopped in step 13, .*vertex \d+.* It was last at \(/.test(sentence),
          `it says: ${sentence}`,
        );
        const last = await positionsOf(page);
        expectThat(last.every(Number.isFinite), 'the frame is not finite');
        expectThat(largestMove(start, last) > 1e-6, 'the frame is not the last good one');
        await banner.getByRole('button', { name: 'Reset' }).click();
        await isReady(page);
        await banner.waitFor({ state: 'hidden' });
        expectThat(largestMove(start, await positionsOf(page)) === 0, 'it is not at its start');
        await button(page, 'Step').click();
        await until(page, (state) => state.numbers.step === 1);
      },
      {
        // No setting of the page diverges: the scene is changed on its way to the worker, to sink
        // slowly through thick air until its edge is torn up.
        prepare: (fresh) =>
          fresh.addInitScript((change) => {
            const { postMessage } = Worker.prototype;
            Worker.prototype.postMessage = function post(letter, transfer) {
              const { message } = letter;
              if (message?.type === 'load') {
                const scene = { ...JSON.parse(message.sceneText), ...change };
                message.sceneText = JSON.stringify(scene);
              }
              postMessage.call(this, letter, transfer);
            };
          }, diverging),
      },
    ),
);

await check(
  'after some play cost in parts and stretch are read out, and what is left unsolved',
  () =>
    visit('#scene=curtain&level=2', async (page) => {
      await button(page, 'Play').click();
      await until(page, (state) => state.timing !== null && state.timing.parts.length > 0);
      const text = await page.locator('.numbers').textContent();
      for (const word of ['ms', '%', 'RMS', 'Vertices', 'Fabric', 'Error']) {
        expectThat(text.includes(word), `no ${word} in: ${text}`);
      }
      const details = page.locator('#panel details', { hasText: 'Left unsolved' });
      await details.locator('summary').click();
      const left = await details.textContent();
      expectThat(/Left unsolved: [\d.]+ %, after \d+ iterations\./.test(left), left);
    }),
);

await check('the sweep fills chart and table, and a click on a point runs it to its time', () =>
  visit('#scene=swinging-sheet&fabric=silk&level=0', async (page) => {
    await choice(page, 'Cloth to measure').selectOption({ label: 'The scene shown' });
    await choice(page, 'Levels').selectOption({ index: 0 });
    await button(page, 'Measure speed and error').click();
    await page.getByRole('progressbar').waitFor();
    await until(page, (state) => state.sweep.rows.length >= 2);
    expectThat((await page.locator('.point').count()) >= 2, 'no points while it runs');
    await until(page, (state) => state.sweep.phase !== 'running', SWEEP_MS);
    const { sweep } = await stateOf(page);
    expectThat(sweep.phase === 'done', `the sweep ended as ${sweep.phase}: ${sweep.message}`);
    expectThat(sweep.rows.length === 20, `${sweep.rows.length} rows`);
    const others = sweep.rows.filter((row) => row.status !== 'ok');
    expectThat(others.length === 0, `not ok: ${others.map((row) => row.message).join('; ')}`);
    expectThat((await page.locator('.rows tbody tr').count()) === 20, 'the table differs');
    const cut = await page
      .locator('.table-box')
      .evaluate((box) => box.scrollWidth - box.clientWidth);
    expectThat(cut <= 0, `the table is cut by ${cut} px`);
    const fronts = await page
      .locator('polyline.front')
      .evaluateAll((lines) => lines.map((line) => line.getAttribute('points')));
    expectThat(
      fronts.some((corners) => corners.split(' ').length >= 2),
      'no front is a line',
    );
    const caption = await page.locator('#tray').textContent();
    expectThat(/Method’s error \[mm\]/.test(caption), 'the axis does not say whose error it is');
    expectThat(/not known here/.test(caption), 'nothing is said of the mesh');
    expectThat((await page.locator('.floor').count()) === 0, 'a mesh has an error all the same');
    const point = page.locator('[data-stepper="xpbd"]').first();
    const row = sweep.rows[Number(await point.getAttribute('data-row'))];
    await point.dispatchEvent('click');
    await isReady(page);
    const { setting, numbers } = await stateOf(page);
    expectThat(setting.stepper === 'xpbd' && setting.level === row.level, 'not applied');
    expectThat(Math.abs(numbers.time_s - 0.4) < 1e-9, `it was run to ${numbers.time_s} s`);
    expectThat((await page.locator('.point-ring').count()) === 1, 'the point is not ringed');
    const strip = await page.locator('.numbers').textContent();
    expectThat(!strip.includes('unknown'), 'the error is not in the read-out');
    await expectAccessible(page);
  }),
);

await check('a sweep of the swinging sheet as it is tells what its mesh does wrong', () =>
  visit('#scene=swinging-sheet&level=0', async (page) => {
    await button(page, 'Measure speed and error').click();
    await until(page, (state) => state.sweep.phase === 'done', SWEEP_MS);
    const { sweep } = await stateOf(page);
    expectThat(sweep.meshError === 'known', `it is ${sweep.meshError}`);
    expectThat((await page.locator('.floor').count()) >= 1, 'no mesh has a line');
    const answer = await page.locator('#tray h2').textContent();
    expectThat(
      /^One level finer: .* falls from .* level 0 to .* level 1/.test(answer),
      `it says: ${answer}`,
    );
    await expectAccessible(page);
  }),
);

await check('the first sweep is of the sheet whose errors are known, beside the cloth', () =>
  visit('', async (page) => {
    await button(page, 'Measure speed and error').click();
    await until(page, (state) => state.sweep.phase === 'done', SWEEP_MS);
    const { sweep } = await stateOf(page);
    expectThat(sweep.meshError === 'known', `it is ${sweep.meshError}`);
    expectThat(
      sweep.rows.some((row) => row.method.stepper === 'multigrid'),
      'multigrid takes no part',
    );
    const near = sweep.front.filter((index) => sweep.rows[index].position_error_m < 0.05);
    await page.locator(`.point[data-row="${near[0]}"]`).dispatchEvent('click');
    await isReady(page);
    const { setting } = await stateOf(page);
    expectThat(setting.preset === 'swinging-sheet', `the cloth is the ${setting.preset}`);
    const read = await page.locator('.verdict').textContent();
    expectThat(/exact motion on a finer mesh/.test(read), `it says: ${read}`);
    const [stage, plot] = [
      await page.locator('#stage').boundingBox(),
      await page.locator('#tray .plot').boundingBox(),
    ];
    expectThat(stage.height > 300 && stage.x + stage.width <= plot.x, 'the chart hides the cloth');
    expectThat(plot.y + plot.height <= 800, 'the chart is cut off');
  }),
);

for (const [width, height] of [
  [720, 450],
  [390, 844],
]) {
  await check(`in ${width} by ${height}, a sweep brings its chart whole into view`, () =>
    visit(
      '#scene=swinging-sheet&level=0',
      async (page) => {
        const plot = page.locator('#tray .plot');
        const isInView = async () =>
          plot.evaluate((drawing) => {
            const { top, bottom } = drawing.getBoundingClientRect();
            const column = drawing.closest('.left').getBoundingClientRect();
            return top >= Math.max(column.top, 0) && bottom <= window.innerHeight;
          });
        await button(page, 'Measure speed and error').click();
        await until(page, (state) => state.sweep.phase === 'done', SWEEP_MS);
        await eventually(isInView, 'the chart is in view', 2000);
        const table = await page.locator('#tray .table-box').boundingBox();
        expectThat(table.height > 100, `the table is ${table.height} px high`);
        const isWide = (box) => box.scrollWidth > box.clientWidth;
        expectThat(!(await page.locator('html').evaluate(isWide)), 'the page scrolls sideways');
        expectThat(!(await page.locator('#tray .table-box').evaluate(isWide)), 'the table is cut');
        await page.getByText(/settings measured/).waitFor();
        await button(page, 'Show the chart').click();
        await eventually(isInView, 'the chart is in view again', 2000);
      },
      { width, height },
    ),
  );
}

await check(
  'without its references a sweep computes its own, and says what is missing',
  async () => {
    const { page, close } = await open('#scene=swinging-sheet&level=0', {
      serviceWorkers: 'block', // it would fetch beside the route
      prepare: (fresh) => fresh.route('**/*.reference', (route) => route.abort()),
    });
    await isReady(page);
    await button(page, 'Measure speed and error').click();
    await until(page, (state) => state.sweep.rows.length >= 2, SWEEP_MS);
    const caption = await page.locator('#tray').textContent();
    expectThat(/could not be fetched/.test(caption), `it says: ${caption}`);
    await close();
  },
);

await check('a cancelled sweep stops at once and keeps its rows', () =>
  visit('#scene=swinging-sheet&level=0', async (page) => {
    await choice(page, 'Levels').selectOption({ index: 0 });
    await button(page, 'Measure speed and error').click();
    await until(page, (state) => state.sweep.rows.length >= 1);
    await button(page, 'Cancel').click();
    const { sweep } = await stateOf(page);
    expectThat(sweep.phase === 'cancelled' && sweep.rows.length >= 1, `it is ${sweep.phase}`);
    await page.waitForTimeout(1500);
    const later = (await stateOf(page)).sweep;
    expectThat(later.progress === sweep.progress, 'it goes on');
    expectThat(later.rows.length === sweep.rows.length, 'the rows changed');
  }),
);

await check('a reload restores preset, fabric, method and drawing', () =>
  visit(
    '#scene=tablecloth&fabric=velvet&level=1&stepper=projective&step=1/120&iterations=7&heat=signed&range=2&edges=on',
    async (page) => {
      const before = await stateOf(page);
      await page.reload();
      await isReady(page);
      const after = await stateOf(page);
      for (const key of ['setting', 'heat', 'heatRange', 'edges', 'startSteps']) {
        const [a, b] = [JSON.stringify(before[key]), JSON.stringify(after[key])];
        expectThat(a === b, `${key} was ${a}, is ${b}`);
      }
      expectThat(after.setting.fabric === 'velvet', `the fabric is ${after.setting.fabric}`);
      expectThat(after.setting.iterations === 7, `${after.setting.iterations} iterations`);
    },
  ),
);

await check('a broken link gives defaults and a message', () =>
  visit('#scene=moon&level=77&fabric=%E0%A4%A&heat', async (page) => {
    const { setting, problem } = await stateOf(page);
    expectThat(setting.preset === 'curtain', `the preset is ${setting.preset}`);
    expectThat(problem?.source === 'link', 'there is no message');
    const sentence = await page.getByRole('alert').textContent();
    expectThat(/level: expected 0 to 4, found "77"/.test(sentence), `it says: ${sentence}`);
    await button(page, 'Dismiss').click();
    await page.getByRole('alert').waitFor({ state: 'hidden' });
  }),
);

await checkAccess('#scene=curtain&level=1&heat=magnitude', 'details');

await checkWidths('#scene=curtain&level=1&heat=signed', [
  [320, 568],
  [390, 844],
  [720, 700],
  [1280, 800],
]);

await check('once loaded, the page and its sweep work without a network', () =>
  visit('#scene=swinging-sheet&fabric=silk&level=0', async (page) => {
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.context().setOffline(true);
    await page.reload();
    await isReady(page);
    await choice(page, 'Cloth to measure').selectOption({ label: 'The scene shown' });
    await choice(page, 'Levels').selectOption({ index: 0 });
    await button(page, 'Measure speed and error').click();
    await until(page, (state) => state.sweep.phase === 'running' && state.sweep.progress > 0);
    await button(page, 'Cancel').click();
  }),
);

await check('without WebGL: a sentence, and the numbers still run', async () => {
  const { page, close } = await open('#scene=curtain&level=0', {
    prepare: (fresh) =>
      fresh.addInitScript(() => {
        HTMLCanvasElement.prototype.getContext = () => null;
      }),
  });
  await isReady(page);
  expectThat(/WebGL/.test(await page.getByRole('alert').textContent()), 'no sentence');
  await button(page, 'Step').click();
  await until(page, (state) => state.numbers.step === 1);
  await close();
});

await checkWithoutModule('#scene=curtain', 'the text stays', async (page) => {
  const caption = await page.locator('.caption').textContent();
  expectThat(caption.length > 20, 'the caption is gone');
});

await checkMotion(harness, visit);
await checkKnit(harness, visit);
await checkLevels(harness, visit);
await checkConvergence(harness, visit);
await checkSweepTable(harness, visit);
await checkTearing(harness, visit);
await checkFabrics(harness);
await checkModes(harness);
await checkFailures(harness);
await checkRefinement(harness);

process.exit((await finish()) ? 0 : 1);
