// What a visitor does and sees, for the checks of every view.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { expectThat } from './harness.mjs';

const axeText = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** Only the shown view has a canvas that can be seen. */
export const canvasOf = (page) => page.locator('canvas').filter({ visible: true });
export const picture = (page) => canvasOf(page).screenshot();
export const button = (page, name) => page.getByRole('button', { name, exact: true });
export const choice = (page, name) => page.getByRole('combobox', { name, exact: true });

/** Serious and critical findings of axe, as text, once what `details` matches is opened. */
export async function findingsOf(page, details = null) {
  for (const box of details ? await page.locator(details).all() : []) {
    await box.evaluate((element) => element.setAttribute('open', ''));
  }
  await page.evaluate(axeText);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id} at ${nodes.map((node) => node.target.join(' ')).join(', ')}`);
}

export function expectSilence(complaints) {
  expectThat(complaints.length === 0, `console: ${complaints.join(' | ')}`);
}

/** A square cloth of `size` metres that stands upright, in a text of two triangles a cell. */
export function squareObj(size, cells = 6) {
  const at = (row, column) => row * (cells + 1) + column + 1;
  const lines = [];
  for (let row = 0; row <= cells; ++row)
    for (let column = 0; column <= cells; ++column)
      lines.push(`v ${(size * column) / cells} ${size * (2 - row / cells)} 0`);
  for (let row = 0; row < cells; ++row)
    for (let column = 0; column < cells; ++column) {
      const [a, b, c, d] = [
        at(row, column),
        at(row + 1, column),
        at(row + 1, column + 1),
        at(row, column + 1),
      ];
      lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
    }
  return `${lines.join('\n')}\n`;
}

/** Drops a file on the page, as a visitor's hand does. */
export async function drop(page, name, text) {
  const transfer = await page.evaluateHandle(
    ([fileName, content]) => {
      const made = new DataTransfer();
      made.items.add(new File([content], fileName));
      return made;
    },
    [name, text],
  );
  await canvasOf(page).dispatchEvent('dragover', { dataTransfer: transfer });
  await canvasOf(page).dispatchEvent('drop', { dataTransfer: transfer });
}
