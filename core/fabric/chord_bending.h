#pragma once

#include <cstdint>
#include <span>

#include "core/base/ids.h"
#include "core/base/vec.h"
#include "core/fabric/element_hessian.h"

namespace pleat {

enum class ChordLaw : std::uint8_t {
  arc,     ///< E = 1/2 B w L kappa^2 with kappa = 2 acos(c / 2L) / L, c the chord
  linear,  ///< f = k (c - 2L)
};

/// Bending of three consecutive vertices of a mesh line by the chord c between the outer two, in
/// compression only: from c = 2L on, the vertices in line, there is neither energy nor force. The
/// force of `arc` jumps there, from a push of 2 B w / L^2.
struct ChordBend {
  VertexId a, b;         ///< the outer two
  double length = 0;     ///< L, the mean of both arms at rest [m], positive
  double stiffness = 0;  ///< arc: B w, rigidity times width [N m^2]; linear: k [N/m]
  ChordLaw law = ChordLaw::arc;
};

/// The curvature at which the linear law stores what the fabric does [1/m]: that of a drape's
/// folds. Folds of half of it then cost a quarter of what they should.
constexpr double kLinearLawCurvature = 30;

/// arm       L [m], positive
/// rigidity  B times the tributary width w [N m^2], not negative
///
/// Source: arc: Choi & Ko, Stable but responsive cloth, ACM Transactions on Graphics 21(3), 2002;
/// both: docs/methods/springs.md.
ChordBend chord_bend(VertexId a, VertexId b, double arm, double rigidity, ChordLaw law);

/// Energy stored [J].
double chord_energy(std::span<const ChordBend> bends, const Eigen::Ref<const Positions>& positions);

/// Adds the forces on vertices [N]; two vertices in one place have no direction to be pushed in.
void add_chord_forces(std::span<const ChordBend> bends,
                      const Eigen::Ref<const Positions>& positions, Eigen::Ref<Positions> forces);

/// -d(force on a)/d(x_a) [N/m]. Exact it is indefinite, as a compressed spring is, and grows beyond
/// bounds as the chord vanishes; at no length it is zero.
Mat3 chord_stiffness(const ChordBend& bend, const Eigen::Ref<const Positions>& positions,
                     ElementHessian hessian);

}  // namespace pleat
