// npm run refinement-picture: docs/refinement.png, the picture that the view of refinement opens on, from
// the built page.
import { fileURLToPath } from 'node:url';
import { createHarness, expectThat, until } from './harness.mjs';

const target = fileURLToPath(new URL('../../../docs/refinement.png', import.meta.url));
const harness = await createHarness();
const { page, close } = await harness.open('#view=refinement', { width: 1440, height: 860 });
await until(page, ({ phase, panes }) => phase === 'ready' && panes.planned.lostM !== null);
const warning = await page
  .getByText(/passes through itself here/)
  .filter({ visible: true })
  .count();
expectThat(warning === 0, 'cloth passes through itself in the picture');
await page.screenshot({ path: target });
await close();
await harness.finish();
