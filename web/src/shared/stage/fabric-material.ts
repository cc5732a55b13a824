// The materials of cloth: a fabric's two sides, of which the back has a tint of its own, so that
// folds read; or colours for numbers.
import {
  BackSide,
  DoubleSide,
  FrontSide,
  MeshBasicMaterial,
  MeshPhysicalMaterial,
  type Texture,
} from 'three';
import { type FabricLook, SHEEN_ROUGHNESS } from '../fabric/fabric-look';

/** A picture that is painted on cloth, with holes where it is transparent. */
export interface Print {
  texture: Texture;
  /** Place of each vertex in it, two numbers each. */
  coordinates: Float32Array;
}

/** Less of a yarn than this is a hole. */
const HOLE = 0.5;

export function createClothMaterials() {
  const front = new MeshPhysicalMaterial({ side: FrontSide, shadowSide: DoubleSide });
  const back = new MeshPhysicalMaterial({ side: BackSide });
  const heat = new MeshBasicMaterial({ side: DoubleSide, vertexColors: true });
  heat.toneMapped = false;

  function setLook(look: FabricLook): void {
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

  function setTexture(texture: Texture | null): void {
    if (front.map === texture) return;
    for (const material of [front, back]) {
      material.map = texture;
      material.bumpMap = texture;
      material.alphaTest = texture ? HOLE : 0;
      material.needsUpdate = true;
    }
  }

  return { front, back, heat, setLook, setTexture };
}
