#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/fabric/chord_bending.h"
#include "core/fabric/fabric.h"
#include "core/mesh/quad_mesh.h"

namespace pleat {

/// `bend` joins every second vertex of a line.
enum class SpringKind : std::uint8_t { warp, weft, shear, bend, other };

/// True for what keeps cloth from being longer along its threads, and for springs of no kind.
constexpr bool is_structural(SpringKind kind) {
  return kind != SpringKind::shear && kind != SpringKind::bend;
}

/// Hooke spring with a damper beside it. Force on a: -k (l - L) u - c ((v_a - v_b).u) u, u from b
/// to a. At zero length it pulls nowhere.
struct Spring {
  VertexId a, b;
  double stiffness = 0;    ///< k [N/m], not negative
  double rest_length = 0;  ///< L [m], not negative
  double damping = 0;      ///< c [N s/m], not negative
  SpringKind kind = SpringKind::other;
};

/// Quadratic bending of three consecutive vertices of a mesh line: E = 1/2 s |w0 x0 + w1 x1 + w2
/// x2|^2, the sum being the curvature vector [1/m]. Its Hessian is constant.
struct BendElement {
  std::array<VertexId, 3> vertices;  ///< consecutive vertices of a line
  std::array<double, 3> weights;     ///< second difference [1/m^2]; they sum to zero
  double stiffness = 0;              ///< s = B * width * mean arm [N m^3]
};

/// How three consecutive vertices of a mesh line resist bending.
enum class BendingLaw {
  none,
  quadratic,  ///< BendElement
  linear,     ///< ChordBend
};

struct SpringLattice {
  std::vector<Spring> springs;         ///< warp, then weft, then shear
  std::vector<BendElement> bends;      ///< elements of the quadratic law
  std::vector<ChordBend> chord_bends;  ///< elements of the linear law
  Eigen::VectorXd masses;  ///< a quarter of each face per corner, none where one hangs [kg]
};

/// Angular frequency at which a fabric's damping ratio holds: a visible swing of 5 Hz [rad/s].
constexpr double kReferenceFrequency = 31.41592653589793;

/// Springs along warp and weft and on both diagonals of each active face, bending along warp and
/// weft lines, with constants such that the sheet's stiffness does not depend on the mesh: diagonal
/// k = G (a^2 + b^2) / (2 a b); warp edge k = (K_u - G a^2/b^2) b'/a; weft edge k = (K_v - G
/// b^2/a^2) a'/b with cell a (warp) x b (weft) and b', a' half of the adjacent cells' widths
/// summed. Damping c = tau k with tau = 2 zeta / kReferenceFrequency. Each face brings its own
/// share, so that on a graded mesh too an affine stretch is stretched everywhere alike.
///
/// stiffness_exponent  alpha in [0, 1]: springs of faces of level l are 2^(alpha l) times as stiff.
///                     0 for a sheet that is the same on every mesh.
///
/// Throws InputError naming the fabric when a cell's aspect would make an edge constant negative.
/// Source: docs/methods/springs.md (derivation).
SpringLattice spring_lattice(const QuadMesh& mesh, const FabricConstants& fabric,
                             BendingLaw law = BendingLaw::quadratic, double stiffness_exponent = 0);

/// The bending elements of the quadratic law for the same rigidity along both threads [N m].
std::vector<BendElement> line_bends(const QuadMesh& mesh, double rigidity);

}  // namespace pleat
