// The visitor's mesh: the file, what holds it, and what to know about it.
import { element, field, setText } from '../../shared/panels/element';
import { createObjPicker } from '../../shared/panels/obj-picker';
import { type Store, watch } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';
import { type Hold, holdFor, holdsOf, type ObjMesh } from '../state/obj-mesh';

/** More triangles than this and a step takes a good part of a second on most machines. */
const MANY_TRIANGLES = 20000;

function titleOf(hold: Hold): string {
  if (hold === 'highest') return 'Its highest points';
  if (hold === 'nothing') return 'Nothing';
  return `Its group “${hold.slice('group:'.length)}”`;
}

function sentences(mesh: ObjMesh): string {
  const { name, nVertices, nTriangles, threads, isOwn, start } = mesh;
  const parts = [`${name}: ${nVertices} vertices, ${nTriangles} triangles, taken in metres.`];
  if (threads === 'down') parts.push('No texture coordinates: threads run downward.');
  if (threads === 'along_x') parts.push('No texture coordinates: threads run along x.');
  if (nTriangles > MANY_TRIANGLES) parts.push('So many triangles will be slow.');
  if (start)
    parts.push(
      'It starts from the shape it was pulled into at level 0; finer levels have vertices that this shape has not, and start from rest.',
    );
  if (isOwn)
    parts.push('It stays on this machine, and no link carries it: a reload shows the skirt.');
  return parts.join(' ');
}

export function createObjPanel(
  parent: HTMLElement,
  store: Store<MotionState>,
  actions: { openObj(file: File): void },
): () => void {
  const holds = element('select', {
    change() {
      const { setting } = store.get();
      store.set({ setting: { ...setting, hold: holds.value as Hold } });
    },
  });
  const held = field('Held by', holds);
  const note = element('p', { class: 'note' });
  const box = element('div', { class: 'mesh' });
  const closePicker = createObjPicker(box, actions);
  box.append(held, note);
  parent.append(box);
  let listed: ObjMesh | null = null;
  const stop = watch(store, ['setting', 'mesh'], ({ setting, mesh }) => {
    box.hidden = setting.preset !== 'obj';
    held.hidden = mesh === null;
    if (mesh === null) return;
    if (mesh !== listed) {
      holds.replaceChildren(
        ...holdsOf(mesh).map((hold) => element('option', { value: hold }, titleOf(hold))),
      );
      listed = mesh;
    }
    holds.value = holdFor(mesh, setting.hold);
    setText(note, sentences(mesh));
  });
  return () => {
    stop();
    closePicker();
  };
}
