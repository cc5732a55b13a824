#include "wasm/quad_arrays.h"

#include <algorithm>
#include <array>

namespace pleat {
namespace {

std::uint32_t number(VertexId v) { return static_cast<std::uint32_t>(v.value); }

/// The corners of a face with the vertices that hang on its edges, in turn; when there is one, it
/// comes first.
std::vector<VertexId> outline_of(const QuadMesh& mesh, const QuadFace& face) {
  std::vector<VertexId> outline;
  std::size_t first = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    outline.push_back(face.corners[k]);
    const VertexId middle = mesh.middle(face.corners[k], face.corners[(k + 1) % 4]);
    if (!middle.valid()) continue;
    first = outline.size();
    outline.push_back(middle);
  }
  std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(first), outline.end());
  return outline;
}

void add_triangles(const QuadMesh& mesh, QuadArrays& arrays) {
  const std::vector<Triangle> pairs = mesh.triangles();
  const auto add = [&](const Triangle& t, std::size_t face) {
    for (const VertexId v : t) arrays.triangles.push_back(number(v));
    arrays.triangle_faces.push_back(static_cast<std::uint32_t>(face));
  };
  std::size_t n = 0;
  for (const QuadFace& face : mesh.faces()) {
    if (!face.active()) continue;
    const std::vector<VertexId> outline = outline_of(mesh, face);
    if (outline.size() == 4) {
      add(pairs[2 * n], n);
      add(pairs[2 * n + 1], n);
    } else {
      // A vertex inside an edge sees every other one at an angle.
      for (std::size_t k = 1; k + 1 < outline.size(); ++k)
        add({outline[0], outline[k], outline[k + 1]}, n);
    }
    ++n;
  }
}

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
  add_triangles(mesh, arrays);
  for (const HangingVertex& h : mesh.hanging_vertices()) arrays.hanging.push_back(number(h.vertex));
  arrays.edges = edges_of(mesh);
  arrays.faces = faces_of(mesh);
  arrays.parents = parents_of(mesh);
  return arrays;
}

}  // namespace pleat
