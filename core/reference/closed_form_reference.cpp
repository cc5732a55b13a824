#include "core/reference/closed_form_reference.h"

#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/reference/closed_forms.h"
#include "core/run/scene_model.h"
#include "core/scene/cloth/particle_cloth.h"

namespace pleat {
namespace {

constexpr double kAngleTolerance = 1e-9;  // cosine or sine

struct RestShape {
  std::string description;
  Positions positions;  // [m]
  Stretch stretch;
};

[[noreturn]] void refuse(const char* where, const std::string& expected) {
  throw InputError(where, "expected " + expected + " for comparison with a closed form");
}

Vec3 down(const Scene& scene) { return scene.gravity.normalized(); }

void check_surroundings(const Scene& scene, const ClothModel& model) {
  if (scene.gravity.isZero()) refuse("/world/gravity_m_per_s2", "a weight");
  if (scene.air) refuse("/world/air", "no air");
  if (!scene.colliders.empty() || !scene.surface_solids.empty())
    refuse("/world/colliders", "no solids");
  for (const Pin& pin : model.pins)
    if (pin.motion.kind != Motion::Kind::hold) refuse("/pins", "pins that hold still");
}

/// Number of whole rows that are held, from the upper edge on.
int n_held_rows(const SheetShape& shape, const QuadMesh& mesh, const std::vector<Pin>& pins,
                int level) {
  const int n_rows = shape.rows << level;
  const int n_in_row = (shape.columns << level) + 1;
  std::vector<int> n_held(static_cast<std::size_t>(n_rows) + 1, 0);
  for (const Pin& pin : pins) {
    const double row = mesh.rest_coordinates().col(pin.vertex).x() / shape.height * n_rows;
    ++n_held[static_cast<std::size_t>(std::lround(row))];
  }
  int n = 0;
  while (n <= n_rows && n_held[static_cast<std::size_t>(n)] == n_in_row) ++n;
  const bool others_are_free = static_cast<int>(pins.size()) == n * n_in_row;
  if (n == 0 || n > n_rows || !others_are_free)
    refuse("/pins", "whole rows of vertices held from the upper edge on, and free ones below");
  return n;
}

/// K along warp [N/m]. Edges have what the diagonals leave of it, also when these are left out.
double hanging_stiffness(const Scene& scene, const SheetShape& shape) {
  const double shear = scene.fabric.shear;
  if (scene.model.stiffening_strain > 0)
    refuse("/model/stiffening_strain", "one stiffness throughout");
  if (scene.model.elasticity == Elasticity::membrane) {
    if (shear > 0)
      refuse("/fabric/shear_n_per_m", "no stiffness against shear, which would draw the sides in,");
    return scene.fabric.stretch_warp;
  }
  if (scene.model.shear && shear > 0)
    refuse("/model/shear", "no springs against shear, which would draw the sides in,");
  const double aspect = shape.height / shape.rows * shape.columns / shape.width;
  const double stiffness = scene.fabric.stretch_warp - shear * aspect * aspect;
  if (stiffness <= 0) refuse("/fabric/stretch_warp_n_per_m", "a stiffness along warp");
  return stiffness;
}

RestShape hanging_sheet(const Scene& scene, const SheetShape& shape, const QuadMesh& mesh,
                        double held) {
  HangingStrip strip;
  strip.length = shape.height - held;
  strip.weight = scene.fabric.areal_density * scene.gravity.norm();
  strip.stiffness = hanging_stiffness(scene, shape);
  strip.law =
      scene.model.elasticity == Elasticity::membrane ? StretchLaw::green : StretchLaw::hooke;
  RestShape rest{"hanging strip in closed form", Positions(3, mesh.n_vertices()), {}};
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const double u = mesh.rest_coordinates()(0, i);
    const double depth =
        u <= held ? u : held + hanging_depth(strip, std::min(u - held, strip.length));
    rest.positions.col(i) =
        shape.origin + mesh.rest_coordinates()(1, i) * shape.weft_direction + depth * down(scene);
  }
  rest.stretch = stretch(gauge_edges(mesh), rest.positions);
  return rest;
}

RestShape cantilever_sheet(const Scene& scene, const SheetShape& shape, const QuadMesh& mesh,
                           double held, double row) {
  const bool is_fitted = scene.model.bending == BendingModel::fitted;
  if (!is_fitted && scene.model.bending != BendingModel::quadratic)
    refuse("/model/bending", "quadratic or fitted bending");
  if (scene.fabric.bend_warp == 0) refuse("/fabric/bend_warp_n_m", "a rigidity");
  const double clamp = is_fitted ? held : held - row / 2;
  Cantilever strip;
  strip.length = shape.height - clamp;
  strip.weight = scene.fabric.areal_density * scene.gravity.norm();
  strip.rigidity = scene.fabric.bend_warp;
  if (strip.load() > kMaxCantileverLoad)
    refuse("/fabric/bend_warp_n_m", "a rigidity that holds the strip up");
  std::vector<double> arc_lengths;
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const double from_clamp = mesh.rest_coordinates()(0, i) - clamp;
    arc_lengths.push_back(std::clamp(from_clamp, 0.0, strip.length));
  }
  const Eigen::Matrix2Xd places = heavy_elastica(strip, arc_lengths);
  RestShape rest{"heavy elastica, to 1e-10 of its length", mesh.rest_positions(), {}};
  for (int i = 0; i < mesh.n_vertices(); ++i) {
    const double u = mesh.rest_coordinates()(0, i);
    if (u <= held) continue;
    rest.positions.col(i) = shape.origin + mesh.rest_coordinates()(1, i) * shape.weft_direction +
                            (clamp + places(0, i)) * shape.warp_direction +
                            places(1, i) * down(scene);
  }
  return rest;
}

RestShape sheet_at_rest(const Scene& scene, const SheetShape& shape, const QuadMesh& mesh,
                        const ClothModel& model) {
  const int n_held = n_held_rows(shape, mesh, model.pins, scene.level);
  const double row = shape.height / (shape.rows << scene.level);
  const double held = (n_held - 1) * row;
  if (std::abs(shape.weft_direction.dot(down(scene))) > kAngleTolerance)
    refuse("/cloth/sheet/weft_direction", "a horizontal direction");
  const bool points_down = shape.warp_direction.dot(down(scene)) > 0 &&
                           shape.warp_direction.cross(down(scene)).norm() <= kAngleTolerance;
  if (n_held == 1 || points_down) return hanging_sheet(scene, shape, mesh, held);
  if (std::abs(shape.warp_direction.dot(down(scene))) > kAngleTolerance)
    refuse("/cloth/sheet/warp_direction", "a direction that is horizontal or straight down");
  return cantilever_sheet(scene, shape, mesh, held, row);
}

/// The springs and particles of one chain in their order.
struct Chain {
  std::vector<const Spring*> springs;
  std::vector<VertexId> particles;  // one more
};

/// The chain from the end `start` on; empty unless it passes every particle.
Chain chain_from(VertexId start, const ParticleCloth& cloth) {
  const auto n_particles = static_cast<std::size_t>(cloth.positions.cols());
  std::vector<std::array<const Spring*, 2>> ends_at(n_particles, {nullptr, nullptr});
  for (const Spring& spring : cloth.springs) {
    for (const VertexId end : {spring.a, spring.b}) {
      auto& [first, second] = ends_at[end];
      if (second != nullptr) return {};
      (first == nullptr ? first : second) = &spring;
    }
  }
  if (ends_at[start][1] != nullptr) return {};
  Chain chain{{}, {start}};
  for (const Spring* spring = ends_at[start][0]; spring != nullptr;) {
    chain.particles.push_back(spring->a == chain.particles.back() ? spring->b : spring->a);
    chain.springs.push_back(spring);
    const auto& [first, second] = ends_at[chain.particles.back()];
    spring = first == spring ? second : first;
  }
  return chain.particles.size() == n_particles ? chain : Chain{};
}

RestShape particles_at_rest(const Scene& scene, const ParticleCloth& cloth,
                            const ClothModel& model) {
  if (!model.bends.empty()) refuse("/cloth/particles/bends", "no bending");
  if (model.pins.empty() || model.pins.size() > 2)
    refuse("/pins", "one or both ends of a chain held");
  const Chain chain = chain_from(model.pins.front().vertex, cloth);
  if (chain.springs.empty())
    refuse("/cloth/particles/springs", "springs in one chain from a held particle on");
  const bool has_far_support = model.pins.size() == 2;
  if (has_far_support && model.pins.back().vertex != chain.particles.back())
    refuse("/pins", "one or both ends of a chain held");
  std::vector<ChainLink> links;
  for (std::size_t i = 0; i < chain.springs.size(); ++i) {
    if (chain.springs[i]->stiffness <= 0)
      refuse("/cloth/particles/springs", "springs that all have a stiffness");
    links.push_back({chain.springs[i]->rest_length, chain.springs[i]->stiffness,
                     model.masses[chain.particles[i + 1]] * scene.gravity.norm()});
  }

  RestShape rest{"chain of " + std::to_string(links.size()) + " springs in closed form",
                 Positions(3, model.n_vertices()),
                 {}};
  const Vec3 start = model.pins.front().position(0);
  const Vec3 apart = model.pins.back().position(0) - start;
  const Vec3 level_part = apart - apart.dot(down(scene)) * down(scene);
  const double span = level_part.norm();
  Eigen::Matrix2Xd nodes = Eigen::Matrix2Xd::Zero(2, model.n_vertices());
  if (!has_far_support) {
    nodes.row(1) = hanging_chain(links);
  } else {
    if (links.size() < 2) refuse("/cloth/particles", "a free particle");
    if (span <= kAngleTolerance * apart.norm())
      refuse("/pins", "supports that are not above each other");
    const auto solved = chain_between_supports(links, {span, apart.dot(down(scene))});
    if (!solved) refuse("/cloth/particles", "a chain whose equations can be solved to 1e-12");
    nodes = *solved;
  }
  const Vec3 sideways = span > 0 ? Vec3(level_part / span) : Vec3::Zero();
  for (std::size_t i = 0; i < chain.particles.size(); ++i) {
    const Eigen::Vector2d node = nodes.col(static_cast<Eigen::Index>(i));
    rest.positions.col(chain.particles[i]) = start + node.x() * sideways + node.y() * down(scene);
  }
  rest.stretch = stretch(gauge_edges(cloth.springs), rest.positions);
  return rest;
}

}  // namespace

Reference closed_form_reference(const Scene& scene, std::span<const double> times) {
  const auto* sheet = scene.cloth.as<SheetCloth>();
  const auto* particles = scene.cloth.as<ParticleCloth>();
  if (sheet == nullptr && particles == nullptr) refuse("/cloth", "a sheet or particles");
  const RestCloth cloth = rest_cloth(scene, scene.level);
  const ClothModel model = scene_model(scene, cloth);
  check_surroundings(scene, model);
  const RestShape rest = sheet != nullptr ? sheet_at_rest(scene, sheet->shape, *cloth.quads, model)
                                          : particles_at_rest(scene, *particles, model);
  Scene content = scene;
  content.method = MethodOptions{};  // the shape at rest does not depend on it
  Reference reference;
  reference.label = {reference_id("closed-form", content, times), rest.description, true};
  for (const double time : times) reference.samples.push_back({time, rest.positions, rest.stretch});
  return reference;
}

}  // namespace pleat
