// The WebAssembly module as it was built.
import { builtCore, firstCore } from '../../build-steps/built-core';
import type { DeformModule } from '../../src/fabrics/bindings/deform-module';
import type { ModalModule } from '../../src/modes/bindings/modal-module';
import type { ConvergenceModule } from '../../src/motion/bindings/convergence-module';
import type { SweepModule } from '../../src/motion/bindings/sweep-module';
import type { RefinementModule } from '../../src/refinement/bindings/refinement-module';
import type { PleatModule } from '../../src/shared/bindings/pleat-module';

export type FirstModule = PleatModule & SweepModule;
export type BuiltModule = FirstModule &
  ConvergenceModule &
  DeformModule &
  RefinementModule &
  ModalModule;

export const loadModule = () => builtCore<BuiltModule>();

/** The module as a first visit has it. */
export const loadFirst = () => firstCore<FirstModule>();
