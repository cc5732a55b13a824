// A visitor can pull cloth until it tears, let go, and have it whole again.
import { expectThat, momentUntil, positionsOf, stateOf, until } from './harness.mjs';
import { button, expectAccessible, picture, placeOn } from './visitor.mjs';

/** The vertex in the middle of the lower hem. */
async function hemOf(page) {
  const places = await positionsOf(page);
  let hem = 0;
  for (let v = 0; 3 * v < places.length; ++v) {
    const away = (vertex) => Math.abs(places[3 * vertex]) + places[3 * vertex + 1];
    if (away(v) < away(hem)) hem = v;
  }
  return hem;
}

export async function checkTearing({ check, countColours }, visit) {
  await check(
    'a curtain hangs still until it is pulled, tears in the hand, and is whole after a reset',
    () =>
      visit('#scene=tearing-curtain', async (page) => {
        const whole = (await stateOf(page)).summary.n_vertices;
        const { x, y } = await placeOn(page, await hemOf(page));
        await page.mouse.move(x, y);
        await page.mouse.down();
        for (let pull = 1; pull <= 20; ++pull) {
          await page.mouse.move(x + 8 * pull, y - 2 * pull);
          await page.waitForTimeout(50);
        }
        const { state: torn, places } = await momentUntil(
          page,
          (state) => state.summary.n_vertices > whole + 5,
        );
        expectThat(torn.held && torn.problem === null, JSON.stringify(torn.problem));
        expectThat(places.length === 3 * torn.summary.n_vertices, 'a place for each vertex');
        expectThat((await countColours(await picture(page))) > 100, 'the picture is blank');
        await page.mouse.up();
        await until(page, (state) => !state.held && state.numbers.warnings.length === 0);
        await expectAccessible(page);
        await button(page, 'Reset').click();
        await until(page, (state) => state.phase === 'ready' && state.summary.n_vertices === whole);
      }),
  );
}
