// The colours that the panes are painted with.
import { linearColour, MAGNITUDE_MAP, paint } from '../../shared/stage/colormap';
import type { Paint } from '../stage/graded-cloth';
import { countFaces, faceAt, facePatterns, type PlanFile } from '../state/plan-file';
import type { RefinementState } from '../state/refinement-state';
import type { GarmentMesh } from '../worker/garment-protocol';

/** Colours of levels and of patterns: few, told apart by lightness too. */
export const LEVEL_COLOURS = ['#f3e3b5', '#5bb3a6', '#4380bd', '#5a2a78'];
export const PATTERN_COLOURS = ['#d5d8dc', '#f0a25a', '#b3282d', '#5b1038'];

/** Colour where there is nothing to tell: no colour of a scale, and no fabric's. */
export const NEUTRAL_COLOUR = '#c9c5bd';

function colourOf(colours: readonly string[], index: number): readonly number[] {
  return linearColour(colours[Math.min(index, colours.length - 1)] ?? '#000000');
}

function facePaint(numbers: readonly number[], colours: readonly string[]): Paint {
  return {
    kind: 'faces',
    colours: Float32Array.from(numbers.flatMap((number) => colourOf(colours, number))),
  };
}

function neutralPaint(mesh: GarmentMesh): Paint {
  const none = Array.from({ length: countFaces(mesh.faces) }, () => 0);
  return facePaint(none, [NEUTRAL_COLOUR]);
}

/** One number a face, on a scale from 0. */
function scalePaint(values: Float32Array, high: number): Paint {
  const colours = new Float32Array(3 * values.length);
  paint(MAGNITUDE_MAP, values, 0, high, colours);
  return { kind: 'faces', colours };
}

/**
 * The colours of a mesh. `distances` are those of its faces [m]: `none` where there are none, as of the fine
 * mesh from itself, null where only those of its vertices are known.
 */
export function paintOf(
  { colour, ranges }: Pick<RefinementState, 'colour' | 'ranges'>,
  mesh: GarmentMesh,
  plan: PlanFile | null,
  distances: Float32Array | 'none' | null,
): Paint {
  if (colour === 'distance' && distances !== null)
    return distances === 'none' ? neutralPaint(mesh) : scalePaint(distances, ranges.distance);
  switch (colour) {
    case 'material':
      return { kind: 'material' };
    case 'level': {
      const levels = Array.from(
        { length: countFaces(mesh.faces) },
        (_, index) => faceAt(mesh.faces, index).level,
      );
      return facePaint(levels, LEVEL_COLOURS);
    }
    case 'pattern':
      if (!plan) return { kind: 'material' };
      return facePaint(facePatterns(mesh.faces, mesh.parents, plan), PATTERN_COLOURS);
    default:
      return { kind: 'vertices', map: MAGNITUDE_MAP, high: ranges[colour] };
  }
}

/** The value that all but a fiftieth of the known ones do not exceed; 0 without any. */
export function upperEnd(values: Float32Array): number {
  const known = values.filter((value) => !Number.isNaN(value)).sort();
  return known[Math.floor(0.98 * (known.length - 1))] ?? 0;
}
