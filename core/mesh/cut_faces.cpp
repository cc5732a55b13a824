#include "core/mesh/cut_faces.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"
#include "core/base/joined_sets.h"

namespace pleat {

/// The faces around a vertex, on the two sides of a cut through it.
struct CutFaces::Sides {
  VertexId vertex;
  std::span<const FaceId> far;

  bool parts(FaceId a, FaceId b) const { return is_far(a) != is_far(b); }
  bool is_far(FaceId face) const { return std::find(far.begin(), far.end(), face) != far.end(); }
};

CutFaces::CutFaces(std::vector<VertexId> corners, int n_corners, int n_vertices)
    : corners_(std::move(corners)),
      n_corners_(static_cast<std::size_t>(n_corners)),
      faces_at_(static_cast<std::size_t>(n_vertices)) {
  PLEAT_CHECK((n_corners == 3 || n_corners == 4) && corners_.size() % n_corners_ == 0,
              "faces have three or four corners");
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    PLEAT_CHECK(corners_[c] >= 0 && corners_[c] < n_vertices, "a corner is a vertex");
    faces_at_[corners_[c]].emplace_back(static_cast<std::int64_t>(c / n_corners_));
  }
}

/// The corner so many steps around the face from `at`.
VertexId CutFaces::neighbour(FaceId face, VertexId at, std::size_t steps) const {
  const auto corners = corners_of(face);
  const auto place =
      static_cast<std::size_t>(std::find(corners.begin(), corners.end(), at) - corners.begin());
  return corners[(place + steps) % n_corners_];
}

/// The number of the fan that each face around `at` is in once the sides are parted, from 0 for
/// that of the first face.
std::vector<int> CutFaces::fans(VertexId at, const Sides& sides) const {
  const std::vector<FaceId>& faces = faces_at_[at];
  JoinedSets joined(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const VertexId next = neighbour(faces[i], at, 1);
    for (std::size_t j = 0; j < faces.size(); ++j) {
      if (next != neighbour(faces[j], at, n_corners_ - 1)) continue;
      const bool is_at_cut = at == sides.vertex || next == sides.vertex;
      if (!is_at_cut || !sides.parts(faces[i], faces[j]))
        joined.join(static_cast<int>(i), static_cast<int>(j));
    }
  }
  return joined.numbers();
}

/// Gives a vertex of its own to each fan around `vertex` but the first.
void CutFaces::give_fans(VertexId vertex, const std::vector<int>& numbers) {
  const std::vector<FaceId> faces = std::exchange(faces_at_[vertex], {});
  const std::size_t n_before = faces_at_.size();
  const auto n_new = static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end()));
  faces_at_.resize(n_before + n_new);
  origins_.insert(origins_.end(), n_new, vertex);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const VertexId owner =
        numbers[i] == 0 ? vertex : VertexId(static_cast<std::int64_t>(n_before) + numbers[i] - 1);
    for (std::size_t k = 0; k < n_corners_; ++k) {
      VertexId& corner = corners_[n_corners_ * static_cast<std::size_t>(faces[i]) + k];
      if (corner == vertex) corner = owner;
    }
    faces_at_[owner].push_back(faces[i]);
  }
}

std::vector<VertexId> CutFaces::cut(VertexId vertex, std::span<const FaceId> far,
                                    std::span<const char> is_held) {
  const Sides sides{vertex, far};
  std::vector<VertexId> reached{vertex};  // and the ends of cut edges
  for (const FaceId a : faces_at_[vertex])
    for (const FaceId b : faces_at_[vertex])
      if (const VertexId end = neighbour(a, vertex, 1);
          sides.parts(a, b) && end == neighbour(b, vertex, n_corners_ - 1))
        reached.push_back(end);
  std::vector<VertexId> split;
  std::vector<std::vector<int>> fans_of_split;
  for (const VertexId v : reached) {
    std::vector<int> numbers = fans(v, sides);
    if (*std::max_element(numbers.begin(), numbers.end()) == 0) continue;
    const bool was_there = static_cast<std::size_t>(v) < is_held.size();
    if (was_there && is_held[v] != 0) return {};
    split.push_back(v);
    fans_of_split.push_back(std::move(numbers));
  }
  for (std::size_t s = 0; s < split.size(); ++s) give_fans(split[s], fans_of_split[s]);
  return split;
}

}  // namespace pleat
