// Turns a mode's stiffness into seconds and joules: a material, where the body has a thickness of its own.
import type { Energy } from '../bindings/modal-module';

/** Soft rubber: what the closed bodies are said to be made of. */
export const RUBBER = { young_pa: 1e6, density_kg_per_m3: 1000 };

/** A mode as its list shows it. */
export interface ModeNumbers {
  /** Null where no thickness is known, or where it falls rather than swings. */
  hz: number | null;
  /** Frequency over that of the first mode that swings. */
  relative: number;
  /** The shape is not one of rest: along this mode it goes on falling. */
  falls: boolean;
}

/**
 * Numbers of modes from squared angular frequencies, under 1 Pa and 1 kg/m³ where it is a volume's: E / rho
 * times as large under Young's modulus E and density rho.
 */
export function modeNumbers(
  stiffness: readonly number[],
  energy: Energy,
  isOfRubber: boolean,
): ModeNumbers[] {
  const first = stiffness.find((square) => square > 0) ?? 1;
  const scale = energy === 'cloth' ? 1 : RUBBER.young_pa / RUBBER.density_kg_per_m3;
  const hasHz = energy === 'cloth' || (energy === 'volume' && isOfRubber);
  return stiffness.map((square) => ({
    hz: hasHz && square > 0 ? Math.sqrt(scale * square) / (2 * Math.PI) : null,
    relative: Math.sqrt(Math.max(0, square) / first),
    falls: square <= 0,
  }));
}

/** First root of cos x cosh x = 1: of a beam that nothing holds. */
const FREE_BEAM = 4.730041;

/**
 * The first frequency of a slender bar of rubber by beam theory [Hz]: x² / (2 pi l²) sqrt(E I / (rho A)), with
 * I / A = thickness² / 12.
 */
export function beamHz(length_m: number, thickness_m: number): number {
  const speed = Math.sqrt(RUBBER.young_pa / RUBBER.density_kg_per_m3);
  const ratio = FREE_BEAM / length_m;
  return ((ratio ** 2 / (2 * Math.PI)) * thickness_m * speed) / Math.sqrt(12);
}

/** E = (Young / 2) V strain², as the energy of the module has it [J]. */
export function energyOf(strain: number, restVolume_m3: number): number {
  return (RUBBER.young_pa / 2) * restVolume_m3 * strain ** 2;
}
