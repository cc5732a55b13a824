// npm run picture: the README's picture, docs/page.png, from the built page. A chart stands beside
// the cloth whose sweep made it.
import { fileURLToPath } from 'node:url';
import { createHarness, eventually, isReady, stateOf, until } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/page.png', import.meta.url));
const harness = await createHarness();
const { page, close } = await harness.open('#scene=tablecloth&fabric=silk&level=1&start=1.6');
await isReady(page);
await page.getByRole('button', { name: 'Measure speed and error' }).click();
await until(page, (state) => state.sweep.phase !== 'running' && state.sweep.rows.length > 0);
await eventually(async () => (await stateOf(page)).phase === 'ready', 'the cloth is back');
await page.screenshot({ path: target });
await close();
await harness.finish();
