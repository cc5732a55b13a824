#include "core/scene/vertex_place.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/files/nearest_word.h"
#include "core/scene/vertex_arrays.h"

namespace pleat {
namespace {

std::string listed(const std::vector<VertexGroup>& groups) {
  std::string text;
  for (const VertexGroup& group : groups) text += (text.empty() ? "\"" : ", \"") + group.name + '"';
  return cut(text);
}

std::string extent(const Positions& positions) {
  const Vec3 low = positions.rowwise().minCoeff();
  const Vec3 high = positions.rowwise().maxCoeff();
  return formatted("which lies from (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g) m", low.x(), low.y(),
                   low.z(), high.x(), high.y(), high.z());
}

/// A point that far off is a slip, such as millimetres for metres, and its nearest vertex chance.
void check_is_by(const JsonReader& reader, const Vec3& point, double radius,
                 const Positions& positions) {
  const double distance = (positions.colwise() - point).colwise().norm().minCoeff();
  const double size = box_diagonal(positions);
  if (distance <= std::max(radius, size)) return;
  throw InputError(
      reader.pointer(),
      formatted("expected a point no farther from the cloth than its size, %.4g m, got (%.4g, "
                "%.4g, %.4g) m, %.4g m from the nearest vertex",
                size, point.x(), point.y(), point.z(), distance));
}

std::vector<VertexId> read_near(const JsonReader& reader, const Positions& positions) {
  reader.allow_keys({"point_m", "radius_m"});
  double radius = usual_grasp(positions);
  if (const auto at = reader.find("radius_m")) radius = at->number(kNotNegative);
  const JsonReader at = reader.at("point_m");
  const Vec3 point = at.vec3();
  check_is_by(at, point, radius, positions);
  return vertices_near(positions, point, radius);
}

}  // namespace

const VertexGroup& read_group(const JsonReader& reader, const std::vector<VertexGroup>& groups) {
  const std::string& wanted = reader.text();
  std::vector<const char*> names;
  for (const VertexGroup& group : groups) {
    if (group.name == wanted) return group;
    names.push_back(group.name.c_str());
  }
  if (groups.empty()) reader.fail("listed vertices or a box, as the mesh has no named group");
  const std::string near(nearest_word(wanted, names));
  reader.fail(near.empty() ? "one of the groups " + listed(groups)
                           : "the group \"" + cut(near) + '"');
}

std::vector<VertexId> vertices_of(const std::vector<VertexGroup>& groups, const std::string& name) {
  const auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const VertexGroup& g) { return g.name == name; });
  return group == groups.end() ? std::vector<VertexId>{} : group->vertices;
}

PinBox read_box(const JsonReader& reader) {
  reader.allow_keys({"low_m", "high_m"});
  PinBox box{reader.at("low_m").vec3(), reader.at("high_m").vec3()};
  if ((box.low.array() > box.high.array()).any())
    reader.at("low_m").fail("a corner that is nowhere above high_m");
  return box;
}

std::vector<VertexId> vertices_in(const PinBox& box, const Positions& positions) {
  std::vector<VertexId> vertices;
  for (Eigen::Index v = 0; v < positions.cols(); ++v)
    if (box.holds(positions.col(v))) vertices.emplace_back(v);
  return vertices;
}

double usual_grasp(const Positions& positions) {
  return kUsualGrasp * (positions.rowwise().maxCoeff() - positions.rowwise().minCoeff()).maxCoeff();
}

std::vector<VertexId> vertices_near(const Positions& positions, const Vec3& point, double radius) {
  constexpr double kRounding = 1e-9;  // so that a circle through grid points takes all of them
  const Eigen::VectorXd distances = (positions.colwise() - point).colwise().norm();
  std::vector<VertexId> vertices;
  for (Eigen::Index v = 0; v < distances.size(); ++v)
    if (distances[v] <= (1 + kRounding) * radius) vertices.emplace_back(v);
  if (!vertices.empty()) return vertices;
  Eigen::Index nearest = 0;
  distances.minCoeff(&nearest);
  return {VertexId(nearest)};
}

std::vector<VertexId> read_place(const JsonReader& reader, const Positions& positions,
                                 const std::vector<VertexGroup>& groups) {
  switch (reader.only_one_of(kPlaceKeys)) {
    case 0: {
      std::vector<VertexId> vertices = read_vertex_list(reader.at("vertices"), positions.cols());
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      return vertices;
    }
    case 1:
      return read_group(reader.at("group"), groups).vertices;
    case 2: {
      const JsonReader at = reader.at("box");
      std::vector<VertexId> vertices = vertices_in(read_box(at), positions);
      if (vertices.empty()) at.fail("a box with a vertex of the cloth, " + extent(positions));
      return vertices;
    }
    default:
      return read_near(reader.at("near"), positions);
  }
}

}  // namespace pleat
