#include "core/fabric/membrane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/fabric/taut_springs.h"

namespace pleat {
namespace {

/// The stiffness that yarns add beyond the stiffening strain, where they stretch instead of
/// straightening, in shares of the stiffness before it.
constexpr double kStiffening = kTautFactor - 1;

/// The columns of F = dx/d(u, v) and the Green strain E = 1/2 (F^T F - I).
struct Deformation {
  Vec3 x_u, x_v;
  double e_uu, e_vv;
  double e_uv;  // 2 E12
};

/// Entries of a symmetric 2 x 2 tensor.
struct Tensor {
  double uu, vv, uv;
};

/// dS11/dE11, dS22/dE22, and dS11/dE22 = dS12/d(2 E12) = G [N/m].
struct Moduli {
  double warp, weft, shear;
};

Deformation deformation(const MembraneElement& element, const PositionsView& positions) {
  const auto& g = element.gradients;
  const Vec3 x0 = positions.col(element.vertices[0]);
  const Vec3 d1 = positions.col(element.vertices[1]) - x0;  // differences: gradients sum to zero
  const Vec3 d2 = positions.col(element.vertices[2]) - x0;
  const Vec3 x_u = g(1, 0) * d1 + g(2, 0) * d2;
  const Vec3 x_v = g(1, 1) * d1 + g(2, 1) * d2;
  return {x_u, x_v, 0.5 * (x_u.squaredNorm() - 1), 0.5 * (x_v.squaredNorm() - 1), x_u.dot(x_v)};
}

/// The Green strain at the stiffening strain e, (1 + e)^2 = 1 + 2 E; beyond all strains for the
/// linear law. The `knee` of the functions below.
double green_stiffening_strain(const MembraneLaw& law) {
  const double e = law.stiffening_strain;
  return e > 0 ? e + e * e / 2 : std::numeric_limits<double>::infinity();
}

double energy_density(const MembraneLaw& law, double knee, const Deformation& d) {
  const double past_u = std::max(0.0, d.e_uu - knee);
  const double past_v = std::max(0.0, d.e_vv - knee);
  return 0.5 * (law.stretch_warp * (d.e_uu * d.e_uu + kStiffening * past_u * past_u) +
                law.stretch_weft * (d.e_vv * d.e_vv + kStiffening * past_v * past_v) +
                law.shear * (2 * d.e_uu * d.e_vv + d.e_uv * d.e_uv));
}

/// Second Piola-Kirchhoff stress dW/dE [N/m].
Tensor stress(const MembraneLaw& law, double knee, const Deformation& d) {
  const double past_u = std::max(0.0, d.e_uu - knee);
  const double past_v = std::max(0.0, d.e_vv - knee);
  return {law.stretch_warp * (d.e_uu + kStiffening * past_u) + law.shear * d.e_vv,
          law.stretch_weft * (d.e_vv + kStiffening * past_v) + law.shear * d.e_uu,
          law.shear * d.e_uv};
}

Moduli moduli(const MembraneLaw& law, double knee, const Deformation& d) {
  return {law.stretch_warp * (d.e_uu > knee ? 1 + kStiffening : 1),
          law.stretch_weft * (d.e_vv > knee ? 1 + kStiffening : 1), law.shear};
}

/// The tensor without its negative eigenvalue: (S - l2 I) l1 / (l1 - l2) when l1 > 0 > l2.
Tensor positive_part(const Tensor& S) {
  const double mean = (S.uu + S.vv) / 2;
  const double radius = std::hypot((S.uu - S.vv) / 2, S.uv);
  const double larger = mean + radius;
  const double smaller = mean - radius;
  if (smaller >= 0) return S;
  if (larger <= 0) return {0, 0, 0};
  const double scale = larger / (larger - smaller);
  return {scale * (S.uu - smaller), scale * (S.vv - smaller), scale * S.uv};
}

/// Second derivative of the energy. With the gradients (a, b) of vertex i and (c, d) of vertex j,
/// strains change by
///
///     dE11 = a x_u.dx_i,   dE22 = b x_v.dx_i,   2 dE12 = (a x_v + b x_u).dx_i,
///
/// so that block ij of the second derivative is, stress S and moduli C11, C22, G,
///
///     A [ (a c S11 + b d S22 + (a d + b c) S12) I + (C11 a c + G b d) x_u x_u^T
///         + (C22 b d + G a c) x_v x_v^T + G (a d + b c) (x_u x_v^T + x_v x_u^T) ].
///
/// C12 and the shear modulus are both G; that makes each block symmetric.
Mat9 second_derivative(const MembraneElement& element, const Deformation& at, const Moduli& C,
                       const Tensor& S) {
  const Mat3 uu = at.x_u * at.x_u.transpose();
  const Mat3 vv = at.x_v * at.x_v.transpose();
  const Mat3 half = at.x_u * at.x_v.transpose();
  const Mat3 uv = half + half.transpose();
  const auto& g = element.gradients;
  Mat9 K;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double ac = element.area * g(i, 0) * g(j, 0);
      const double bd = element.area * g(i, 1) * g(j, 1);
      const double mixed = element.area * (g(i, 0) * g(j, 1) + g(i, 1) * g(j, 0));
      Mat3 block = (C.warp * ac + C.shear * bd) * uu + (C.weft * bd + C.shear * ac) * vv +
                   C.shear * mixed * uv;
      block.diagonal().array() += ac * S.uu + bd * S.vv + mixed * S.uv;
      K.block<3, 3>(3 * i, 3 * j) = block;
      if (i != j) K.block<3, 3>(3 * j, 3 * i) = block;
    }
  }
  return K;
}

}  // namespace

std::vector<MembraneElement> membrane_elements(const TriangleMesh& mesh) {
  PLEAT_CHECK(mesh.warp_directions.size() == mesh.triangles.size(),
              "each triangle has a warp direction");
  std::vector<MembraneElement> elements;
  elements.reserve(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const FaceId face(static_cast<std::int64_t>(f));
    MembraneElement element;
    element.vertices = mesh.triangles[f];
    element.area = rest_area(mesh, face);
    PLEAT_CHECK(element.area > 0, "each triangle has area at rest");
    const Eigen::Matrix2d rest = flat_corners(mesh, face).rightCols<2>();
    element.gradients.bottomRows<2>() = rest.inverse();
    element.gradients.row(0) = -element.gradients.bottomRows<2>().colwise().sum();
    elements.push_back(element);
  }
  return elements;
}

MembraneLaw membrane_law(const FabricConstants& fabric) {
  if (fabric.shear * fabric.shear > fabric.stretch_warp * fabric.stretch_weft) {
    throw InputError("/fabric", formatted("%s: expected a shear stiffness of at most sqrt(%g * %g) "
                                          "N/m, that of stretch, got %g N/m",
                                          fabric.name.c_str(), fabric.stretch_warp,
                                          fabric.stretch_weft, fabric.shear));
  }
  return {fabric.stretch_warp, fabric.stretch_weft, fabric.shear, 0};
}

double membrane_energy(const Membrane& membrane, const PositionsView& positions) {
  const double knee = green_stiffening_strain(membrane.law);
  double energy = 0;
  for (const MembraneElement& element : membrane.elements)
    energy += element.area * energy_density(membrane.law, knee, deformation(element, positions));
  return energy;
}

void add_membrane_forces(const Membrane& membrane, const PositionsView& positions,
                         PositionsRef forces) {
  const double knee = green_stiffening_strain(membrane.law);
  for (const MembraneElement& element : membrane.elements) {
    const Deformation d = deformation(element, positions);
    const Tensor S = stress(membrane.law, knee, d);
    const Vec3 pull_u = element.area * (S.uu * d.x_u + S.uv * d.x_v);  // columns of A F S
    const Vec3 pull_v = element.area * (S.uv * d.x_u + S.vv * d.x_v);
    const auto& g = element.gradients;
    const Vec3 on_1 = g(1, 0) * pull_u + g(1, 1) * pull_v;
    const Vec3 on_2 = g(2, 0) * pull_u + g(2, 1) * pull_v;
    forces.col(element.vertices[0]) += on_1 + on_2;
    forces.col(element.vertices[1]) -= on_1;
    forces.col(element.vertices[2]) -= on_2;
  }
}

Mat9 membrane_stiffness(const MembraneLaw& law, const MembraneElement& element,
                        const PositionsView& positions, ElementHessian hessian) {
  const double knee = green_stiffening_strain(law);
  const Deformation d = deformation(element, positions);
  const Tensor S = stress(law, knee, d);
  return second_derivative(element, d, moduli(law, knee, d),
                           hessian == ElementHessian::projected ? positive_part(S) : S);
}

Mat9 membrane_viscosity(const MembraneLaw& law, const MembraneElement& element,
                        const PositionsView& positions) {
  return second_derivative(element, deformation(element, positions),
                           {law.stretch_warp, law.stretch_weft, law.shear}, {0, 0, 0});
}

}  // namespace pleat
