// A visitor of the view of motion has to be able to trust the first press, links, and an end to waiting.
import {
  eventually,
  expectThat,
  isReady,
  largestMove,
  momentUntil,
  positionsOf,
  stateOf,
  until,
} from './harness.mjs';
import {
  alertText,
  button,
  canvasOf,
  choice,
  createTouch,
  PHONE,
  picture,
  placeOn,
} from './visitor.mjs';

/** Presses that have to take the cloth. */
const N_PRESSES = 20;

/** So much of the cloth is seen on the first screen at least. */
const LEAST_STAGE_PX = 150;

/** Least distance between a word and the border around it. */
const LEAST_ROOM_PX = 3;

/** Openings of the sentences on a run that one substep spoils, the earliest sign first. */
const TELLS_WRONG_STRETCH =
  /^(The cloth stretches like a softer fabric|The cloth stretches too much|The run has exploded): /;

/** Places all over a disc, as a sunflower has its seeds. */
function seedsOf({ x, y, radius }) {
  const turn = Math.PI * (3 - Math.sqrt(5));
  return Array.from({ length: N_PRESSES }, (_, k) => {
    const away = radius * Math.sqrt((k + 0.5) / N_PRESSES);
    return { x: x + away * Math.cos(k * turn), y: y + away * Math.sin(k * turn) };
  });
}

/** The ring of the invitation on the page. */
async function ringOf(page) {
  const ring = page.locator('.invitation-ring');
  await ring.waitFor();
  const { x, y, width, height } = await ring.boundingBox();
  return { x: x + width / 2, y: y + height / 2, radius: Math.max(width, height) / 2 };
}

async function backToStart(page) {
  await button(page, 'Reset').click();
  await until(page, ({ phase, numbers }) => phase === 'ready' && numbers.step === 0);
}

/** Each press within the ring takes the cloth, from the start of the scene. */
async function expectPressesHold(page, press, release) {
  const seeds = seedsOf(await ringOf(page));
  const missed = [];
  for (const at of seeds) {
    await press(at);
    const { held } = await stateOf(page);
    await release();
    if (!held) missed.push(`(${at.x.toFixed(1)}, ${at.y.toFixed(1)})`);
    await until(page, (state) => !state.held);
    await backToStart(page);
  }
  expectThat(missed.length === 0, `missed: ${missed.join(' ')}`);
}

async function checkHand({ check }, visit) {
  await check(`${N_PRESSES} presses inside the ring all take the cloth, by mouse`, () =>
    visit('#scene=curtain', (page) =>
      expectPressesHold(
        page,
        async ({ x, y }) => {
          await page.mouse.move(x, y);
          await page.mouse.down();
        },
        () => page.mouse.up(),
      ),
    ),
  );

  await check(`${N_PRESSES} presses inside the ring all take the cloth, by touch`, () =>
    visit(
      '#scene=tablecloth',
      async (page) => {
        const touch = await createTouch(page);
        await expectPressesHold(
          page,
          (at) => touch('touchStart', at),
          () => touch('touchEnd'),
        );
      },
      PHONE,
    ),
  );

  await check('the pointer says grab where a press takes the cloth, and nowhere else', () =>
    visit('#scene=curtain', async (page) => {
      const cursorAt = async ({ x, y }) => {
        await page.mouse.move(x, y);
        await page.waitForTimeout(150);
        return canvasOf(page).evaluate((canvas) => getComputedStyle(canvas).cursor);
      };
      const ring = await ringOf(page);
      expectThat((await cursorAt(ring)) === 'grab', 'not in the ring');
      const box = await canvasOf(page).boundingBox();
      const beside = { x: box.x + 40, y: box.y + 40 };
      expectThat((await cursorAt(beside)) !== 'grab', 'beside the cloth as well');
    }),
  );
}

/** A state is what its setting, its step and the places of its vertices are. */
async function shownState(page) {
  const { setting, numbers } = await stateOf(page);
  return { setting: JSON.stringify(setting), step: numbers.step, places: await positionsOf(page) };
}

async function checkLinks({ check, open }, visit) {
  const copiedLink = async (page) => {
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await button(page, 'Copy link').click();
    const said = page.locator('#toolbar [role=status]');
    await eventually(async () => /Link copied/.test(await said.textContent()), 'it is copied');
    return { hash: new URL(await page.evaluate(() => navigator.clipboard.readText())).hash, said };
  };

  for (const start of ['#scene=curtain&level=1', '#scene=swinging-sheet&level=1&stepper=xpbd']) {
    await check(`a copied link of ${start} replays what is shown to the bit`, () =>
      visit(start, async (page) => {
        await button(page, 'Play').click();
        await until(page, (state) => state.numbers.time_s > 0.7);
        const { hash, said } = await copiedLink(page);
        expectThat(/runs to (?!0\.00)\d+\.\d\d s/.test(await said.textContent()), 'no time');
        const shown = await shownState(page);
        expectThat(shown.step > 40, `step ${shown.step}`);
        const copy = await open(hash);
        await isReady(copy.page);
        const replayed = await shownState(copy.page);
        await copy.close();
        expectThat(replayed.step === shown.step, `step ${replayed.step}, not ${shown.step}`);
        expectThat(replayed.setting === shown.setting, replayed.setting);
        const move = largestMove(shown.places, replayed.places);
        expectThat(move === 0, `a vertex is ${move} m off`);
      }),
    );
  }

  await check('a link keeps the view, and says that a pull is not kept', () =>
    visit('#scene=curtain&level=1', async (page) => {
      await canvasOf(page).focus();
      for (const key of ['ArrowRight', 'ArrowRight', '+', 'g', 'Escape'])
        await page.keyboard.press(key);
      const { hash, said } = await copiedLink(page);
      expectThat(/pull is not kept/.test(await said.textContent()), await said.textContent());
      const place = () => page.evaluate(() => window.pleat.project(0));
      await backToStart(page);
      await picture(page);
      const before = await place();
      const copy = await open(hash.replace(/&steps=\d+/, '&steps=0'));
      await isReady(copy.page);
      await picture(copy.page);
      const after = await copy.page.evaluate(() => window.pleat.project(0));
      await copy.close();
      const off = Math.hypot(after.x - before.x, after.y - before.y);
      expectThat(off < 2, `a vertex is seen ${off} px off`);
    }),
  );

  await check('a long replay shows how far it is, and Stop says where it stopped', async () => {
    const { page, close } = await open('#scene=curtain&level=3&steps=3000');
    const stop = button(page, 'Stop');
    await until(page, (state) => state.ahead > 0);
    const words = page.locator('.work-bar');
    await eventually(async () => /first 50\.00 s/.test(await words.textContent()), 'how far it is');
    await stop.click();
    const { ahead, phase } = await until(page, (state) => state.ahead === null);
    expectThat(ahead === null && phase === 'ready', phase);
    expectThat(/Stopped at .* s, on the way to 50\.00 s/.test(await alertText(page)), 'no place');
    await close();
  });
}

async function checkWorker({ check, open }, visit) {
  await check('a worker that ends without a word is noticed in seconds, and started again', () =>
    visit('#scene=curtain&level=1', async (page) => {
      await button(page, 'Play').click();
      await until(page, (state) => state.numbers.time_s > 0.2);
      await page.workers()[0].evaluate(() => self.close());
      await until(page, (state) => state.problem?.source === 'worker', 5000);
      const sentence = await alertText(page);
      expectThat(/ended by itself after step \d+.*started again/.test(sentence), sentence);
      await isReady(page);
      expectThat((await stateOf(page)).numbers.step === 0, 'it is not at its start');
      await button(page, 'Play').click();
      await until(page, (state) => state.numbers.time_s > 0.2);
    }),
  );

  await check(
    'a step that takes for ever is shown, stopped, and gives way to a reset',
    async () => {
      const hang = () => {
        const { postMessage } = Worker.prototype;
        Worker.prototype.postMessage = function post(letter, transfer) {
          // The worker is kept busy by steps enough for an hour.
          if (window.hangs && letter.message?.type === 'step') letter.message.count = 1e7;
          postMessage.call(this, letter, transfer);
        };
      };
      const { page, close } = await open('#scene=curtain&level=1', {
        prepare: (fresh) => fresh.addInitScript(hang),
      });
      await isReady(page);
      await button(page, 'Step').click();
      await until(page, (state) => state.numbers.step === 1);
      const hangInStep = async () => {
        await page.evaluate(() => {
          window.hangs = true;
        });
        await button(page, 'Step').click();
        await until(page, (state) => state.busy?.type === 'step');
        await page.evaluate(() => {
          window.hangs = false;
        });
      };
      await hangInStep();
      await button(page, 'Stop').click();
      await isReady(page);
      expectThat(/was stopped after/.test(await alertText(page)), 'no sentence');
      await hangInStep();
      const begin = performance.now();
      await backToStart(page);
      const seconds = (performance.now() - begin) / 1000;
      expectThat(seconds < 10, `the reset took ${seconds} s`);
      await close();
    },
  );

  await check('a step of very many substeps is foretold, and Stop says what comes back', () =>
    visit('#scene=tablecloth&level=3', async (page) => {
      await isReady(page);
      await button(page, 'Step').click();
      await until(page, (state) => state.numbers.step === 1);
      await choice(page, 'Method').selectOption({ label: 'Explicit' });
      await until(page, ({ costs }) =>
        Object.values(costs).some(({ isMeasured, ms }) => !isMeasured && ms > 1000),
      );
      const strip = await page.locator('.numbers').textContent();
      expectThat(/≈ \d+ (s|min)expected/.test(strip), strip);
      await button(page, 'Step').click();
      await until(page, (state) => state.busy?.type === 'step');
      const words = await page.locator('.work-bar p').textContent();
      expectThat(/^One step at level 3: \d s of about \d+ (s|min)$/.test(words), words);
      await button(page, 'Stop').click();
      await isReady(page);
      expectThat(
        /The method is Implicit again, as before/.test(await alertText(page)),
        await alertText(page),
      );
    }),
  );

  await check('the word on lost graphics goes once they are back', async () => {
    const { page, close } = await open('#scene=curtain&level=0');
    await isReady(page);
    await page.evaluate(() => {
      const canvas = document.querySelector('#stage canvas');
      window.lost = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
      window.lost.loseContext();
    });
    await until(page, (state) => state.problem?.source === 'picture');
    await page.evaluate(() => window.lost.restoreContext());
    await until(page, (state) => state.problem === null);
    await close();
  });
}

async function checkFirstVisit({ check, open }, visit) {
  await check('a first visit fetches no reference until it compares', async () => {
    const asked = [];
    const { page, close } = await open('', {
      prepare: (fresh) => fresh.on('request', (request) => asked.push(request.url())),
    });
    const references = () => asked.filter((url) => url.endsWith('.reference'));
    await isReady(page);
    await page.waitForLoadState('networkidle');
    expectThat(references().length === 0, references().join(' '));
    await button(page, 'Compare').click();
    await until(page, (state) => state.numbers.reference !== null);
    expectThat(references().length === 1, `${references().length} fetched`);
    await close();
  });

  for (const [name, size] of [
    ['a phone', PHONE],
    ['a window at 200 %', { width: 640, height: 400 }],
  ]) {
    await check(`on ${name}, the sentence, the cloth and Play are on the first screen`, () =>
      visit(
        '',
        async (page) => {
          const ends = async (part) => {
            const { y, height } = await part.boundingBox();
            return [y, y + height];
          };
          for (const part of [page.locator('.caption'), button(page, 'Play')]) {
            const [top, bottom] = await ends(part);
            expectThat(top >= 0 && bottom <= size.height, `from ${top} to ${bottom} px`);
          }
          const [top] = await ends(canvasOf(page));
          const [play] = await ends(button(page, 'Play'));
          expectThat(play - top > LEAST_STAGE_PX, `${play - top} px of the cloth`);
        },
        size,
      ),
    );
  }

  await check('no word of the read-out is cut', () =>
    visit('#scene=curtain&level=0', async (page) => {
      await button(page, 'Play').click();
      await until(page, (state) => state.timing !== null && state.pace !== null);
      for (const width of [320, 390, 720, 1280]) {
        await page.setViewportSize({ width, height: 800 });
        const cut = await page
          .locator('.numbers dd')
          .evaluateAll((cells) =>
            cells
              .filter((cell) => cell.scrollWidth > cell.clientWidth + 1)
              .map((cell) => cell.textContent),
          );
        expectThat(cut.length === 0, `at ${width} px: ${cut.join(', ')}`);
      }
    }),
  );

  await check('no time of a step touches the border of its level, however long it is', () =>
    visit('#scene=curtain&level=0', async (page) => {
      const times = ['0.0012 ms', '> 9.8 min', '≈ 0.001 ms', '> 98000 min', '9.8 min'];
      for (const width of [320, 390, 720, 1280]) {
        await page.setViewportSize({ width, height: 800 });
        const rooms = await page.locator('.levels label').evaluateAll(
          (labels, words) =>
            labels.map((label, at) => {
              const time = label.querySelector('small');
              time.textContent = words[at];
              const written = document.createRange();
              written.selectNodeContents(time);
              const [box, text] = [label, written].map((part) => part.getBoundingClientRect());
              return Math.min(text.left - box.left, box.right - text.right);
            }),
          times,
        );
        expectThat(
          rooms.every((room) => room >= LEAST_ROOM_PX),
          `at ${width} px there are ${rooms.join(', ')} px beside ${times.join(', ')}`,
        );
      }
    }),
  );

  await check('boxes to tick are at least 24 px high and wide', () =>
    visit('#scene=curtain&level=0', async (page) => {
      const boxes = await page.locator('#panel input:is([type=checkbox], .option input)').all();
      expectThat(boxes.length >= 3, `${boxes.length} boxes`);
      for (const box of boxes) {
        const { width, height } = await box.boundingBox();
        expectThat(width >= 24 && height >= 24, `${width} by ${height}`);
      }
    }),
  );
}

async function checkRefused({ check, open }) {
  await check(
    'explicit with too few substeps: a sentence, a cloth, and a button that helps',
    async () => {
      const { page, close } = await open('#scene=curtain&level=0&stepper=explicit&substeps=1');
      await until(page, (state) => state.phase === 'refused');
      const sentence = await alertText(page);
      expectThat(/a step of it takes \d+/.test(sentence) && !/[/]method/.test(sentence), sentence);
      await eventually(async () => (await positionsOf(page)).length > 0, 'a cloth');
      expectThat(!(await page.locator('.invitation').isVisible()), 'the invitation is there');
      await button(page, 'Take as many as it needs').click();
      await isReady(page);
      await close();
    },
  );

  await check(
    'an explosion is told and ringed, and heals at the first press of what was tried',
    async () => {
      const { page, complaints, close } = await open(
        '#scene=tablecloth&level=2&stepper=xpbd&substeps=1',
      );
      await isReady(page);
      await button(page, 'Play').click();
      const { problem, numbers } = await until(page, (state) => state.problem !== null);
      expectThat(TELLS_WRONG_STRETCH.test(problem.sentence), problem.sentence);
      await until(page, (state) => !state.playing);
      const ring = page.locator('.place-ring');
      await ring.waitFor();
      await picture(page);
      const { x, y, width, height } = await ring.boundingBox();
      const place = await placeOn(page, problem.vertex);
      const off = Math.hypot(x + width / 2 - place.x, y + height / 2 - place.y);
      expectThat(off < 3, `the ring is ${off} px off`);
      await until(page, (state) => state.problem.remedy);
      const told = await alertText(page);
      expectThat(/would do|does not hold/.test(told), told);
      const offered = /^Go on from ([\d.]+) s with .+: [\d.]+ m?s a step, now [\d.]+ m?s$/;
      const [, fromS] = offered.exec(await button(page, offered).textContent());
      const [{ time_s: wrongS }] = numbers.warnings;
      expectThat(fromS > 0 && fromS < wrongS, `from ${fromS} s, wrong from ${wrongS} s on`);
      await button(page, offered).click();
      const mended = await until(page, ({ phase }) => phase === 'ready');
      expectThat(mended.playing, 'it stands still');
      const { time_s } = mended.numbers;
      expectThat(time_s >= fromS - 0.01 && time_s < wrongS + 1, `it is at ${time_s} s`);
      expectThat(!(await ring.isVisible()), 'the ring is still there');
      const healed = await until(page, (state) => state.problem || state.numbers.time_s > 2);
      expectThat(healed.problem === null, `it still says: ${healed.problem?.sentence}`);
      expectThat(complaints.length === 0, complaints.join(' | '));
      await close();
    },
  );

  await check(
    'from the first view a method is made to fail, told, and healed in three presses',
    async () => {
      const { page, close } = await open('');
      await isReady(page);
      const press = button(page, 'See what one substep does');
      expectThat(!(await press.isVisible()), 'it is there for a method that solves its equations');
      await choice(page, 'Method').selectOption({ label: 'XPBD' });
      await isReady(page);
      await press.click();
      const { problem, setting } = await until(page, (state) => state.problem?.remedy);
      expectThat(setting.substeps === 1, `${setting.substeps} substeps`);
      expectThat(TELLS_WRONG_STRETCH.test(problem.sentence), problem.sentence);
      expectThat(!(await press.isVisible()), 'it is there where there is one substep already');
      await button(page, problem.remedy.title).click();
      const healed = await until(page, ({ problem: now, numbers }) => now || numbers?.time_s > 1.5);
      expectThat(healed.problem === null, `it says: ${healed.problem?.sentence}`);
      await close();
    },
  );

  await check(
    'a stepper that sweeps holds as it starts, at each level that it is offered for',
    async () => {
      const { page, close } = await open('#scene=tablecloth&level=1');
      await isReady(page);
      await choice(page, 'Method').selectOption({ label: 'PBD' });
      await isReady(page);
      const coarse = (await stateOf(page)).setting.substeps;
      await page.locator('.levels label').nth(2).click();
      await isReady(page);
      const { setting } = await stateOf(page);
      expectThat(setting.level === 2 && setting.substeps > coarse, `${setting.substeps} substeps`);
      await button(page, 'Play').click();
      await until(page, (state) => state.problem || state.numbers.time_s > 1);
      expectThat(
        (await stateOf(page)).problem === null,
        await page.locator('.problem').textContent(),
      );
      await choice(page, 'Scene').selectOption({ label: 'Curtain' });
      await choice(page, 'Method').selectOption({ label: 'Hierarchical PBD' });
      await isReady(page);
      const coarsest = page.locator('.levels label').nth(0);
      expectThat(await coarsest.locator('input').isDisabled(), 'level 0 is offered');
      expectThat(
        /Too coarse for this method/.test(await coarsest.getAttribute('title')),
        'no reason',
      );
      await close();
    },
  );

  await check('no invitation where there is no picture', async () => {
    const { page, close } = await open('#scene=curtain&level=0', {
      prepare: (fresh) =>
        fresh.addInitScript(() => {
          HTMLCanvasElement.prototype.getContext = () => null;
        }),
    });
    await isReady(page);
    expectThat((await page.locator('#stage .invitation').count()) === 0, 'it is there');
    await close();
  });

  await check('levels tell what a step takes, measured or expected', async () => {
    const { page, close } = await open('');
    await isReady(page);
    await until(page, (state) => state.timing !== null);
    const texts = await page.locator('.levels small').allTextContents();
    expectThat(/^[\d.]+ m?s$/.test(texts[2]), texts.join(', '));
    expectThat(texts.filter((text) => /^≈ [\d.]+ m?s$/.test(text)).length === 3, texts.join(', '));
    expectThat(/^> [\d.]+ m?s$/.test(texts[4]), texts.join(', '));
    await choice(page, 'Method').selectOption({ label: 'XPBD' });
    await isReady(page);
    expectThat((await page.locator('.levels small').allTextContents())[4] === '–', 'of another');
    await close();
  });
}

async function checkInside({ check }, visit) {
  await check('energy is drawn, told and written in a table while its account is open', () =>
    visit('#scene=swinging-sheet&level=0', async (page) => {
      const heading = page.getByText('Energy: where it is and where it goes');
      const box = page.locator('.energy');
      await heading.click();
      await eventually(
        async () => /begin with the next step/.test(await box.textContent()),
        'what to do for a line',
      );
      await button(page, 'Play').click();
      await until(page, (state) => state.energies.length > 30);
      await button(page, 'Pause').click();
      const words = await box.locator('figcaption').textContent();
      expectThat(/moves with .* less by height than at 0\.00 s.*damping took/.test(words), words);
      const lines = await box.locator('.energy-over-time .time-line').count();
      expectThat(lines >= 5, `${lines} lines`);
      await box.getByText('The same as a table').click();
      await eventually(async () => (await box.locator('tbody tr').count()) === 9, 'rows');
      await heading.click();
      await until(page, (state) => !state.energy && state.energies.length === 0);
    }),
  );

  await check('wool at rest and bouncing are compared, and it can be let bounce', () =>
    visit('#scene=wool', async (page) => {
      const box = page.locator('.contact');
      await page.getByText('Contact: cloth that rests, and cloth that bounces').click();
      await eventually(
        async () => /move along the normal with/.test(await box.textContent()),
        'what contact does',
      );
      const lines = await box.locator('.contact-over-time .time-line').count();
      expectThat(lines === 2, `${lines} lines`);
      await page.getByLabel('Let the shown cloth bounce').check();
      await eventually(async () => /response=uniform/.test(page.url()), 'a link that bounces');
      await until(page, (state) => state.phase === 'ready' && state.setting.bounces);
      expectThat((await box.locator('.contact-over-time .time-line').count()) === 2, 'the study');
    }),
  );

  await check('cloth that meets itself goes on running, and what that costs is told', () =>
    visit('#scene=tablecloth&level=1', async (page) => {
      const choiceOf = page.getByRole('checkbox', { name: 'Cloth meets itself' });
      const cell = page.locator('#strip .cloth-contact');
      const line = page.locator('#strip .held-back');
      await button(page, 'Play').click();
      await until(page, (state) => state.numbers.time_s > 0.2);
      expectThat(!(await cell.isVisible()) && !(await line.isVisible()), 'told of cloth without');
      await choiceOf.focus();
      await page.keyboard.press('Space');
      const on = await until(
        page,
        ({ setting, timing }) => setting.meetsItself && timing?.clothContactMs > 0,
      );
      expectThat(on.playing && on.problem === null, `it says: ${on.problem?.sentence}`);
      expectThat(on.numbers.time_s > 0.2, 'it began anew');
      await eventually(
        async () => /^Self-contact[\d.]+ ms[\d.]+ % of a step$/.test(await cell.textContent()),
        'what it costs',
      );
      expectThat(/^Held back: /.test(await line.textContent()), await line.textContent());
      await eventually(async () => /self_contact=on/.test(page.url()), 'a link that has it');
      await choiceOf.uncheck();
      const off = await until(
        page,
        ({ phase, numbers }) =>
          phase === 'ready' && !numbers.cloth_contact && numbers.time_s > on.numbers.time_s + 0.1,
      );
      expectThat(off.playing, 'it stopped');
      expectThat(!(await cell.isVisible()) && !(await line.isVisible()), 'still told');
      expectThat(!/self_contact/.test(page.url()), page.url());
    }),
  );

  await check('springs are drawn by whether they are implicit, and their share is told', () =>
    visit('#scene=swinging-sheet&level=0&stepper=imex&step=1/240', async (page) => {
      const without = await picture(page);
      await page.getByLabel('Springs: explicit or implicit').check();
      await until(page, (state) => state.springSplit !== null);
      const words = () => page.locator('.legend-springs .legend-present').textContent();
      const told = await words();
      expectThat(/^\d+ of \d+ springs are implicit at this step: \d+\s%\.$/.test(told), told);
      await eventually(async () => !(await picture(page)).equals(without), 'lines');
      await choice(page, 'Step').selectOption({ label: '1/960 s' });
      await eventually(async () => (await words()) !== told, 'another share at another step');
      await choice(page, 'Method').selectOption({ label: 'XPBD' });
      await eventually(async () => /are taken alike/.test(await words()), 'none of XPBD');
    }),
  );

  await check('what imex saves follows the slider of substeps while it is dragged', () =>
    visit('#scene=pendulum', async (page) => {
      const line = page.locator('.imex-saving');
      await eventually(async () => /drag to measure/.test(await line.textContent()), 'a share');
      const { setting, summary } = await stateOf(page);
      const slider = page.getByRole('slider', { name: 'Substeps' });
      await slider.scrollIntoViewIfNeeded();
      const { x, y, width, height } = await slider.boundingBox();
      const dragTo = async (part) => {
        await page.mouse.move(x + part * width, y + height / 2);
        const { state, words } = await momentUntil(
          page,
          ({ draggedSubsteps: n, imexSaving: known, setting: { stepS } }) =>
            n !== null && known.substepS === stepS / n,
          '.imex-saving',
        );
        return { substeps: state.draggedSubsteps, ...state.imexSaving, words };
      };
      await page.mouse.move(x + 1, y + height / 2);
      await page.mouse.down();
      const seen = [];
      for (const part of [0.02, 0.2, 0.4, 0.6]) seen.push(await dragTo(part));
      const told = seen.map(({ substeps, share }) => `${substeps}: ${share}`).join(', ');
      for (const [index, { substeps, share, words }] of seen.entries()) {
        const before = seen[index - 1] ?? { substeps: 0, share: 1, words: '' };
        expectThat(substeps > before.substeps && share <= before.share, told);
        expectThat(words !== before.words, words);
        expectThat(words.includes(`Of ${summary.n_springs} springs`), words);
      }
      expectThat(seen[0].share > seen.at(-1).share, told);
      expectThat(/; measuring what a step takes/.test(seen.at(-1).words), seen.at(-1).words);
      await until(page, ({ imexSaving }) => imexSaving.time > 0);
      const words = await line.textContent();
      expectThat(/; a step takes [\d.]+ of Implicit’s time\.$/.test(words), words);
      expectThat((await stateOf(page)).setting.substeps === setting.substeps, 'it is set already');
      await page.mouse.up();
      await until(page, (state) => state.setting.substeps === seen.at(-1).substeps);
      await isReady(page);
      expectThat((await line.textContent()) === words, await line.textContent());
    }),
  );

  await check('imex takes the substeps that the wanted share of explicit springs needs', () =>
    visit('#scene=pendulum', async (page) => {
      await until(page, ({ imexSaving }) => imexSaving !== null);
      await choice(page, 'Springs that shall be explicit').selectOption({ label: 'At least 75 %' });
      const { summary, setting } = await until(
        page,
        ({ phase, imexSaving }) => phase === 'ready' && imexSaving.share <= 0.25,
      );
      expectThat(summary.substeps > setting.substeps, `${summary.substeps} substeps`);
      const note = page.getByText(`One step takes ${summary.substeps} substeps.`);
      await eventually(() => note.isVisible(), 'the number of substeps');
    }),
  );
}

export async function checkMotion(harness, visit) {
  await checkHand(harness, visit);
  await checkLinks(harness, visit);
  await checkWorker(harness, visit);
  await checkFirstVisit(harness, visit);
  await checkRefused(harness);
  await checkInside(harness, visit);
}
