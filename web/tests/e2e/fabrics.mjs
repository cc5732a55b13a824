// Checks of the view of fabrics in a real browser.
import { eventually, expectThat, largestMove, positionsOf, stateOf, until } from './harness.mjs';
import {
  alertText,
  button,
  canvasOf,
  choice,
  createTouch,
  createVisitor,
  drop,
  expectMotionWorks,
  expectUncovered,
  PHONE,
  picture,
  placeOn,
  squareObj,
} from './visitor.mjs';

/** Every shape is found. */
export const isFound = (page) =>
  until(
    page,
    (state) =>
      state.phase === 'ready' &&
      state.panes?.length > 0 &&
      !state.isDragging &&
      state.panes.every((pane) => ['converged', 'not_converged'].includes(pane.status)),
  );

/** Drags a vertex of the first pane by some pixels; `during` runs before the hand lets go. */
async function dragVertex(page, vertex, dx, dy, during = () => undefined) {
  const { x, y } = await placeOn(page, vertex);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 6 });
  await during();
  await page.mouse.up();
}

const holdsOf = ({ pins, handles }) => [...pins, ...handles].map(({ name }) => name);

/** Ends the newest worker of the page, as a browser short of memory does. */
async function endWorker(page) {
  await page
    .workers()
    .at(-1)
    .evaluate(() => self.close());
}

const isAtRest = (page) =>
  until(page, (state) => state.show === 'strips' && state.phase === 'done');

async function checkStrips(harness) {
  const { check, countColours, open } = harness;
  const { visit, checkAccess, checkWidths, checkWithoutModule } = createVisitor(
    harness,
    isAtRest,
    'fabrics: strips: ',
  );

  await check('fabrics: opens on fifteen strips over an edge, sorted by how far each droops', () =>
    visit('#view=fabrics', async (page) => {
      const { droops, sorted } = await stateOf(page);
      expectThat(sorted.length === 15 && Object.keys(droops).length === 15, 'some are missing');
      const angles = sorted.map((name) => droops[name]);
      expectThat(
        angles.every((angle, place) => place === 0 || angle >= angles[place - 1]),
        `they droop by ${angles.join(', ')}`,
      );
      expectThat(sorted[0] === 'canvas' && sorted[14] === 'chiffon', `sorted: ${sorted}`);
      for (const place of [0, 14])
        expectThat((await positionsOf(page, place)).length === 3 * 72, `strip ${place} is missing`);
      expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
      const answer = await page.locator('.strips-answer').filter({ visible: true }).textContent();
      expectThat(/canvas droops least, by ~\d+°; chiffon most, by ~\d+°/.test(answer), answer);
      expectThat(page.url().includes('show=strips'), page.url());
    }),
  );

  for (const [width, height] of [
    [1280, 800],
    [390, 844],
    [1920, 1080],
  ]) {
    await check(`fabrics: at ${width} px each strip has its name, none over another`, () =>
      visit(
        '#view=fabrics',
        async (page) => {
          const boxes = await page.locator('.strip-name').evaluateAll((names) =>
            names.map((name) => {
              const range = document.createRange();
              range.selectNodeContents(name);
              const { left, right, top, bottom } = range.getBoundingClientRect();
              return { left, right, top, bottom, words: name.textContent };
            }),
          );
          const stage = await canvasOf(page).boundingBox();
          expectThat(boxes.length === 15, `${boxes.length} names`);
          for (const { words } of boxes)
            expectThat(/^[a-z ]+~?\d+ mm~?\d+°$/.test(words), `it says: ${words}`);
          const shown = await page
            .locator('.strip-name span')
            .evaluateAll((spans) => spans.filter((span) => span.offsetWidth > 0).length);
          expectThat(shown === 30, `${shown} of 30 numbers are seen`);
          for (const [place, a] of boxes.entries()) {
            const isInside =
              a.left >= stage.x &&
              a.right <= stage.x + stage.width &&
              a.bottom <= stage.y + stage.height;
            expectThat(isInside, `${a.words} is outside of the picture`);
            const over = boxes.find(
              (b, other) =>
                other > place &&
                a.left < b.right &&
                b.left < a.right &&
                a.top < b.bottom &&
                b.top < a.bottom,
            );
            expectThat(!over, `${a.words} lies over ${over?.words}`);
          }
        },
        { width, height },
      ),
    );
  }

  await check('fabrics: strips can be stopped, and those that are left be let down', async () => {
    const { page, close } = await open('#view=fabrics');
    await until(page, ({ droops }) => droops && Object.keys(droops).length > 0);
    await button(page, 'Stop').click();
    const { phase, droops } = await stateOf(page);
    expectThat(phase === 'stopped', `it is ${phase}`);
    await page.waitForTimeout(300);
    const later = Object.keys((await stateOf(page)).droops).length;
    expectThat(later === Object.keys(droops).length, 'it goes on');
    await button(page, 'Let the others down').click();
    await isAtRest(page);
    await close();
  });

  await check('fabrics: a strip that is read goes on into motion beside another fabric', () =>
    visit('#view=fabrics', async (page) => {
      await page.getByRole('button', { name: 'velvet' }).click();
      const panel = page.getByRole('region', { name: 'Order of the strips' });
      const words = await panel.textContent();
      expectThat(/velvet: a bending rigidity of ~22 µN·m/.test(words), words);
      await button(page, 'See it in motion beside another').click();
      const { pair } = await until(page, (state) => state.show === 'pair');
      expectThat(pair[0] === 'velvet', `it shows ${pair}`);
      await page.getByRole('radio', { name: 'All fifteen over an edge' }).check({ force: true });
      await isAtRest(page);
    }),
  );

  await check('fabrics: strips go on with another worker when theirs ends', async () => {
    const { page, close } = await open('#view=fabrics');
    await until(page, ({ droops }) => droops && Object.keys(droops).length > 0);
    await endWorker(page);
    await until(page, (state) => /ended by itself.*started again/.test(state.problem?.what));
    await isAtRest(page);
    await close();
  });

  await checkAccess('#view=fabrics', '#fabrics details');

  await checkWidths('#view=fabrics', [
    [320, 568],
    [390, 844],
    [768, 1024],
  ]);

  await checkWithoutModule('#view=fabrics', 'its words stay', async (page) => {
    const words = await page.locator('#fabrics').textContent();
    expectThat(/Which fabric is stiff\?/.test(words), 'the words are gone');
  });
}

const isPairReady = (page) =>
  until(page, (state) => state.show === 'pair' && state.phase === 'ready');

async function checkPair(harness) {
  const { check, countColours } = harness;
  const { visit, checkAccess, checkWidths } = createVisitor(
    harness,
    isPairReady,
    'fabrics: pair: ',
  );

  await check('fabrics: two fabrics begin alike, move in step, and part', () =>
    visit('#view=fabrics&show=pair', async (page) => {
      const befores = await Promise.all([0, 1].map((pane) => positionsOf(page, pane)));
      expectThat(largestMove(...befores) === 0, 'they begin in different places');
      expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
      await button(page, 'Play').click();
      await until(page, (state) => state.timeS > 1);
      await button(page, 'Pause').click();
      const { apartM } = await stateOf(page);
      const afters = await Promise.all([0, 1].map((pane) => positionsOf(page, pane)));
      for (const [pane, after] of afters.entries())
        expectThat(largestMove(befores[pane], after) > 0.05, `pane ${pane} stays`);
      expectThat(Math.abs(largestMove(...afters) - apartM) < 1e-6, `said to be ${apartM} m apart`);
      expectThat(apartM > 0.005, `they are ${apartM} m apart`);
      await choice(page, 'Scene').selectOption('Flag in the wind');
      await until(page, (state) => state.scene === 'flag' && state.phase === 'ready');
      await choice(page, 'Left').selectOption('wool');
      await until(page, (state) => state.pair[0] === 'wool' && state.phase === 'ready');
      await page.waitForFunction(() => /scene=flag&fabrics=wool/.test(window.location.hash));
      await page.reload();
      const { pair } = await isPairReady(page);
      expectThat(pair[0] === 'wool', 'a reload forgets the fabric');
    }),
  );

  await check('fabrics: one hand pulls both cloths', () =>
    visit('#view=fabrics&show=pair', async (page) => {
      const befores = await Promise.all([0, 1].map((pane) => positionsOf(page, pane)));
      const vertex = await page.evaluate(() => window.pleat.inviting());
      const { x, y } = await placeOn(page, vertex);
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x - 60, y - 60, { steps: 4 });
      await until(page, (state) => state.timeS > 0.4);
      const part = (positions) => positions.slice(3 * vertex, 3 * vertex + 3);
      for (const pane of [0, 1]) {
        const move = largestMove(part(befores[pane]), part(await positionsOf(page, pane)));
        expectThat(move > 0.05, `pane ${pane} moved by ${move} m`);
      }
      await page.mouse.up();
    }),
  );

  await check('fabrics: both begin anew when a worker ends in motion, and it is said', () =>
    visit('#view=fabrics&show=pair&scene=strip', async (page) => {
      await button(page, 'Play').click();
      await until(page, (state) => state.timeS > 0.2);
      await endWorker(page);
      await until(page, (state) => /ended by itself.*started again/.test(state.problem?.what));
      await isPairReady(page);
      await button(page, 'Play').click();
      await until(page, (state) => state.timeS > 0.2);
    }),
  );

  await checkAccess('#view=fabrics&show=pair&scene=strip', '#fabrics details');

  await checkWidths('#view=fabrics&show=pair&scene=strip', [
    [320, 568],
    [390, 844],
    [768, 1024],
  ]);
}

export async function checkFabrics(harness) {
  const { open, check, countColours } = harness;
  const { visit, checkAccess, checkWidths, checkWithoutModule } = createVisitor(
    harness,
    isFound,
    'fabrics: ',
  );

  await check('fabrics: loads still, a deformed cloth with a handle that asks to be pulled', () =>
    visit('#view=fabrics&show=shapes', async (page) => {
      const { cloth, handles } = await stateOf(page);
      const before = await positionsOf(page);
      expectThat(largestMove(cloth.rest_m, before) > 0.05, 'the cloth is as it rests');
      expectThat(handles.length > 0, 'there is no handle');
      expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
      expectThat(await page.getByText('Pull me').filter({ visible: true }).isVisible(), 'no word');
      await page.waitForTimeout(300);
      expectThat(largestMove(before, await positionsOf(page)) === 0, 'the cloth moves unasked');
    }),
  );

  await check(
    'fabrics: a handle is dragged, the cloth follows at once, and it is found at rest',
    () =>
      visit('#view=fabrics&show=shapes', async (page) => {
        const [before, still] = [await positionsOf(page), await picture(page)];
        const vertex = await page.evaluate(() => window.pleat.inviting());
        await dragVertex(page, vertex, 20, -90, async () => {
          await until(page, (state) => state.isDragging);
          await eventually(
            async () => largestMove(before, await positionsOf(page)) > 0.03,
            'the cloth follows before the hand lets go',
          );
        });
        await isFound(page);
        const { panes, handles } = await stateOf(page);
        expectThat(panes[0].status === 'converged', `it is ${panes[0].status}`);
        expectThat(
          handles[0].offset.some((metres) => Math.abs(metres) > 0.02),
          'it has no offset',
        );
        expectThat(!still.equals(await picture(page)), 'the picture is the same');
      }),
  );

  await check('fabrics: any vertex becomes a handle, and is let go in the list', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      const before = await positionsOf(page);
      await dragVertex(page, 7 * 31 + 8, 0, -60);
      await until(page, (state) => state.handles.length === 2);
      await isFound(page);
      const pulled = await positionsOf(page);
      expectThat(largestMove(before, pulled) > 0.03, 'the cloth did not follow');
      const { handles } = await stateOf(page);
      await button(page, `Release ${handles[1].name}`).click();
      await until(page, (state) => state.handles.length === 1);
      await isFound(page);
      const back = largestMove(before, await positionsOf(page));
      expectThat(back < 1e-3, `it is ${back} m from where it was`);
    }),
  );

  await check('fabrics: a press alone holds nothing', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      await dragVertex(page, 7 * 31 + 8, 0, 0);
      await page.waitForTimeout(200);
      expectThat((await stateOf(page)).handles.length === 1, 'there is another handle');
    }),
  );

  await check('fabrics: pins go in and out by hand, and the cloth goes with them', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      const before = await positionsOf(page);
      await page.getByRole('radio', { name: 'Pin', exact: true }).check({ force: true });
      const { x, y } = await placeOn(page, 32); // next to the corner, in its pin
      await page.mouse.click(x, y);
      await until(page, (state) => state.pins.length === 3);
      await isFound(page);
      expectThat(largestMove(before, await positionsOf(page)) > 1e-3, 'the corner stays');
      const loose = await placeOn(page, 31 * 15 + 3);
      await page.mouse.click(loose.x, loose.y);
      await until(page, (state) => state.pins.length === 4);
      await isFound(page);
      const { pins } = await stateOf(page);
      await button(page, `Release ${pins[3].name}`).click();
      await until(page, (state) => state.pins.length === 3);
      await button(page, 'Pins and handles as at first').click();
      await until(page, (state) => state.pins.length === 4);
      await isFound(page);
      expectThat(largestMove(before, await positionsOf(page)) < 1e-3, 'it is not as at first');
    }),
  );

  await check('fabrics: keys move a handle of the list, and take the cloth in the picture', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      const before = await positionsOf(page);
      await button(page, 'middle').focus();
      for (let press = 0; press < 4; ++press) await page.keyboard.press('ArrowUp');
      await eventually(
        async () => largestMove(before, await positionsOf(page)) > 0.02,
        'the cloth follows the handle',
      );
      await isFound(page);
      await canvasOf(page).focus();
      await page.keyboard.press('g');
      await until(page, (state) => state.isDragging);
      for (let press = 0; press < 3; ++press) await page.keyboard.press('ArrowRight');
      await page.keyboard.press('Escape');
      await isFound(page);
      await page.keyboard.press('p');
      expectThat((await stateOf(page)).tool === 'pin', 'P does not change the tool');
    }),
  );

  await check('fabrics: a finger drags the cloth on a small screen', () =>
    visit(
      '#view=fabrics&scene=terms',
      async (page) => {
        const before = await positionsOf(page);
        const { x, y } = await placeOn(page, await page.evaluate(() => window.pleat.inviting()));
        const touch = await createTouch(page);
        await touch('touchStart', { x, y });
        await touch('touchMove', { x, y: y - 20 });
        await touch('touchMove', { x, y: y - 40 });
        await until(page, (state) => state.isDragging);
        await touch('touchEnd');
        await isFound(page);
        expectThat(largestMove(before, await positionsOf(page)) > 0.02, 'the cloth stays');
      },
      PHONE,
    ),
  );

  await check('fabrics: a reload of the link shows the same fabrics, holds and shapes', () =>
    visit('#view=fabrics&scene=terms&fabrics=silk+wool&form=consistent', async (page) => {
      await dragVertex(page, 7 * 31 + 8, 0, -60);
      await page.getByRole('radio', { name: 'Pin', exact: true }).check({ force: true });
      const corner = await placeOn(page, 32);
      await page.mouse.click(corner.x, corner.y);
      await until(page, (state) => state.pins.length === 3 && state.handles.length === 2);
      await page.waitForTimeout(300);
      await isFound(page);
      const [a, b] = [await positionsOf(page, 0), await positionsOf(page, 1)];
      const names = holdsOf(await stateOf(page));
      await page.reload();
      await isFound(page);
      expectThat(holdsOf(await stateOf(page)).join() === names.join(), 'other holds');
      for (const [pane, was] of [a, b].entries()) {
        const off = largestMove(was, await positionsOf(page, pane));
        expectThat(off < 1e-3, `pane ${pane} is ${off} m off`);
      }
    }),
  );

  await check('fabrics: four side by side under one pull, each with a shape of its own', () =>
    visit('#view=fabrics&fabrics=silk+linen+wool+canvas', async (page) => {
      expectThat((await page.locator('.pane-badge').count()) === 4, 'there are not four badges');
      const befores = await Promise.all([0, 1, 2, 3].map((pane) => positionsOf(page, pane)));
      await dragVertex(page, await page.evaluate(() => window.pleat.inviting()), 0, -30, () =>
        eventually(async () => {
          const afters = await Promise.all([0, 1, 2, 3].map((pane) => positionsOf(page, pane)));
          return afters.every((after, pane) => largestMove(befores[pane], after) > 0.01);
        }, 'all four follow'),
      );
      await isFound(page);
      const shapes = await Promise.all([0, 1, 2, 3].map((pane) => positionsOf(page, pane)));
      for (let a = 0; a < 4; ++a) {
        for (let b = 0; b < a; ++b) {
          expectThat(largestMove(shapes[a], shapes[b]) > 5e-3, `panes ${a} and ${b} are alike`);
        }
      }
    }),
  );

  await check('fabrics: all fifteen at once, and back', () =>
    visit('#view=fabrics&scene=terms&fabrics=velvet', async (page) => {
      await button(page, 'All fifteen at once').click();
      await until(page, (state) => state.panes.length === 15);
      await isFound(page);
      expectThat((await page.locator('.pane-badge').count()) === 15, 'there are not 15 badges');
      const heading = page.getByText('They do not rank stiffness');
      expectThat(await heading.isVisible(), 'nothing says what the shapes compare');
      for (let pane = 0; pane < 15; ++pane) {
        expectThat((await positionsOf(page, pane)).length === 3 * 961, `pane ${pane} is empty`);
      }
      await button(page, 'All fifteen at once').click();
      await until(page, (state) => state.panes.length === 1);
      await isFound(page);
      expectThat((await stateOf(page)).panes[0].fabric.name === 'velvet', 'another fabric');
    }),
  );

  await check('fabrics: the stiffest is found by one choice, in the list and in the gallery', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      const list = page.getByRole('grid', { name: 'Fabrics' });
      const note = page.getByRole('region', { name: 'Choice of fabrics' });
      expectThat(
        /do not say which of two/.test(await note.textContent()),
        'weights are unexplained',
      );
      await choice(page, 'Order').selectOption('Stiffest to bend first');
      const first = await list.getByRole('row').first().textContent();
      expectThat(/^canvas.*82 µN·m/.test(first), `the first is ${first}`);
      expectThat(
        /do not say which of two/.test(await note.textContent()),
        'in another order weights are unexplained',
      );
      await button(page, 'All fifteen at once').click();
      await until(page, (state) => state.panes.length === 15);
      await isFound(page);
      const badge = await page.locator('.pane-badge').first().textContent();
      expectThat(/^canvas.*82 µN·m/.test(badge), `the first badge says ${badge}`);
      await page.reload();
      await isFound(page);
      expectThat(
        (await stateOf(page)).panes[0].fabric.name === 'canvas',
        'a reload forgets the order',
      );
    }),
  );

  await check(
    'fabrics: without WebGL the sentence is seen, and nothing asks to be pulled',
    async () => {
      const { page, close } = await open('#view=fabrics&scene=terms', {
        prepare: (fresh) =>
          fresh.addInitScript(() => {
            HTMLCanvasElement.prototype.getContext = () => null;
          }),
      });
      await isFound(page);
      await expectUncovered(page.locator('#fabrics .plain'));
      const words = page.getByText('Pull me').filter({ visible: true });
      expectThat((await words.count()) === 0, 'something asks to be pulled');
      await close();
    },
  );

  await check('fabrics: forms and terms change the shape; the last term stays on', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      let before = await positionsOf(page);
      const changed = async (what) => {
        await isFound(page);
        const after = await positionsOf(page);
        expectThat(largestMove(before, after) > 1e-3, `${what} changes nothing`);
        before = after;
      };
      await page.getByLabel('Published', { exact: true }).check();
      await until(page, (state) => state.form === 'published');
      await changed('the form');
      const panel = page.getByRole('region', { name: 'Energy', exact: true });
      await panel.getByLabel('Bending').uncheck();
      await until(page, (state) => !state.terms.bending);
      await changed('bending');
    }),
  );

  await check('fabrics: what has no one shape is a sentence, and everything is as before it', () =>
    visit('#view=fabrics&scene=terms&fabrics=silk', async (page) => {
      const names = holdsOf(await stateOf(page));
      for (const name of names) await button(page, `Release ${name}`).click();
      await until(page, (state) => state.holds.length === 0);
      await isFound(page);
      const { cloth } = await stateOf(page);
      const off = largestMove(cloth.rest_m, await positionsOf(page));
      expectThat(off < 1e-3, `a cloth that nothing holds is ${off} m from rest`);
      const panel = page.getByRole('region', { name: 'Energy', exact: true });
      await panel.getByLabel('Recovery').click(); // it comes back on at once
      await until(page, (state) => /singular/.test(state.problem?.what));
      await isFound(page);
      expectThat((await stateOf(page)).terms.recovery, 'recovery stays off');
      await button(page, 'Pins and handles as at first').click();
      await panel.getByLabel('Recovery').uncheck();
      await isFound(page);
      await button(page, `Release ${names[0]}`).click();
      for (const name of names.slice(1)) await button(page, `Release ${name}`).click();
      await until(page, (state) => /singular/.test(state.problem?.what));
      await isFound(page);
      expectThat((await stateOf(page)).holds.length > 0, 'nothing holds the cloth');
    }),
  );

  for (const scene of ['ball', 'diagonal_stretch', 'wrinkles', 'half_skirt', 't_shirt']) {
    await check(`fabrics: the experiment ${scene} is deformed and converges`, () =>
      visit(`#view=fabrics&scene=${scene}`, async (page) => {
        const { panes, cloth, experiment } = await stateOf(page);
        expectThat(experiment === scene, `it is ${experiment}`);
        expectThat(panes[0].status === 'converged', `it is ${panes[0].status}`);
        const move = largestMove(cloth.rest_m, await positionsOf(page));
        expectThat(move > 0.02, `it moved ${move} m`);
        expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
      }),
    );
  }

  await check(
    'fabrics: an OBJ file can be pulled; a bad one is a sentence and the cloth stays',
    () =>
      visit('#view=fabrics&scene=terms', async (page) => {
        await drop(page, 'banner.obj', squareObj(1, 12));
        await until(
          page,
          (state) => state.experiment === 'own' && state.cloth.name === 'banner.obj',
        );
        await isFound(page);
        const before = await positionsOf(page);
        expectThat(before.length === 3 * 169, 'it has other vertices');
        await dragVertex(page, 84, 0, -60);
        await isFound(page);
        expectThat(largestMove(before, await positionsOf(page)) > 0.05, 'it was not pulled');
        await drop(page, 'torn.obj', `${squareObj(1)}f 1 2 999\n`);
        await until(page, (state) => state.problem !== null);
        const sentence = await alertText(page);
        expectThat(/torn\.obj: line \d+: expected/.test(sentence), `it says: ${sentence}`);
        const pulled = await positionsOf(page);
        expectThat(pulled.length === 3 * 169, 'the cloth is another');
        await dragVertex(page, 84, 0, 30);
        await isFound(page);
        expectThat(largestMove(pulled, await positionsOf(page)) > 0.03, 'it can be pulled no more');
        await drop(page, 'shirt.stl', 'solid');
        await until(page, (state) => /no OBJ file/.test(state.problem?.what));
        await choice(page, 'Experiment').selectOption({ label: 'A ball under the cloth' });
        await until(page, (state) => state.experiment === 'ball' && state.problem === null);
        await isFound(page);
        await choice(page, 'Experiment').selectOption({ label: 'Your OBJ' });
        await until(
          page,
          (state) => state.experiment === 'own' && state.cloth.name === 'banner.obj',
        );
      }),
  );

  await check(
    'fabrics: a file in millimetres is noticed, and taken in millimetres when told to',
    () =>
      visit('#view=fabrics&scene=terms', async (page) => {
        await drop(page, 'banner.obj', squareObj(950, 12));
        await until(page, (state) => state.cloth.name === 'banner.obj' && state.phase === 'ready');
        const panel = page.getByRole('region', { name: 'Experiment' });
        const said = await panel.textContent();
        expectThat(/It is 950 m across.*probably the millimetre/.test(said), `it says: ${said}`);
        await choice(page, 'Unit of the file').selectOption('millimetres');
        await until(page, (state) => state.objUnit === 'mm' && state.phase === 'ready');
        await isFound(page);
        const { cloth } = await stateOf(page);
        const highest = Math.max(...cloth.rest_m);
        expectThat(Math.abs(highest - 1.9) < 1e-9, `the highest place is ${highest} m`);
        expectThat(!/odd for cloth/.test(await panel.textContent()), 'it is still odd');
      }),
  );

  await check(
    'fabrics: a large file shows that it is read, and is given up; a huge one is refused',
    () =>
      visit('#view=fabrics&scene=ball&fabrics=wool', async (page) => {
        const before = await positionsOf(page);
        await drop(page, 'large.obj', squareObj(1, 300));
        await page.getByRole('progressbar', { name: 'Reading the file' }).waitFor();
        await button(page, 'Cancel').click();
        await until(page, (state) => state.reading === null);
        await isFound(page);
        const { experiment, panes, objName } = await stateOf(page);
        expectThat(experiment === 'ball' && objName === null, `it shows ${experiment}`);
        expectThat(panes[0].fabric.name === 'wool', 'in another fabric');
        const off = largestMove(before, await positionsOf(page));
        expectThat(off < 1e-3, `it is ${off} m off`);
        await drop(page, 'huge.obj', 'v 0 0 0\n'.repeat(200001));
        const sentence = await alertText(page);
        expectThat(/huge\.obj has 200.001 vertices/.test(sentence), `it says: ${sentence}`);
      }),
  );

  await check('fabrics: a fabric and a shape go over to motion, which starts from it', () =>
    visit('#view=fabrics&scene=terms&fabrics=velvet&held=middle:0,-0.09,0', async (page) => {
      const shape = await positionsOf(page);
      await button(page, 'Start moving from this shape').click();
      await until(page, (state) => state.setting?.preset === 'obj' && state.phase === 'ready');
      const start = await positionsOf(page);
      expectThat(largestMove(shape, start) < 1e-6, 'it starts elsewhere');
      expectThat((await stateOf(page)).setting.fabric === 'velvet', 'in another fabric');
      await button(page, 'Step').click();
      await until(page, (state) => state.numbers.step === 1);
      const move = largestMove(start, await positionsOf(page));
      expectThat(move > 0 && move < 0.1, `the first step moves it by ${move} m`);
      await button(page, 'Reset').click();
      await until(page, (state) => state.phase === 'ready' && state.numbers.step === 0);
      expectThat(largestMove(shape, await positionsOf(page)) < 1e-6, 'a reset leads elsewhere');
      await page.getByRole('link', { name: /Fabrics/ }).click();
      await isFound(page);
      await button(page, 'Carry this fabric over to motion').click();
      await until(page, (state) => state.setting?.fabric === 'velvet' && state.phase === 'ready');
    }),
  );

  await check('fabrics: a shape that cloth does not bear is eased in, and says by how much', () =>
    visit('#view=fabrics&scene=terms&fabrics=silk', async (page) => {
      await dragVertex(page, await page.evaluate(() => window.pleat.inviting()), 0, -140);
      await isFound(page);
      const start = button(page, 'Start moving from this shape');
      const words = await page.locator('.start-reason').filter({ visible: true }).textContent();
      const [eased] = /eased in by [\d.]+ %/.exec(words) ?? [];
      expectThat(eased && /stretched to [\d.]+ times/.test(words), `it says: ${words}`);
      await start.click();
      await until(page, (state) => state.setting?.preset === 'obj' && state.phase === 'ready');
      const { mesh } = await stateOf(page);
      expectThat(mesh.name.includes(eased), `it says of it: ${mesh.name}`);
      await button(page, 'Play').click();
      await until(page, (state) => state.numbers.time_s > 0.5);
      const { problem } = await stateOf(page);
      expectThat(problem === null, `it says: ${problem?.sentence}`);
    }),
  );

  await check('fabrics: shapes are there again when their worker ends, and can be pulled', () =>
    visit('#view=fabrics&scene=terms&fabrics=wool', async (page) => {
      const vertex = await page.evaluate(() => window.pleat.inviting());
      await dragVertex(page, vertex, 0, -60);
      await isFound(page);
      const before = await positionsOf(page);
      await endWorker(page);
      await until(page, (state) => /ended by itself.*started again/.test(state.problem?.what));
      await isFound(page);
      const off = largestMove(before, await positionsOf(page));
      expectThat(off < 1e-3, `it is ${off} m off`);
      await dragVertex(page, vertex, 0, 40);
      await isFound(page);
      expectThat(largestMove(before, await positionsOf(page)) > 0.01, 'it can be pulled no more');
    }),
  );

  await check('fabrics: the views keep what they show when one changes between them', () =>
    visit('#view=fabrics&scene=ball&fabrics=wool', async (page) => {
      await expectMotionWorks(page);
      expectThat(!page.url().includes('view=fabrics'), `the address is ${page.url()}`);
      await page.getByRole('link', { name: /Fabrics/ }).click();
      await until(page, (state) => state.experiment === 'ball');
      expectThat(page.url().includes('fabrics=wool'), `the address is ${page.url()}`);
    }),
  );

  await check('fabrics: a broken link gives defaults and a message', () =>
    visit('#view=fabrics&scene=moon&fabrics=tin&terms=', async (page) => {
      const sentence = await alertText(page);
      for (const part of ['scene:', 'fabrics:', 'terms:']) {
        expectThat(sentence.includes(part), `it says: ${sentence}`);
      }
      expectThat((await stateOf(page)).experiment === 'pull', 'it shows something else');
    }),
  );

  await checkAccess('#view=fabrics&scene=terms&fabrics=silk+wool', '#fabrics details');

  await check('fabrics: a link without one shape is shown with all terms, and says so', () =>
    visit(
      '#view=fabrics&scene=terms&terms=stretch&free=upper-left;upper-right;lower-left;lower-right;middle',
      async (page) => {
        const sentence = await alertText(page);
        expectThat(/^Undone: .*singular/.test(sentence), `it says: ${sentence}`);
        const { terms, holds } = await stateOf(page);
        expectThat(terms.recovery && holds.length === 0, 'it is not as the sentence says');
        expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
      },
    ),
  );

  await check('fabrics: one’s own fabric is shown beside another, and taken away again', () =>
    visit('#view=fabrics&scene=terms&fabrics=own:0.98,1.05,0.99+wool', async (page) => {
      const kinds = ({ panes }) => panes.map(({ fabric }) => fabric.kind).join();
      expectThat(kinds(await stateOf(page)) === 'own,named', 'it is not there');
      await page.getByLabel('Stretch', { exact: true }).and(page.locator('.ratio')).fill('1.08');
      await until(page, (state) => state.panes[0].fabric.measures.stretch === 1.08);
      await eventually(() => page.url().includes('own:0.98,1.08,0.99'), 'the link has it');
      await button(page, 'Take it away').click();
      await until(page, (state) => state.panes.length === 1);
      expectThat(kinds(await stateOf(page)) === 'named', 'it is still there');
      await isFound(page);
    }),
  );

  await check('fabrics: the list of holds keeps the focus of whoever releases by key', () =>
    visit('#view=fabrics&scene=terms', async (page) => {
      const names = holdsOf(await stateOf(page));
      const focused = () => page.evaluate(() => document.activeElement.getAttribute('aria-label'));
      await button(page, 'Release upper left').focus();
      await page.keyboard.press('Enter');
      await until(page, (state) => state.pins.length === 3);
      expectThat((await focused()) === 'Release upper right', `it is at ${await focused()}`);
      for (const _ of names.slice(1)) await page.keyboard.press('Enter');
      await until(page, (state) => state.holds.length === 0);
      const at = await page.evaluate(() => document.activeElement.textContent);
      expectThat(at === 'Pins and handles as at first', `it is at ${at}`);
      await isFound(page);
    }),
  );

  await check('fabrics: beside its panel the page itself does not scroll', () =>
    visit('#view=fabrics&scene=terms&fabrics=silk+own:0.98,1.05,0.99', async (page) => {
      await page.evaluate(() => window.scrollTo(0, 5000));
      const down = await page.evaluate(() => window.scrollY);
      expectThat(down === 0, `it went ${down} px down`);
    }),
  );

  await checkWidths('#view=fabrics&scene=terms&fabrics=silk+wool+canvas', [
    [320, 568],
    [390, 844],
    [768, 1024],
  ]);

  await checkWithoutModule(
    '#view=fabrics&show=shapes',
    'once it comes other views work',
    expectMotionWorks,
  );

  await checkStrips(harness);
  await checkPair(harness);
}
