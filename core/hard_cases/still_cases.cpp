#include <cmath>

#include "core/deform/cloth_extent.h"
#include "core/deform/deform_solver.h"
#include "core/hard_cases/hard_case_table.h"
#include "core/mesh/sheet_pattern.h"
#include "core/modal/shown_modes.h"
#include "core/refinement/k_means.h"
#include "core/scene/deform/deform_scene.h"

namespace pleat {
namespace {

/// The shape of least energy of a deformation's file, found and no farther away than this from
/// where it lay, in extents of the cloth.
std::function<std::vector<CaseFinding>(const CaseFiles&)> shape_of(const std::string& file,
                                                                   double farthest) {
  return [file, farthest](const CaseFiles& files) -> std::vector<CaseFinding> {
    const DeformScene scene =
        read_deform_scene(files.files(file + ".json"), files.fabrics, files.files);
    DeformSolver solver(scene.mesh, scene.form, scene.weights());
    const HeldVertices held = held_vertices(scene);
    solver.hold(held.vertices);
    solver.restart(held.targets);
    const double before = solver.energy();
    const SolveReport report = solver.solve();
    const Positions moves = solver.positions() - scene.mesh.rest_positions;
    const double extent = cloth_extent(scene.mesh);
    return {{"left unsolved", report.ok() ? 0.0 : 1.0, 0, report.message},
            {"energy, of that before the first step", solver.energy() / before, 1},
            {"farthest move, of the extent", moves.colwise().norm().maxCoeff() / extent, farthest}};
  };
}

/// Two level sheets, one above the other, that nothing joins.
std::vector<CaseFinding> modes_of_two_parts(const CaseFiles&) {
  const TriangleMesh sheet = patterned_sheet({.columns = 6, .rows = 4}, SheetPattern::alternating);
  const Eigen::Index n = sheet.rest_positions.cols();
  Positions both(3, 2 * n);
  both << sheet.rest_positions, sheet.rest_positions.colwise() + Vec3(0, 0, 1);
  std::vector<Triangle> triangles = sheet.triangles;
  for (Triangle triangle : sheet.triangles) {
    for (VertexId& corner : triangle) corner = VertexId(corner.value + n);
    triangles.push_back(triangle);
  }
  constexpr int kModes = 4;
  const SurfaceModes modes = surface_modes(both, triangles, kModes);
  const double difference = std::abs(modes.stiffness[1] / modes.stiffness[0] - 1);
  return {{"rigid motions beside 6 for each part", std::abs(modes.n_rigid - 12.0), 0},
          {"difference of the parts' equal lowest modes", difference, 1e-6},
          {"residual of a mode", modes.residuals.maxCoeff(), 1e-8}};
}

std::vector<CaseFinding> kinds_of_alike(const CaseFiles&) {
  Random random(1);
  const PlanePoints alike = PlanePoints::Constant(2, 50, 0.3);
  constexpr int kKinds = 3;
  const Clusters clusters = k_means(alike, kKinds, 16, random);
  return {{"distance from the centres", clusters.within, 0}};
}

}  // namespace

std::vector<HardCase> still_cases() {
  return {
      {.name = "handle_at_half_a_turn",
       .breaks = "A sheet folded back onto itself by exactly 180 degrees has no side to bulge to.",
       .still = shape_of("handle_at_half_a_turn", 1.5)},
      {.name = "flung_handle",
       .breaks = "A handle pulled a hundred cloth sizes away.",
       .still = shape_of("flung_handle", 110)},
      {.name = "silk_recovery",
       .breaks = "Silk, whose weight of recovery is 98 %: stretch counts for next to nothing.",
       .still = shape_of("silk_recovery", 1)},
      {.name = "weight_without_bending",
       .breaks = "A fabric whose weight of bending is 0 leaves a matrix without its largest part.",
       .still = shape_of("weight_without_bending", 1)},
      {.name = "weight_without_recovery",
       .breaks = "One whose weight of recovery is 0 hangs on what holds it alone.",
       .still = shape_of("weight_without_recovery", 1)},
      {.name = "weight_without_stretch",
       .breaks = "One whose weight of stretch is 0 resists no pull.",
       .still = shape_of("weight_without_stretch", 1)},
      {.name = "weights_all_zero",
       .breaks = "Three weights of 0 leave nothing to minimise.",
       .is_bad_input = true,
       .still = shape_of("weights_all_zero", 1)},
      {.name = "modes_of_two_parts",
       .breaks =
           "A mesh in two parts has twelve rigid motions, and solvers that expect six take the "
           "others for modes or fail.",
       .still = modes_of_two_parts},
      {.name = "kinds_of_alike_features",
       .breaks = "k-means of vertices that all bend alike divides by empty clusters.",
       .is_bad_input = true,
       .still = kinds_of_alike},
  };
}

}  // namespace pleat
