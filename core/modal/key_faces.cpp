#include "core/modal/key_faces.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"

namespace pleat {
namespace {

using JoinedVertices = std::array<int, 3>;

JoinedVertices joined_by(const Triangle& triangle) {
  JoinedVertices vertices{triangle[0], triangle[1], triangle[2]};
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

std::vector<JoinedVertices> all_joined(const std::vector<Triangle>& triangles) {
  std::vector<JoinedVertices> all;
  all.reserve(triangles.size());
  for (const Triangle& triangle : triangles) all.push_back(joined_by(triangle));
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

void check_key_faces(Eigen::Index n_vertices, const std::vector<Triangle>& triangles,
                     Eigen::Index n_key_vertices, const std::vector<Triangle>& key_triangles) {
  if (n_key_vertices != n_vertices)
    throw InputError("", "expected a key with the " + std::to_string(n_vertices) +
                             " vertices of the model, in their order; found " +
                             std::to_string(n_key_vertices));
  if (key_triangles.size() != triangles.size())
    throw InputError("", "expected a key with the " + std::to_string(triangles.size()) +
                             " triangles of the model, found " +
                             std::to_string(key_triangles.size()));
  const std::vector<JoinedVertices> known = all_joined(triangles);
  for (const Triangle& triangle : key_triangles) {
    const JoinedVertices vertices = joined_by(triangle);
    if (!std::binary_search(known.begin(), known.end(), vertices))
      throw InputError("",
                       "expected a key whose triangles join the same vertices as the model's; "
                       "one of it joins the vertices " +
                           std::to_string(vertices[0] + 1) + ", " +
                           std::to_string(vertices[1] + 1) + " and " +
                           std::to_string(vertices[2] + 1) + ", counted from 1");
  }
}

}  // namespace pleat
