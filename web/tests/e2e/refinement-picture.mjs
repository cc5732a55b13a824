// npm run refinement-picture: the fine run of trousers as an even mesh shows it, one refined with as
// many vertices, and the fine one: docs/refinement.png, from the built page.
import { fileURLToPath } from 'node:url';
import { createHarness, until } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/refinement.png', import.meta.url));
const harness = await createHarness();
const { page, close } = await harness.open(
  '#view=refinement&garment=slim_trousers&beside=even&fine-cloth=on&colour=material&start=4',
  { width: 1440, height: 860 },
);
await until(page, ({ phase, panes }) => phase === 'ready' && panes.planned.lostM !== null);
// Nearer, to where the hip folds.
await page.mouse.move(180, 516);
for (let step = 0; step < 4; ++step) {
  await page.mouse.wheel(0, -240);
  await page.waitForTimeout(400);
}
await page.screenshot({ path: target });
await close();
await harness.finish();
