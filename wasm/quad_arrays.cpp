#include "wasm/quad_arrays.h"

#include <algorithm>
#include <array>

namespace pleat {
namespace {

std::uint32_t number(VertexId v) { return static_cast<std::uint32_t>(v.value); }

std::vector<std::uint32_t> edges_of(const QuadMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (const QuadFace& face : mesh.faces())
    for (std::size_t k = 0; face.active() && k < 4; ++k) {
      const std::uint32_t a = number(face.corners[k]);
      const std::uint32_t b = number(face.corners[(k + 1) % 4]);
      sides.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  std::vector<std::uint32_t> edges;
  for (const auto& side : sides) edges.insert(edges.end(), side.begin(), side.end());
  return edges;
}

std::vector<std::int32_t> faces_of(const QuadMesh& mesh) {
  std::vector<std::int32_t> faces;
  std::int32_t id = -1;
  for (const QuadFace& face : mesh.faces()) {
    ++id;
    if (!face.active()) continue;
    faces.insert(faces.end(), {id, face.level, face.parent.value});
    for (const VertexId v : face.corners) faces.push_back(v.value);
  }
  return faces;
}

std::vector<std::int32_t> parents_of(const QuadMesh& mesh) {
  std::vector<std::int32_t> parents;
  for (const VertexParents& p : mesh.parents())
    for (std::size_t k = 0; k < 4; ++k)
      parents.push_back(static_cast<int>(k) < p.count ? p.vertices[k].value : -1);
  return parents;
}

}  // namespace

QuadArrays quad_arrays(const QuadMesh& mesh) {
  QuadArrays arrays;
  for (const Triangle& t : mesh.triangles())
    for (const VertexId v : t) arrays.triangles.push_back(number(v));
  for (const HangingVertex& h : mesh.hanging_vertices()) arrays.hanging.push_back(number(h.vertex));
  arrays.edges = edges_of(mesh);
  arrays.faces = faces_of(mesh);
  arrays.parents = parents_of(mesh);
  return arrays;
}

}  // namespace pleat
