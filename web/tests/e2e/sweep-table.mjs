// The table of a sweep holds whatever its rows are, on the slowest machine too.
import { expectThat, stateOf, until } from './harness.mjs';
import { button } from './visitor.mjs';

const EXPLODED = {
  kind: 'stretch',
  time_s: 0.0123,
  vertex: 0,
  value: 98.7,
  bound: 0.01,
  sentence: '',
  is_nonsense: true,
  hints: {},
};

/** Rows of cloth that is slow, far off, untold or unsound. */
const WIDE = [
  { ms_per_frame: 1234, spread_ms: 987, position_error_m: 1.234, method_error_m: 8.765e-5 },
  { ms_per_frame: 9.87e6, spread_ms: 9876, largest_stretch: 98.7, rms_stretch: 12.3 },
  { position_error_m: 9.87e6, position_error_percent: 9.87e8, method_error_m: 9.87e6 },
  { status: 'not_converged', n_vertices: 102400, warnings: [EXPLODED] },
  { position_error_m: null, mesh_error_m: null },
  { position_error_m: null, reference: { uncertainty_m: null } },
  { status: 'diverged', message: 'step 123456: positions are no numbers, first at vertex 102400' },
  { n_substeps: 10921, method: { stepper: 'projective', step_s: 1 / 1200, iterations: 1000 } },
];

/** Puts such values into the rows that workers send. */
const slowly = (page) =>
  page.addInitScript((wide) => {
    const { set } = Object.getOwnPropertyDescriptor(Worker.prototype, 'onmessage');
    const change = (row, { reference, method, ...rest }) => {
      Object.assign(row, rest);
      Object.assign(row.reference, reference);
      Object.assign(row.method, method);
    };
    Object.defineProperty(Worker.prototype, 'onmessage', {
      set(hear) {
        set.call(this, (event) => {
          const rows = event.data.message?.report?.rows ?? [];
          rows.forEach((row, index) => {
            change(row, wide[index % wide.length]);
          });
          hear(event);
        });
      },
    });
  }, WIDE);

/** Cells that are wider than their place, and the box if its table is. */
const cutIn = (page) =>
  page
    .locator('#tray .table-box')
    .evaluate((box) =>
      [box, ...box.querySelectorAll('th, td, button')]
        .filter((part) => part.scrollWidth > part.clientWidth)
        .map(
          (part) =>
            `${part.textContent.slice(0, 40)}: ${part.scrollWidth} px of ${part.clientWidth}`,
        ),
    );

export async function checkSweepTable({ check }, visit) {
  await check('whatever the rows of a sweep hold, its table is not cut at any width', () =>
    visit(
      '#scene=swinging-sheet&level=0',
      async (page) => {
        await button(page, 'Measure speed and error').click();
        await until(page, ({ sweep }) => sweep.rows.length >= 8);
        await button(page, 'Cancel').click();
        const { rows } = (await stateOf(page)).sweep;
        expectThat(rows[0].ms_per_frame === 1234, 'the rows are not the slow ones');
        for (const width of [320, 360, 390, 720, 1079, 1080, 1280, 1920]) {
          await page.setViewportSize({ width, height: 844 });
          const cut = await cutIn(page);
          expectThat(cut.length === 0, `at ${width} px: ${cut.join('; ')}`);
        }
      },
      { width: 390, height: 844, prepare: slowly },
    ),
  );
}
