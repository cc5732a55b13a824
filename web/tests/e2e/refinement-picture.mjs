// npm run refinement-picture: a skirt coarse, refined and fine, docs/refinement.png, from the built
// page.
import { fileURLToPath } from 'node:url';
import { createHarness, until } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/refinement.png', import.meta.url));
const harness = await createHarness();
const { page, close } = await harness.open('#view=refinement', { width: 1440, height: 860 });
await until(page, (state) => state.phase === 'ready');
await page.screenshot({ path: target });
await close();
await harness.finish();
