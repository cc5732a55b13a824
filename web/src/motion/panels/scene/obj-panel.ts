// The visitor's mesh: the file, what holds it, and what to know about it.
import { element, field, setText } from '../../../shared/panels/element';
import { createObjPicker } from '../../../shared/panels/obj-picker';
import { createObjUnit } from '../../../shared/panels/obj-unit';
import { createReading } from '../../../shared/panels/reading';
import { noteLine } from '../../../shared/panels/section';
import { OBJ_UNITS, type ObjUnit } from '../../../shared/state/obj-file';
import { type Store, watch } from '../../../shared/state/store';
import type { MotionState } from '../../state/motion-state';
import { type Hold, holdFor, holdsOf, type ObjMesh } from '../../state/obj-mesh';

/** More triangles than this and a step takes a good part of a second on most machines. */
const MANY_TRIANGLES = 20000;

function titleOf(hold: Hold): string {
  if (hold === 'highest') return 'Its highest points';
  if (hold === 'nothing') return 'Nothing';
  return `Its group “${hold.slice('group:'.length)}”`;
}

export interface ObjActions {
  open(file: File): void;
  setUnit(unit: ObjUnit): void;
  /** Gives up what is being read. */
  cancel(): void;
}

export function sentences(mesh: ObjMesh): string {
  const { name, nVertices, nTriangles, threads, isOwn, start, unit, odd, skipped } = mesh;
  const { title } = OBJ_UNITS.find(({ value }) => value === unit) ?? OBJ_UNITS[0];
  const parts = [`${name}: ${nVertices} vertices, ${nTriangles} triangles, taken in ${title}.`];
  if (odd) parts.push(odd);
  if (skipped) parts.push(`${skipped}.`);
  if (threads === 'down') parts.push('No texture coordinates: threads run downward.');
  if (threads === 'along_x') parts.push('No texture coordinates: threads run along x.');
  if (nTriangles > MANY_TRIANGLES) parts.push('So many triangles will be slow.');
  if (start)
    parts.push(
      'It starts from this shape at level 0; finer levels have vertices that this shape has not, and start from rest.',
    );
  if (isOwn)
    parts.push('It stays on this machine, and no link carries it: a reload shows the skirt.');
  return parts.join(' ');
}

export function createObjPanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: ObjActions,
): void {
  const holds = element('select', {
    change() {
      const { setting } = store.get();
      store.set({ setting: { ...setting, hold: holds.value as Hold } });
    },
  });
  const held = field('Held by', holds);
  const note = noteLine();
  const box = element('div', { class: 'mesh' });
  createObjPicker(box, { openObj: (file) => actions.open(file) });
  const unit = createObjUnit((value) => actions.setUnit(value));
  const reading = createReading(() => actions.cancel());
  box.append(reading.box, unit.box, held, note);
  parent.append(box);
  let listed: ObjMesh | null = null;
  watch(store, ['setting', 'mesh', 'reading'], ({ setting, mesh, reading: name }) => {
    box.hidden = setting.preset !== 'obj' && name === null;
    reading.show(name);
    held.hidden = mesh === null;
    unit.box.hidden = !mesh?.isOwn || mesh.start !== undefined;
    if (mesh === null) return;
    if (mesh !== listed) {
      holds.replaceChildren(
        ...holdsOf(mesh).map((hold) => element('option', { value: hold }, titleOf(hold))),
      );
      listed = mesh;
    }
    unit.select(mesh.unit);
    holds.value = holdFor(mesh, setting.hold);
    setText(note, sentences(mesh));
  });
}
