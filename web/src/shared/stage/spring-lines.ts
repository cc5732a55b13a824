// The springs as lines over the cloth, in one colour where they are explicit and in another where
// they are implicit.
import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
} from 'three';
import type { SpringSplit } from '../bindings/pleat-module';

/** The ends of the springs that are implicit, or of those that are not. */
export function endsOf({ ends, isImplicit }: SpringSplit, wantsImplicit: boolean): number[] {
  return Array.from(ends).filter((_, end) => {
    const kind = isImplicit[Math.floor(end / 2)];
    return kind !== undefined && (kind !== 0) === wantsImplicit;
  });
}

function createLines() {
  const lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  lines.material.toneMapped = false;
  lines.frustumCulled = false;
  return lines;
}

export function createSpringLines() {
  const explicit = createLines();
  const implicit = createLines();
  const kinds = [explicit, implicit];
  const object = new Group();
  object.add(...kinds);
  object.visible = false;
  let places = new BufferAttribute(new Float32Array(0), 3);
  return {
    object,
    /** Null draws none. */
    setSplit(split: SpringSplit | null) {
      object.visible = split !== null;
      if (!split) return;
      explicit.geometry.setIndex(endsOf(split, false));
      implicit.geometry.setIndex(endsOf(split, true));
    },
    /** Takes positions, three numbers a vertex, to the screen; call before drawing. */
    update(positions: Float32Array) {
      if (!object.visible) return;
      if (places.array.length !== positions.length) {
        places = new BufferAttribute(positions.slice(), 3).setUsage(DynamicDrawUsage);
        for (const { geometry } of kinds) {
          geometry.dispose();
          geometry.setAttribute('position', places);
        }
      }
      places.array.set(positions);
      places.needsUpdate = true;
    },
    setColours(colours: { explicit: string; implicit: string }) {
      explicit.material.color.set(colours.explicit);
      implicit.material.color.set(colours.implicit);
    },
  };
}

export type SpringLines = ReturnType<typeof createSpringLines>;
