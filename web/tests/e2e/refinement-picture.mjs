// npm run refinement-picture: trousers on an even mesh, refined with as many vertices, and fine:
// docs/refinement.png, from the built page.
import { fileURLToPath } from 'node:url';
import { createHarness, until } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/refinement.png', import.meta.url));
const harness = await createHarness();
const { page, close } = await harness.open(
  '#view=refinement&garment=slim_trousers&beside=even&colour=material&start=3.3',
  { width: 1440, height: 860 },
);
await until(page, ({ phase, panes }) => phase === 'ready' && panes.planned.lostM !== null);
await page.screenshot({ path: target });
await close();
await harness.finish();
