#include "core/reference/chain_reference.h"

#include <cmath>

#include "core/base/check.h"
#include "core/reference/rigid_chain.h"
#include "core/scene/rest_cloth.h"

namespace pleat {
namespace {

constexpr double kRightAngleTolerance = 1e-9;  // cosine
constexpr int kFirstStepsPerLink = 100;        // steps a second; the fastest swing grows with links
constexpr int kMaxDoublings = 6;

const SheetShape& swinging_sheet(const Scene& scene) {
  const auto refuse = [](const char* where, const char* expected) {
    throw InputError(where,
                     std::string("expected ") + expected + " for comparison with a rigid chain");
  };
  const auto* cloth = scene.cloth.as<SheetCloth>();
  if (cloth == nullptr) refuse("/cloth", "a sheet");
  if (cloth->initial_velocity != Vec3::Zero()) refuse("/cloth/sheet", "a sheet released at rest");
  if (scene.air) refuse("/world/air", "no air");
  if (!scene.colliders.empty() || !scene.surface_solids.empty())
    refuse("/world/colliders", "no solids");
  const auto is_upper_edge = [](const PinRule& rule) {
    const auto* part = std::get_if<std::string>(&rule.where);
    return part != nullptr && *part == "upper_edge" && rule.motion.kind == Motion::Kind::hold;
  };
  if (scene.pins.size() != 1 || !is_upper_edge(scene.pins.front()))
    refuse("/pins", "the whole upper edge held and nothing else");
  if (std::abs(cloth->shape.weft_direction.dot(scene.gravity)) >
      kRightAngleTolerance * scene.gravity.norm())
    refuse("/cloth/sheet/weft_direction", "a horizontal direction");
  return cloth->shape;
}

/// The row of the sheet that each vertex lies in, counted from the pinned edge.
std::vector<int> vertex_rows(const QuadMesh& mesh, double spacing) {
  std::vector<int> rows;
  for (Eigen::Index i = 0; i < mesh.rest_coordinates().cols(); ++i)
    rows.push_back(static_cast<int>(std::lround(mesh.rest_coordinates()(0, i) / spacing)));
  return rows;
}

RigidChain chain_of_rows(const Scene& scene, const QuadMesh& mesh, const std::vector<int>& rows,
                         double spacing, int n_links) {
  std::vector<double> masses(static_cast<std::size_t>(n_links), 0.0);
  const Eigen::VectorXd areas = mesh.vertex_areas();
  for (Eigen::Index i = 0; i < areas.size(); ++i)
    if (const int row = rows[static_cast<std::size_t>(i)]; row > 0)
      masses[static_cast<std::size_t>(row - 1)] += scene.fabric.areal_density * areas[i];
  return RigidChain(std::vector<double>(static_cast<std::size_t>(n_links), spacing),
                    std::move(masses), scene.gravity.norm());
}

std::vector<Eigen::Matrix2Xd> nodes_at(RigidChain chain, std::span<const double> times,
                                       int steps_per_second) {
  std::vector<Eigen::Matrix2Xd> nodes;
  double time = 0;
  for (const double next : times) {
    if (next > time)
      chain.advance(next - time, static_cast<int>(std::ceil((next - time) * steps_per_second)));
    time = next;
    nodes.push_back(chain.positions());
  }
  return nodes;
}

double largest_difference(const std::vector<Eigen::Matrix2Xd>& a,
                          const std::vector<Eigen::Matrix2Xd>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).colwise().norm().maxCoeff());
  return largest;
}

}  // namespace

Reference chain_reference(const Scene& scene, std::span<const double> times) {
  const SheetShape& shape = swinging_sheet(scene);
  const QuadMesh mesh = *rest_cloth(scene, scene.level).quads;
  const int n_links = shape.rows << scene.level;
  const double spacing = shape.height / n_links;
  const std::vector<int> rows = vertex_rows(mesh, spacing);

  // The plane of motion: down, and sideways where warp points.
  const double weight = scene.gravity.norm();
  const Vec3 down = weight > 0 ? Vec3(scene.gravity / weight) : Vec3(shape.warp_direction);
  const Vec3 level_part = shape.warp_direction - shape.warp_direction.dot(down) * down;
  const Vec3 sideways =
      level_part.norm() > kRightAngleTolerance ? Vec3(level_part.normalized()) : Vec3(Vec3::Zero());
  const double angle =
      std::atan2(shape.warp_direction.dot(sideways), shape.warp_direction.dot(down));
  RigidChain chain = chain_of_rows(scene, mesh, rows, spacing, n_links);
  chain.place(Eigen::VectorXd::Constant(n_links, angle), Eigen::VectorXd::Zero(n_links));

  int steps_per_second = kFirstStepsPerLink * n_links;
  std::vector<Eigen::Matrix2Xd> nodes = nodes_at(chain, times, steps_per_second);
  bool converged = false;
  for (int doubling = 0; doubling < kMaxDoublings && !converged; ++doubling) {
    steps_per_second *= 2;
    std::vector<Eigen::Matrix2Xd> finer = nodes_at(chain, times, steps_per_second);
    converged = largest_difference(nodes, finer) <= kChainTolerance;
    nodes = std::move(finer);
  }

  Scene content = scene;
  content.method = MethodOptions{};  // the chain does not depend on it
  Reference reference;
  reference.label = {reference_id("chain", content, times),
                     "planar chain of " + std::to_string(n_links) + " rigid links, Runge-Kutta 4",
                     converged};
  for (std::size_t s = 0; s < times.size(); ++s) {
    Sample sample{times[s], Positions(3, mesh.n_vertices()), {}};
    for (int i = 0; i < mesh.n_vertices(); ++i) {
      const Eigen::Vector2d node = nodes[s].col(rows[static_cast<std::size_t>(i)]);
      sample.positions.col(i) = shape.origin +
                                mesh.rest_coordinates()(1, i) * shape.weft_direction +
                                node.x() * sideways - node.y() * down;
    }
    reference.samples.push_back(std::move(sample));
  }
  return reference;
}

}  // namespace pleat
