#include "core/mesh/quad_patch.h"

#include <cstdint>
#include <string>
#include <unordered_map>

#include "core/base/check.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

using EdgeMap = std::unordered_map<std::uint64_t, std::size_t>;

std::string quad_where(std::size_t face) { return "/quads/" + std::to_string(face); }

void check_corners(const QuadPatch& patch, std::size_t face) {
  const auto& corners = patch.quads[face];
  for (int k = 0; k < 4; ++k) {
    if (corners[k] < 0 || corners[k] >= patch.rest_positions.cols())
      throw InputError(quad_where(face), "expected corners below " +
                                             std::to_string(patch.rest_positions.cols()) +
                                             ", got " + std::to_string(corners[k].value));
    for (int j = 0; j < k; ++j)
      if (corners[j] == corners[k])
        throw InputError(quad_where(face), "expected four different corners, got vertex " +
                                               std::to_string(corners[k].value) + " twice");
  }
  if (!(quad_area(patch.rest_positions, corners) > 0))
    throw InputError(quad_where(face), "expected a face with an area, got one without");
}

/// Face on the left of each directed edge: sound faces share an edge in both directions, once each.
EdgeMap directed_edges(const QuadPatch& patch) {
  EdgeMap left;
  for (std::size_t f = 0; f < patch.quads.size(); ++f) {
    for (int k = 0; k < 4; ++k) {
      const VertexId from = patch.quads[f][k];
      const VertexId to = patch.quads[f][(k + 1) % 4];
      const auto [other, is_new] = left.emplace(directed_edge_key(from, to), f);
      if (!is_new)
        throw InputError(quad_where(f),
                         "expected at most two faces at an edge, wound alike, got its edge " +
                             std::to_string(from) + "-" + std::to_string(to) +
                             " in the same direction in face " + std::to_string(other->second));
    }
  }
  return left;
}

}  // namespace

double quad_area(const Positions& x, const std::array<VertexId, 4>& c) {
  return 0.5 * Vec3(x.col(c[2]) - x.col(c[0])).cross(Vec3(x.col(c[3]) - x.col(c[1]))).norm();
}

void check_patch(const QuadPatch& patch) {
  const Eigen::Index n = patch.rest_positions.cols();
  if (!patch.rest_positions.allFinite() || !patch.rest_coordinates.allFinite())
    throw InputError("/rest_positions", "expected finite numbers, got one that is not");
  PLEAT_CHECK(patch.rest_coordinates.cols() == n, "rest coordinates for every vertex");
  std::vector<bool> has_face(static_cast<std::size_t>(n), false);
  for (std::size_t f = 0; f < patch.quads.size(); ++f) {
    check_corners(patch, f);
    for (const VertexId v : patch.quads[f]) has_face[v] = true;
  }
  directed_edges(patch);
  for (Eigen::Index i = 0; i < n; ++i)
    if (!has_face[i])
      throw InputError("/rest_positions/" + std::to_string(i),
                       "expected a face at every vertex, got a vertex without");
}

std::vector<bool> chess_board(const QuadPatch& patch) {
  const EdgeMap left = directed_edges(patch);
  enum class Colour : std::uint8_t { none, white, black };
  std::vector<Colour> colours(patch.quads.size(), Colour::none);
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < colours.size(); ++first) {
    if (colours[first] != Colour::none) continue;
    colours[first] = Colour::white;
    queue.assign(1, first);
    for (std::size_t at = 0; at < queue.size(); ++at) {
      const auto& corners = patch.quads[queue[at]];
      for (int k = 0; k < 4; ++k) {
        const auto other = left.find(directed_edge_key(corners[(k + 1) % 4], corners[k]));
        if (other == left.end() || colours[other->second] != Colour::none) continue;
        colours[other->second] =
            colours[queue[at]] == Colour::white ? Colour::black : Colour::white;
        queue.push_back(other->second);
      }
    }
  }
  std::vector<bool> white;
  white.reserve(colours.size());
  for (const Colour colour : colours) white.push_back(colour == Colour::white);
  return white;
}

}  // namespace pleat
