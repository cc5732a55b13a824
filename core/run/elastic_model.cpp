#include "core/run/elastic_model.h"

#include <algorithm>
#include <cmath>

#include "core/fabric/fitted_bending.h"
#include "core/fabric/taut_springs.h"

namespace pleat {
namespace {

BendingLaw lattice_law(BendingModel bending) {
  switch (bending) {
    case BendingModel::quadratic:
      return BendingLaw::quadratic;
    case BendingModel::linear:
      return BendingLaw::linear;
    default:
      return BendingLaw::none;
  }
}

void drop(std::vector<Spring>& springs, SpringKind kind) {
  const auto is_of_kind = [kind](const Spring& spring) { return spring.kind == kind; };
  springs.erase(std::remove_if(springs.begin(), springs.end(), is_of_kind), springs.end());
}

void add_springs(ClothModel& model, const Scene& scene, const QuadMesh& quads) {
  SpringLattice lattice = spring_lattice(quads, scene.fabric, lattice_law(scene.model.bending),
                                         scene.model.stiffness_exponent);
  if (!scene.model.shear) drop(lattice.springs, SpringKind::shear);
  if (scene.model.stiffening_strain > 0)
    model.taut_springs = taut_springs(lattice.springs, scene.model.stiffening_strain);
  model.springs = std::move(lattice.springs);
  model.bends = std::move(lattice.bends);
  model.chord_bends = std::move(lattice.chord_bends);
  model.hanging = quads.hanging_vertices();
}

void add_given(ClothModel& model, const Scene& scene, const GivenSprings& given) {
  model.masses = given.masses;
  model.springs = given.springs;
  if (!scene.model.shear) drop(model.springs, SpringKind::shear);
  if (scene.model.bending == BendingModel::none)
    drop(model.springs, SpringKind::bend);
  else
    model.bends = given.bends;
}

void add_membrane(ClothModel& model, const Scene& scene, const TriangleMesh& mesh) {
  const FabricConstants& fabric = scene.fabric;
  model.membrane = {membrane_law(fabric), membrane_elements(mesh)};
  model.membrane.law.stiffening_strain = scene.model.stiffening_strain;
  model.membrane_relaxation = 2 * fabric.damping_ratio / kReferenceFrequency;
  const double mean_rigidity = std::sqrt(fabric.bend_warp * fabric.bend_weft);
  if (fabric.bend_warp == 0 && fabric.bend_weft == 0) return;
  if (scene.model.bending == BendingModel::fitted)
    model.fitted_bending = fitted_bending(mesh, fabric.bend_warp, fabric.bend_weft,
                                          scene.model.torsion * mean_rigidity);
  if (scene.model.bending == BendingModel::hinge) model.hinges = hinges(mesh, mean_rigidity);
}

/// A triangle mesh that comes without quads has a membrane.
void add_friction(ClothModel& model, const Scene& scene, const RestCloth& cloth) {
  if (cloth.given_springs)
    throw InputError(
        "/fabric",
        "expected no friction inside cloth of given springs, whose bending has no width");
  if (scene.model.elasticity != Elasticity::springs)
    throw InputError("/model/elasticity",
                     "expected springs for friction inside the fabric, got a membrane");
  if (scene.model.bending != BendingModel::quadratic)
    throw InputError("/model/bending",
                     "expected quadratic for friction inside the fabric, got another law");
  model.bend_friction.emplace(line_bends(*cloth.quads, 1), scene.fabric.bend_hysteresis,
                              cloth.quads->crossed_triangles(), cloth.mesh.rest_positions);
}

}  // namespace

void add_elasticity(ClothModel& model, const Scene& scene, const RestCloth& cloth) {
  if (scene.fabric.bend_hysteresis > 0) add_friction(model, scene, cloth);
  if (cloth.given_springs) return add_given(model, scene, *cloth.given_springs);
  // A quarter of each quad or a third of each triangle at every corner.
  model.masses = scene.fabric.areal_density * rest_areas(cloth);
  if (scene.model.elasticity == Elasticity::springs)
    add_springs(model, scene, *cloth.quads);
  else
    add_membrane(model, scene, cloth.mesh);
}

}  // namespace pleat
