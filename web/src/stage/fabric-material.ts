// How a fabric looks, on the two materials of a cloth: its back has a tint of its own, so that folds read.
import type { MeshPhysicalMaterial } from 'three';
import { type FabricLook, SHEEN_ROUGHNESS } from './fabric-look';

export function dress(
  front: MeshPhysicalMaterial,
  back: MeshPhysicalMaterial,
  look: FabricLook,
): void {
  for (const [material, colour] of [
    [front, look.front],
    [back, look.back],
  ] as const) {
    material.color.set(colour);
    material.roughness = look.roughness;
    material.sheen = look.sheen;
    material.sheenRoughness = SHEEN_ROUGHNESS;
    material.sheenColor.set(look.sheenColour);
    material.transparent = look.opacity < 1;
    material.opacity = look.opacity;
    material.needsUpdate = true;
  }
}
