// Modes and their energies in words.
import { digits, percent } from '../../shared/panels/quantity';
import type { Energy } from '../bindings/modal-module';
import { beamHz, type ModeNumbers } from '../state/material';
import { BAR_SIDES_M } from '../state/models';
import { type FoundModes, isSolid, type ModesState } from '../state/modes-state';

export const ENERGY_TITLES: Record<Energy, string> = {
  volume: 'Volume',
  surface: 'Surface',
  cloth: 'Fabric',
};

/** "3.05 Hz", or "1.7 × the first" where no thickness is known. */
export function frequencyText({ hz, relative, falls }: ModeNumbers): string {
  if (falls) return 'falls';
  if (hz !== null) return `${digits(hz)} Hz`;
  return `${digits(relative)} ×`;
}

function rigidText(rigid: number): string {
  if (rigid === 0) return 'Its held places leave it no rigid motion.';
  if (rigid === 6)
    return 'Its 6 rigid motions, 3 shifts and 3 turns, bend nothing: they are counted and left out of the list.';
  return `Its ${rigid} rigid motions, 3 shifts and 3 turns of each of its ${rigid / 6} parts, bend nothing: they are counted and left out of the list.`;
}

function frequencyNote(energy: Energy, isOfRubber: boolean, falls: number): string {
  if (energy === 'cloth') {
    const still = 'Frequencies are of the fabric’s own stiffness and weight about this shape.';
    return falls === 0
      ? still
      : `${still} Along ${falls} of them it goes on falling: it has not come to rest.`;
  }
  if (energy === 'surface')
    return 'A surface alone has no thickness and so no frequency in hertz: × compares with the first mode.';
  if (isOfRubber) return 'Frequencies are of soft rubber: Young’s modulus 1 MPa, 1000 kg/m³.';
  return 'The shell’s thickness is made up, so hertz would be too: × compares with the first mode.';
}

/** How near the bar's first mode is to what is known of bars. */
function beamNote({ modes, energy }: FoundModes, model: string): string {
  const hz = modes[0]?.hz;
  if (model !== 'bar' || energy !== 'volume' || !hz) return '';
  const [length, thickness] = BAR_SIDES_M;
  const beam = beamHz(length, thickness);
  return ` Beam theory has ${digits(beam)} Hz for the first: tetrahedra this coarse are ${percent(hz / beam - 1)} too high, finer ones less.`;
}

const SWELLING =
  'A mode moves every point straight, so that a large swing swells the body. Between keys it does not.';

/** Words on the list of modes. */
export function modesNote(found: FoundModes | null, state: ModesState): string {
  if (!found) return '';
  const { energy, rigid, modes, tets } = found;
  const falls = modes.filter((mode) => mode.falls).length;
  const volume =
    tets > 0 ? ` ${tets.toLocaleString('en').replaceAll(',', '\u202f')} tetrahedra carry it.` : '';
  const hertz = frequencyNote(energy, isSolid(state), falls);
  return `${rigidText(rigid)} ${hertz}${beamNote(found, state.model)}${volume} ${SWELLING}`;
}

const ENERGY_MEANINGS: Record<Energy, string> = {
  volume:
    'The inside resists as well: the softest modes bend and twist the body as a whole and leave its cross-section alone.',
  surface:
    'Only the skin resists, as if the body were hollow: among its softest modes are some that squash the cross-section, which a volume would keep.',
  cloth:
    'Threads, shear and bending of its own fabric resist, as in the other views; its corners stay held.',
};

const OPEN_MEANINGS: Record<Energy, string> = {
  ...ENERGY_MEANINGS,
  volume:
    'The surface is thickened, and the inside of that resists as well: the softest modes bend it and hardly stretch it.',
  surface:
    'The surface alone resists, by how the edges around each of its points stretch and turn against each other.',
};

/** Words for a class on what the chosen energy means. */
export function energyMeaning({ energy, compares, surface }: ModesState): string {
  if (surface && !surface.closed)
    return compares
      ? 'The same mode by number, of the thickened surface and of the surface alone.'
      : OPEN_MEANINGS[energy];
  if (compares)
    return 'The same mode by number, of the volume and of the surface alone. Compare the last ones of the list: without an inside the body gives way where it is hollow.';
  return ENERGY_MEANINGS[energy];
}

/** Volume, as a share of what it was: "swells by 1.2 %". */
export function volumeWords(ratio: number): string {
  const change = Math.abs(ratio - 1);
  if (change < 5e-4) return 'keeps its volume';
  return `${ratio > 1 ? 'swells' : 'shrinks'} by ${percent(change)}`;
}
