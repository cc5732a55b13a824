// Checks of the view of refinement in a real browser.
import { eventually, expectThat, largestMove, positionsOf, stateOf, until } from './harness.mjs';
import {
  alertText,
  button,
  canvasOf,
  choice,
  createVisitor,
  expectInWindow,
  expectMotionWorks,
  expectOtherPicture,
  expectUncovered,
  PHONE,
  picture,
} from './visitor.mjs';

/** Three meshes, with software rendering on a busy machine [ms]. */
const LOAD_MS = 120000;

const isReady = (page) => until(page, (state) => state.phase === 'ready', LOAD_MS);

/** Moves a slider by its keys. */
async function press(page, label, key, times) {
  await page.getByLabel(label).focus();
  for (let count = 0; count < times; ++count) await page.keyboard.press(key);
}

/** Widths of the badges' places, left to right [CSS pixels]. */
const paneWidths = (page) =>
  page
    .locator('#refinement .pane')
    .evaluateAll((panes) => panes.map((pane) => pane.offsetWidth).filter((width) => width > 0));

export async function checkRefinement(harness) {
  const { open, check, countColours } = harness;
  const { visit, checkAccess, checkSizes, checkWidths, checkWithoutModule } = createVisitor(
    harness,
    isReady,
    'refinement: ',
  );

  await check('refinement: starts still, on a picture in which finer is better, and says so', () =>
    visit('#view=refinement', async (page) => {
      const { panes, playing } = await until(page, ({ panes: all }) => all.fine.faults !== null);
      expectThat(!playing, 'it plays unasked');
      const shown = [panes.coarse, panes.planned, panes.fine];
      const counts = shown.map(({ nVertices }) => nVertices);
      expectThat(counts[0] < counts[1] && 2 * counts[1] < counts[2], `vertices: ${counts}`);
      const off = shown.map(({ distanceM }) => distanceM);
      expectThat(off[1] <= 0.5 * off[0] && off[2] === null, `off fine: ${off} m`);
      const through = shown.map(({ faults }) => faults.n_crossings);
      expectThat(
        through.every((n) => n === 0),
        `edges through the cloth: ${through}`,
      );
      expectThat((await countColours(await picture(page))) > 300, 'the picture is blank');
      const text = await page.locator('#refinement').textContent();
      expectThat(text.includes(`${counts[2]}`) && /faces were split/.test(text), 'no story');
      // The sentence, the badges and the scale tell one quantity.
      const answer = await page.locator('.garment-answer').textContent();
      const badges = await page.locator('.garment-badge').allTextContents();
      for (const [id, badge] of [
        ['coarse', badges[0]],
        ['planned', badges[2]],
      ]) {
        const [, length] = /([\d.]+) mm off fine/.exec(badge) ?? [];
        expectThat(length && answer.includes(`${length}\u00a0mm`), `${id}: ${badge}; ${answer}`);
      }
      expectThat(/off the fine/.test(await page.locator('.garment-legend').textContent()), 'scale');
      const before = await positionsOf(page);
      await page.waitForTimeout(300);
      expectThat(largestMove(before, await positionsOf(page)) === 0, 'the cloth moves unasked');
    }),
  );

  await check('refinement: the time can be moved by keys, and what is tangled is called so', () =>
    visit('#view=refinement', async (page) => {
      const slider = page.getByRole('slider', { name: 'Time', exact: true });
      await slider.focus();
      const before = await picture(page);
      await page.keyboard.press('PageUp');
      const { timeS } = await until(page, (state) => state.timeS > 0.3);
      await page.keyboard.press('ArrowRight');
      await until(page, (state) => state.timeS > 0.33);
      await expectOtherPicture(page, before);
      const words = await slider.getAttribute('aria-valuetext');
      expectThat(/^\d\.\d\d s of 5 s$/.test(words), `${timeS}: ${words}`);
      await slider.fill('90');
      await until(page, (state) => state.timeS === 3 && state.panes.fine.faults?.n_crossings > 0);
      await eventually(
        async () =>
          /passes through itself/.test(await page.locator('.garment-answer').textContent()),
        'the tangle is told',
      );
      await eventually(
        () => page.evaluate(() => window.location.hash.includes('start=3')),
        'the address has the time',
      );
    }),
  );

  await check('refinement: a worker that ends is noticed, told, and started again', () =>
    visit('#view=refinement&start=1', async (page) => {
      const workers = page.workers();
      expectThat(workers.length >= 3, `${workers.length} workers`);
      await workers[1].evaluate(() => self.close());
      await eventually(
        async () => (await stateOf(page)).problem !== null,
        'the end is noticed while nothing is asked',
      );
      await isReady(page);
      const sentence = await alertText(page);
      expectThat(/ended by itself at 1\.00 s .*started again/.test(sentence), sentence);
      await button(page, 'Play').click();
      await until(page, (state) => state.timeS > 1.1);
    }),
  );

  await check('refinement: a link to a time that nobody recorded says where it starts', () =>
    visit('#view=refinement&motion=walk&start=3&fine=off', async (page) => {
      const sentence = await alertText(page);
      expectThat(/3\.00 s cannot be shown at once.*from 0\.00 s/.test(sentence), sentence);
      await eventually(
        () => page.evaluate(() => window.location.hash.includes('start=0')),
        'the address says so too',
      );
      await eventually(
        async () => !(await page.locator('.time-slider').filter({ visible: true }).count()),
        'no time can be chosen where it has to be computed',
      );
    }),
  );

  await check('refinement: the figure stands there before its clothes have come', async () => {
    const { page, close } = await open('#view=refinement', {
      prepare: (fresh) => fresh.context().route('**/*.wasm', () => undefined), // never answered
    });
    await eventually(
      async () => (await countColours(await picture(page))) > 300,
      'somebody is in the picture',
    );
    expectThat((await stateOf(page)).phase === 'loading', 'the clothes are there');
    await close();
  });

  await check('refinement: plays three panes in step, in positions and in pixels', () =>
    visit('#view=refinement&colour=material&edges=off&start=2', async (page) => {
      const before = [];
      for (const pane of [0, 1, 2]) before.push(await positionsOf(page, pane));
      const still = await picture(page);
      const { timeS } = await stateOf(page);
      await button(page, 'Play').click();
      await eventually(async () => (await stateOf(page)).timeS > timeS + 0.2, 'time goes on');
      await button(page, 'Pause').click();
      await until(page, (state) => !state.playing);
      for (const pane of [0, 1, 2]) {
        const move = largestMove(before[pane], await positionsOf(page, pane));
        expectThat(move > 0.05, `pane ${pane} moved ${move} m`);
      }
      expectThat(!still.equals(await picture(page)), 'the picture is the same');
    }),
  );

  await check('refinement: sliders make other plans, by demand and by a budget', () =>
    visit('#view=refinement&fine=on', async (page) => {
      const first = (await stateOf(page)).panes.planned.nVertices;
      await press(page, /^At most so much/, 'ArrowRight', 16);
      await until(page, (state) => state.plan?.largest_loss_m === 0.003 && state.phase === 'ready');
      const fewer = (await stateOf(page)).panes.planned;
      expectThat(fewer.nVertices < first, `${fewer.nVertices} of ${first} vertices`);
      expectThat(fewer.source === 'sampled', `its shape is ${fewer.source}`);
      await page.getByLabel(/^Or: at most/).fill('2000');
      await until(page, (state) => state.plan?.vertex_budget === 2000 && state.phase === 'ready');
      const { nVertices } = (await stateOf(page)).panes.planned;
      expectThat(nVertices <= 2000 && nVertices >= 1940, `${nVertices} vertices`);
    }),
  );

  await check('refinement: every mesh shows the fine cloth when asked, and its own again', () =>
    visit('#view=refinement&beside=even&edges=off&colour=material&start=3', async (page) => {
      const isNumbered = ({ panes }) => panes.planned.foldsM !== null;
      await until(page, isNumbered, LOAD_MS);
      const own = [await positionsOf(page, 0), await positionsOf(page, 1)];
      const before = await picture(page);
      const control = page.getByLabel('The fine cloth on every mesh');
      await control.check();
      await until(page, (state) => !isNumbered(state));
      const fine = await positionsOf(page, 2);
      for (const pane of [0, 1]) {
        const places = await positionsOf(page, pane);
        const move = largestMove(own[pane], places);
        expectThat(move > 0.005, `pane ${pane} moved ${move} m`);
        expectThat(places.length < fine.length, 'it has the fine mesh');
      }
      const badges = await page.locator('.garment-panes').textContent();
      expectThat(/fine’s shape on this mesh/.test(badges), `the panes say: ${badges}`);
      expectThat(!before.equals(await picture(page)), 'the picture is the same');
      await control.uncheck();
      await until(page, isNumbered);
      for (const pane of [0, 1]) {
        const move = largestMove(own[pane], await positionsOf(page, pane));
        expectThat(move === 0, `pane ${pane} is ${move} m from its own shape`);
      }
    }),
  );

  await check('refinement: the fine skirt walks as it is computed, by position-based steps', () =>
    visit('#view=refinement&edges=off&colour=material', async (page) => {
      await choice(page, 'Steps').selectOption({ label: 'Live' });
      await until(page, (state) => state.panes.fine.source === 'computed', LOAD_MS);
      await isReady(page);
      const before = await picture(page);
      await button(page, 'Play').click();
      const { panes } = await until(page, (state) => state.timeS > 0.15, LOAD_MS);
      expectThat(panes.fine.nVertices > 10000, `${panes.fine.nVertices} vertices`);
      expectThat(panes.fine.warnings.length === 0, 'it moves as no cloth does');
      await button(page, 'Pause').click();
      expectThat(!before.equals(await picture(page)), 'nothing moves');
      await choice(page, 'Garment').selectOption('Trousers');
      await eventually(
        async () => !(await page.getByLabel('Steps', { exact: true }).isVisible()),
        'trousers have one method',
      );
    }),
  );

  await check('refinement: a press on a face tells why it is as fine as it is', () =>
    visit('#view=refinement', async (page) => {
      const box = await canvasOf(page).boundingBox();
      const at = await page.evaluate(() => {
        const places = window.pleat.positions(1);
        let nearest = null;
        // The vertex that is seen lowest lies at the hem, in front.
        for (let vertex = 0; vertex < places.length / 3; ++vertex) {
          const seen = window.pleat.project(vertex, 1);
          if (!nearest || seen.y > nearest.y) nearest = seen;
        }
        return nearest;
      });
      await page.mouse.click(box.x + at.x, box.y + at.y - 12);
      await until(page, (state) => state.face !== null);
      const story = await page.locator('.face-story').textContent();
      expectThat(/face of (level|the base mesh)/.test(story), `it says: ${story}`);
    }),
  );

  await check('refinement: a link leads to the sheet whose error is known at each level', () =>
    visit('#view=refinement', async (page) => {
      await page.getByRole('link', { name: 'the swinging sheet' }).click();
      await until(page, (state) => state.setting?.preset === 'swinging-sheet');
      // The panel comes after the cloth.
      await eventually(
        () => button(page, 'Measure speed and error').isVisible(),
        'a button to press',
      );
    }),
  );

  await check('refinement: each colour has a legend with its unit', () =>
    visit('#view=refinement', async (page) => {
      const legend = page.locator('.garment-legend');
      const words = { Level: /coarse face/, Pattern: /1\/m/, Curvature: /1\/m/ };
      const pictures = [];
      for (const [colour, unit] of Object.entries({ ...words, 'Distance from fine': /mm/ })) {
        await choice(page, 'Colour shows').selectOption(colour);
        await eventually(
          async () => unit.test((await legend.textContent()).replaceAll('\u202f', ' ')),
          `the legend of ${colour}`,
        );
        for (const other of pictures) await expectOtherPicture(page, other);
        pictures.push(await picture(page));
      }
      await choice(page, 'Colour shows').selectOption('Fabric');
      await eventually(async () => !(await legend.isVisible()), 'fabric has no legend');
    }),
  );

  await check('refinement: a squat fires the light, and can become an example by a press', () =>
    visit('#view=refinement&motion=squat&fine=off&edges=off&colour=material', async (page) => {
      await button(page, 'Play').click();
      await until(page, (state) => state.fit?.fires, LOAD_MS);
      await eventually(
        async () => /Does not fit/.test(await page.locator('.fit-title').textContent()),
        'the light says so',
      );
      const words = await page.locator('.fit-detail').textContent();
      expectThat(
        /the normal walk; this is the squat\..*10 frames in a row/.test(words),
        `it says: ${words}`,
      );
      const anew = button(page, 'Plan anew with this motion too');
      await anew.focus();
      await page.keyboard.press('Enter');
      await until(page, (state) => state.doing?.share > 0, LOAD_MS);
      await button(page, 'Cancel').click();
      const { further, plan } = await until(page, (state) => state.phase === 'ready');
      expectThat(further.length === 0 && plan.examples.length === 1, 'it was not given up');
    }),
  );

  await check(
    'refinement: an even mesh of as many vertices loses more; the hem is seen closely',
    () =>
      visit('#view=refinement&edges=off&colour=material&start=3', async (page) => {
        const { timeS } = await stateOf(page);
        await choice(page, 'Uniform mesh beside').selectOption({ index: 1 });
        const { panes } = await until(page, (state) => state.panes.even.lostM > 0, LOAD_MS);
        expectThat((await stateOf(page)).timeS === timeS, 'the time is another one');
        const { even, planned } = panes;
        const apart = Math.abs(even.nVertices / planned.nVertices - 1);
        expectThat(apart < 0.03, `${even.nVertices} against ${planned.nVertices} vertices`);
        expectThat(even.lostM > planned.lostM, `${even.lostM} against ${planned.lostM} m`);
        const badges = await page.locator('.garment-panes').textContent();
        expectThat(/Even/.test(badges), `the panes say: ${badges}`);
        const text = await page.getByRole('region', { name: 'Numbers' }).textContent();
        expectThat(/two equally fine runs/.test(text), 'nothing is said of chance');
        const before = await picture(page);
        await button(page, 'Hem').click();
        await expectOtherPicture(page, before);
        await page.keyboard.press('Home');
      }),
  );

  await check('refinement: a link brings back what is shown', () =>
    visit(
      '#view=refinement&vertices=1500&colour=pattern&hanging=on&edges=off&speed=0.5&start=2',
      async (page) => {
        const { panes, timeS, colour, hanging, edges, speed } = await stateOf(page);
        expectThat(panes.planned.nVertices <= 1500, `${panes.planned.nVertices} vertices`);
        expectThat(Math.abs(timeS - 2) < 1e-6, `at ${timeS} s`);
        expectThat(colour === 'pattern' && hanging && !edges && speed === 0.5, 'other settings');
        await eventually(
          () => page.evaluate(() => window.location.hash.includes('vertices=1500')),
          'the address has it',
        );
        const before = await positionsOf(page, 1);
        await page.reload();
        await isReady(page);
        expectThat(largestMove(before, await positionsOf(page, 1)) === 0, 'another shape');
      },
    ),
  );

  await check('refinement: keys play, step and turn', () =>
    visit('#view=refinement&start=1', async (page) => {
      await canvasOf(page).focus();
      await page.keyboard.press('.');
      await until(page, (state) => state.timeS > 1.02 && state.timeS < 1.05);
      await page.keyboard.press('h');
      await until(page, (state) => state.hanging);
      const still = await picture(page);
      await page.keyboard.press('ArrowLeft');
      await expectOtherPicture(page, still);
      await page.keyboard.press('r');
      await until(page, (state) => state.timeS === 0);
    }),
  );

  await check('refinement: what was fetched is kept for a visit without a network', () =>
    visit(
      '#view=refinement',
      async (page) => {
        const areKept = (n) =>
          eventually(async () => {
            const kept = await page.evaluate(async () => {
              const cache = await caches.open('pleat-on-demand');
              return (await cache.keys()).length;
            });
            return kept === n;
          }, `${n} records and starts are kept`);
        // A slow worker: the files of the first visit came before it was there.
        await page.evaluate(() => window.letRegister());
        await areKept(4);
        await page.context().setOffline(true);
        await page.reload();
        const { panes, problem } = await isReady(page);
        const { coarse, planned, fine } = panes;
        const sources = [coarse, planned, fine].map(({ source }) => source);
        const areRecorded = sources.every((source) => source === 'recorded');
        expectThat(areRecorded, `the frames are ${sources}`);
        expectThat(problem === null, `it says: ${problem?.what}`);
        // The worker sees what is fetched from the second visit on.
        await page.context().setOffline(false);
        await choice(page, 'Garment').selectOption('Trousers');
        await areKept(8);
      },
      {
        prepare: (fresh) =>
          fresh.addInitScript(() => {
            const { register } = ServiceWorkerContainer.prototype;
            const allowed = new Promise((resolve) => {
              window.letRegister = resolve;
            });
            ServiceWorkerContainer.prototype.register = async function late(...details) {
              await allowed;
              return register.apply(this, details);
            };
          }),
      },
    ),
  );

  await check('refinement: records that cannot be had are computed, and that is said', async () => {
    const { page, close } = await open('#view=refinement&fine=off', {
      prepare: (fresh) => fresh.context().route('**/*.recording', (route) => route.abort()),
    });
    await isReady(page);
    const sentence = await alertText(page);
    expectThat(
      /coarse, multi-resolution and fine could not be fetched: no answer\. They are computed/.test(
        sentence,
      ),
      `it says: ${sentence}`,
    );
    const widths = await paneWidths(page);
    expectThat(widths.length === 2, `${widths.length} panes while the fine mesh rests`);
    await close();
  });

  await check(
    'refinement: without WebGL the sentence is seen, and the numbers still come',
    async () => {
      const { page, close } = await open('#view=refinement', {
        prepare: (fresh) =>
          fresh.addInitScript(() => {
            HTMLCanvasElement.prototype.getContext = () => null;
          }),
      });
      await isReady(page);
      await expectUncovered(page.locator('#refinement .plain'));
      await close();
    },
  );

  await check(
    'refinement: on a phone two panes are wide enough, and the third is a press away',
    () =>
      visit(
        '#view=refinement',
        async (page) => {
          const widths = await paneWidths(page);
          expectThat(widths.length === 2 && widths.every((width) => width >= 180), `${widths} px`);
          const still = await picture(page);
          await page.getByRole('radio', { name: 'Coarse' }).check({ force: true });
          await until(page, (state) => state.beside === 'rival');
          await expectOtherPicture(page, still);
        },
        PHONE,
      ),
  );

  const WINDOWS = [
    [720, 450],
    [390, 844],
    [1280, 800],
    [1440, 900],
  ];
  await checkSizes(
    'Play is in sight and badges lie on no picture',
    '#view=refinement',
    WINDOWS,
    async (page, size) => {
      for (const seen of [button(page, 'Play'), page.locator('.fit-strip')])
        await expectInWindow(seen);
      const isOnPicture = await page.evaluate(() => {
        const edge = (selector, end) =>
          [...document.querySelectorAll(selector)].map(
            (element) => element.getBoundingClientRect()[end],
          );
        const badges = edge('#refinement .garment-badge', 'bottom');
        return Math.max(...badges) > edge('#refinement canvas', 'top')[0];
      });
      expectThat(!isOnPicture, `a badge lies on the picture at ${size}`);
    },
  );

  await checkSizes(
    'a badge tells what a frame costs',
    '#view=refinement',
    [
      [390, 844],
      [1280, 800],
    ],
    async (page, size) => {
      const costs = await page
        .locator('.garment-badge .cost')
        .filter({ visible: true })
        .allTextContents();
      const isTold = costs.length >= 2 && costs.every((words) => /^[\d.]+ ms a frame/.test(words));
      expectThat(isTold, `${costs.join('; ')} at ${size}`);
    },
  );

  await checkSizes(
    'no name of a garment or a fabric is cut',
    '#view=refinement',
    WINDOWS,
    async (page, size) => {
      for (const name of ['Garment', 'Fabric']) {
        const [shown, whole] = await choice(page, name).evaluate((control) => {
          const { offsetWidth } = control;
          control.style.width = 'max-content';
          const widest = control.offsetWidth;
          control.style.width = '';
          return [offsetWidth, widest];
        });
        expectThat(shown >= whole, `${name} has ${shown} px of ${whole} at ${size}`);
      }
    },
  );

  await checkAccess('#view=refinement&colour=pattern', '#refinement details');

  await checkWidths('#view=refinement', [
    [320, 568],
    [390, 844],
    [1024, 768],
  ]);

  await checkWithoutModule('#view=refinement', 'once it comes other views work', expectMotionWorks);
}
