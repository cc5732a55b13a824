#pragma once

#include <span>

#include "core/base/ids.h"
#include "core/base/vec.h"
#include "core/fabric/element_hessian.h"

namespace pleat {

/// Bending of three consecutive vertices of a mesh line by the chord c between the outer two,
/// f = k (c - 2L), in compression only: from c = 2L on, the vertices in line, there is neither
/// energy nor force.
struct ChordBend {
  VertexId a, b;         ///< the outer two
  double length = 0;     ///< L, the mean of both arms at rest [m], positive
  double stiffness = 0;  ///< k [N/m]
};

/// The curvature at which chords store what the fabric does [1/m]: that of a drape's
/// folds. Folds of half of it then cost a quarter of what they should.
constexpr double kChordCurvature = 30;

/// arm       L [m], positive
/// rigidity  B times the tributary width w [N m^2], not negative
///
/// Source: docs/methods/springs.md.
ChordBend chord_bend(VertexId a, VertexId b, double arm, double rigidity);

/// Energy stored [J].
double chord_energy(std::span<const ChordBend> bends, const PositionsView& positions);

/// Adds the forces on vertices [N]; two vertices in one place have no direction to be pushed in.
void add_chord_forces(std::span<const ChordBend> bends, const PositionsView& positions,
                      PositionsRef forces);

/// -d(force on a)/d(x_a) [N/m]. Exact it is indefinite, as a compressed spring is, and grows beyond
/// bounds as the chord vanishes; at no length it is zero.
Mat3 chord_stiffness(const ChordBend& bend, const PositionsView& positions, ElementHessian hessian);

}  // namespace pleat
