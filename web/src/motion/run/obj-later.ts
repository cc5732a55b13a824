// The source of meshes, which comes with the first one.
import type { ObjUnit } from '../../shared/state/obj-file';
import type { Store } from '../../shared/state/store';
import type { MotionState } from '../state/motion-state';
import { later } from './later';
import type { StartObj } from './obj-client';
import type { ObjSource } from './obj-source';

export type LaterObj = Pick<ObjSource, 'open' | 'setUnit' | 'bringExample'> & { cancel(): void };

export function createLaterObj(
  store: Store<MotionState>,
  start: StartObj | undefined,
  onExample: () => void,
): LaterObj {
  const bring = later(store, 'What reads a mesh', async () => {
    const { ObjSource } = await import('./obj-source');
    return new ObjSource(store, start, onExample);
  });
  return {
    open: async (file: File) => (await bring())?.open(file),
    setUnit: async (unit: ObjUnit) => (await bring())?.setUnit(unit),
    cancel: async () => (await bring())?.cancel(),
    async bringExample() {
      const source = await bring();
      if (source) await source.bringExample();
      else store.set({ phase: 'refused', playing: false });
    },
  };
}
