// npm run contact-sheet: all fabrics under one pull, docs/fabrics.png, from the built page.
import { fileURLToPath } from 'node:url';
import { isFound } from './fabrics.mjs';
import { createHarness } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/fabrics.png', import.meta.url));
const harness = await createHarness();
const { page, close } = await harness.open('#view=fabrics&scene=pull&gallery=on', {
  width: 1640,
  height: 900,
});
await isFound(page);
await page.evaluate(() => {
  for (const word of document.querySelectorAll('.invitation')) word.hidden = true;
});
await page.locator('#fabrics .stage').screenshot({ path: target });
await close();
await harness.finish();
