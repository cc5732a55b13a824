// npm run sweep-times: how long the page's default sweep of each scene takes a visitor, from the
// built page; one line of JSON for each.
import { createHarness, isReady, stateOf, until } from './harness.mjs';
import { button } from './visitor.mjs';

const kFirstRows = 2; // a chart has something to say from two on
const kLongestMs = 600000;

const harness = await createHarness();
for (const scene of ['curtain', 'swinging-sheet', 'tablecloth']) {
  const { page, close } = await harness.open(`#scene=${scene}`);
  await isReady(page);
  await page.getByLabel('Cloth to measure').selectOption({ label: 'The scene shown' });
  const begin = performance.now();
  const since = () => performance.now() - begin;
  await button(page, 'Measure speed and error').click();
  await until(page, ({ sweep }) => sweep.rows.length >= kFirstRows, kLongestMs);
  const first_rows_ms = since();
  await until(page, ({ sweep }) => sweep.phase !== 'running', kLongestMs);
  const all_ms = since();
  const { sweep } = await stateOf(page);
  const known = sweep.rows.filter((row) => row.position_error_m !== null).length;
  console.log(
    JSON.stringify({
      scene,
      phase: sweep.phase,
      rows: sweep.rows.length,
      known,
      first_rows_ms,
      all_ms,
    }),
  );
  await close();
}
await harness.finish();
