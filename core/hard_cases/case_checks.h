#pragma once

#include "core/hard_cases/hard_case.h"

namespace pleat {

/// Signs of finite nonsense (RunWatch): none.
CaseCheck no_nonsense();

/// Vertices faster than falling, pulling and what was stored at the start explain (RunWatch):
/// none.
CaseCheck speeds_explained();

/// Distance of every vertex from the origin [m].
CaseCheck stays_within(double distance);

/// Largest |l/L - 1| of mesh edges, at any time.
CaseCheck strain_at_most(double strain);

/// Largest |l/L - 1| of mesh edges, at the end.
CaseCheck end_strain_at_most(double strain);

/// How far any vertex gets from where it was `window` [s] before the end, at any time since [m].
CaseCheck rests(double window, double distance);

/// How much the sum of all energies rises in the second half of the run above the least that it had
/// there before, in shares of how far it ever fell. Nothing may do work on the cloth.
CaseCheck energy_grows_at_most(double share);

/// Distance from the mirror image about the plane x = 0, in shares of the rest diagonal. Rest
/// positions are symmetric.
CaseCheck stays_symmetric(double share);

/// Change of the momentum in shares of the mass times the fastest vertex's speed at the start.
/// No outer forces.
CaseCheck momentum_kept(double share);

/// Change of the angular momentum about the centre of mass in shares of its first value. No outer
/// forces.
CaseCheck angular_momentum_kept(double share);

/// Cloth that may tear has torn by the end: no run left it whole.
CaseCheck tears();

/// Change of the mass, in shares of its first value.
CaseCheck mass_kept(double share);

/// Edges of the cloth that go through its faces after any step (SelfCrossings): none.
CaseCheck no_crossings();

/// How deep a vertex is inside of a solid at the end [m].
CaseCheck outside_solids(double depth);

/// Largest change of any vertex's velocity from one step to the next, at any time [m/s]. Where the
/// number of vertices changes, of those that both meshes share.
CaseCheck velocity_jumps_at_most(double speed);

/// Largest distance of a vertex of the variants from the same one of the first, in shares of the
/// rest diagonal; each variant about its own first vertex's place and at its own size.
VariantCheck variants_agree(double share);

/// Least height of the first variant's vertices below its highest, its sag, against the others', in
/// shares of the first.
VariantCheck sags_agree(double share);

}  // namespace pleat
