#include "core/contact/body_start.h"

#include "core/base/formatted.h"
#include "core/contact/body_depth.h"
#include "core/contact/closest_points.h"
#include "core/contact/near_pairs.h"
#include "core/contact/surface_crossings.h"

namespace pleat {
namespace {

/// Share of the gap at rest below which sides count as one: which side one is on is not to be told.
constexpr double kTouching = 1e-3;

std::string place_of(const Vec3& x) { return formatted("(%.4g, %.4g, %.4g) m", x[0], x[1], x[2]); }

std::string inside(const SelfContact& surfaces, const PositionsView& positions, double time) {
  const Penetration found = BodyDepth(surfaces.bodies).at(positions, time);
  if (found.n_inside == 0) return "";
  const Vec3 place = positions.col(found.deepest);
  return formatted("%d vertices inside of one, the deepest vertex %d by %.3g mm at %s",
                   found.n_inside, found.deepest.value, 1e3 * found.depth, place_of(place).c_str());
}

std::string through(const SelfContact& surfaces, const PositionsView& positions,
                    const BodySurface& body, const Positions& places) {
  auto found = crossings(positions, surfaces.faces, places, body.triangles);
  const auto others = crossings(places, body.triangles, positions, surfaces.faces);
  found.insert(found.end(), others.begin(), others.end());
  if (found.empty()) return "";
  return formatted("%d crossings with the surface of one, the first at %s",
                   static_cast<int>(found.size()), place_of(found.front().place).c_str());
}

std::string touching(const SelfContact& surfaces, const PositionsView& positions,
                     const BodySurface& body, const Positions& places) {
  const auto n = static_cast<std::int32_t>(positions.cols());
  std::vector<BoxGroup> groups(static_cast<std::size_t>(n), BoxGroup::loose_cloth);
  groups.resize(groups.size() + static_cast<std::size_t>(places.cols()), BoxGroup::body);
  std::vector<Triangle> faces = surfaces.faces;
  for (const auto& [a, b, c] : body.triangles)
    faces.push_back({VertexId(n + a), VertexId(n + b), VertexId(n + c)});
  Corridors corridors;
  corridors.begins.resize(3, n + places.cols());
  corridors.begins << positions, places;
  corridors.ends = corridors.begins;
  corridors.rooms = Eigen::VectorXd::Zero(corridors.begins.cols());
  const double least = kTouching * surfaces.body_gap;
  NearPairs near(std::move(faces), surfaces.hanging, std::move(groups));
  if (!near.detect(corridors, least)) return "cloth that lies all over the surface of one";
  for (const SurfacePair& pair : near.pairs()) {
    const auto differences = pair_differences(pair, corridors.begins);
    if (closest_points(differences, pair.n_differences()).difference.norm() >= least) continue;
    const VertexId first = pair.vertices[0] < n ? pair.vertices[0] : pair.vertices[3];
    const Vec3 place = corridors.begins.col(first);
    return formatted("cloth that touches the surface of one, near vertex %d at %s", first.value,
                     place_of(place).c_str());
  }
  return "";
}

}  // namespace

std::string cloth_in_bodies(const SelfContact& surfaces, const PositionsView& positions,
                            double time) {
  if (surfaces.bodies.empty()) return "";
  if (std::string found = inside(surfaces, positions, time); !found.empty()) return found;
  for (const BodySurface& body : surfaces.bodies) {
    const Pose pose = body.motion.pose(time);
    const Positions places = (pose.rotation * body.places).colwise() + pose.translation;
    if (std::string found = through(surfaces, positions, body, places); !found.empty())
      return found;
    if (std::string found = touching(surfaces, positions, body, places); !found.empty())
      return found;
  }
  return "";
}

}  // namespace pleat
