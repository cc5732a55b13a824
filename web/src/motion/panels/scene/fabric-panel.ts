// The choice of a fabric, its measured numbers, and where each comes from.

import { fabricNamed, fabrics } from '../../../shared/fabric/fabric-data';
import { lookOf } from '../../../shared/fabric/fabric-look';
import { choice, element, field } from '../../../shared/panels/element';
import {
  quantityMeanings,
  quantityRows,
  sourceList,
} from '../../../shared/panels/fabric-quantities';
import { addSection, folded, noteLine } from '../../../shared/panels/section';
import { tableOf } from '../../../shared/panels/table-parts';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';
import { ownQuantities } from '../../state/setting';

export function createFabricPanel(parent: HTMLElement, store: Store<MotionState>): void {
  const names = choice(
    fabrics.map((fabric) => ({
      value: fabric.name_en,
      title: `${fabric.name_en} · ${fabric.use_en}`,
    })),
    (fabric) => store.set({ setting: { ...store.get().setting, fabric } }),
  );
  const swatch = element('span', { class: 'swatch', 'aria-hidden': 'true' });
  const construction = noteLine();
  const sourceBody = element('div', {}, construction);
  const rows = element('tbody');
  const sourcesBox = folded('Where the numbers come from', {}, sourceBody);
  const table = tableOf('quantities', 'Measured numbers of the fabric', rows);
  const meaningBox = folded('What the words mean', {}, quantityMeanings());
  addSection(
    parent,
    'Fabric',
    field('Fabric', names.control, swatch),
    table,
    sourcesBox,
    meaningBox,
  );
  let shown = '';
  watch(store, ['setting'], ({ setting }) => {
    const own = ownQuantities(setting);
    const wanted = JSON.stringify([setting.fabric, own]);
    if (wanted === shown) return;
    shown = wanted;
    const fabric = fabricNamed(setting.fabric);
    const { front, back } = lookOf(fabric.id);
    names.select(setting.fabric);
    swatch.style.background = `linear-gradient(135deg, ${front} 50%, ${back} 50%)`;
    construction.textContent = `Taken as: ${fabric.assumed_construction}.`;
    rows.replaceChildren(...quantityRows(fabric, own));
    sourceBody.replaceChildren(construction, sourceList(fabric));
  });
}
