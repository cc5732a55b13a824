#include "core/refinement/shape_splits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>

#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

/// Faces that are offered together: alone, a face pays for vertices that its neighbours would share
/// and its corners hang. More than these gain nothing on garments.
constexpr std::size_t kLargestGroup = 4;

/// Share by which the losses of mirrored faces differ at most, for their sums round differently.
constexpr double kMirrorRounding = 1e-9;

/// The face beyond each edge of each face, of the same level; invalid at a border.
std::vector<std::array<FaceId, 4>> faces_beyond(const QuadMesh& fine) {
  std::unordered_map<std::uint64_t, std::array<FaceId, 2>> sides;  // only looked up
  std::vector<std::array<FaceId, 4>> beyond(fine.faces().size());
  for (const bool is_known : {false, true}) {
    for (std::size_t f = 0; f < beyond.size(); ++f) {
      const auto& c = fine.faces()[f].corners;
      const FaceId id(static_cast<std::int64_t>(f));
      for (int k = 0; k < 4; ++k) {
        std::array<FaceId, 2>& pair = sides[edge_key(c[k], c[(k + 1) % 4])];
        if (is_known)
          beyond[f][k] = pair[pair[0] == id ? 1 : 0];
        else
          pair[pair[0].valid() ? 1 : 0] = id;
      }
    }
  }
  return beyond;
}

/// Splits in an order that keeps the mesh balanced, and what they change.
struct Step {
  double saved = 0;  // loss saved [m^4]
  int n_added = 0;   // vertices
  std::vector<FaceId> splits;
  std::vector<FaceId> wanted;  // the others are for balance

  /// More than by rounding: a face and its mirror image save the same.
  bool saves_more_each(const Step& other) const {
    const double own = saved * other.n_added;
    const double others = other.saved * n_added;
    return own - others > kMirrorRounding * std::abs(others);
  }

  float rate() const { return static_cast<float>(saved / n_added); }
};

struct Candidate {
  float rate;  // saved for each vertex that is added [m^4], so that mirrored faces are equal
  FaceId face;
  int version;

  bool operator<(const Candidate& other) const {
    if (rate != other.rate) return rate < other.rate;
    return face > other.face;
  }
};

/// Faces are those of the fine mesh here; a mesh on the way is the set of those that it has split.
class ShapeSplitter {
 public:
  ShapeSplitter(const QuadMesh& fine, const FaceLosses& losses, const PlanOptions& options)
      : fine_(fine),
        losses_(losses),
        options_(options),
        beyond_(faces_beyond(fine)),
        is_split_(beyond_.size(), false),
        versions_(beyond_.size(), 0),
        readers_(beyond_.size()),
        ids_(beyond_.size()) {
    for (int f = 0; f < fine.n_base_faces(); ++f) {
      ids_[f] = FaceId(f);
      loss_ += loss(FaceId(f));
      allowed_loss_ += options.largest_loss * options.largest_loss * fine.area(FaceId(f));
      for (const VertexId v : fine.faces()[f].corners) n_vertices_ = std::max(n_vertices_, v + 1);
    }
    for (int f = 0; f < fine.n_base_faces(); ++f) offer(FaceId(f));
  }

  /// A face that does not fit never will: what others add of its vertices is room that they take.
  std::vector<PlannedSplit> run() {
    while (!queue_.empty() &&
           (options_.max_vertices || allowed_loss_ == 0 || loss_ > allowed_loss_)) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (is_split_[next.face] || next.version != versions_[next.face]) continue;
      const Step step = best_step(next.face);
      if (step.splits.empty()) continue;
      if (step.rate() < next.rate)  // there is less room
        queue_.push({step.rate(), next.face, next.version});
      else
        make(step);
    }
    return std::move(splits_);
  }

 private:
  bool fits(const Step& step) const {
    return !options_.max_vertices || n_vertices_ + step.n_added <= *options_.max_vertices;
  }

  bool is_split(FaceId face) {
    if (reader_.valid()) readers_[face].push_back(reader_);
    return is_split_[face];
  }

  /// True when the middle of a split face's edge hangs.
  bool hangs(FaceId face, int edge) {
    const FaceId other = beyond_[face][edge];
    return other.valid() && !is_split(other);
  }

  int place_in_parent(FaceId face) const {
    return face - fine_.faces()[fine_.faces()[face].parent].children[0];
  }

  double loss(FaceId face) {
    const FaceId parent = fine_.faces()[face].parent;
    int row = 0;
    if (parent.valid()) {
      const int k = place_in_parent(face);
      row = int{hangs(parent, k)} + 2 * int{hangs(parent, (k + 3) % 4)};
    }
    return losses_(row, face.value);
  }

  /// Sum of the losses of faces with corners on this one's edges.
  double loss_beside(FaceId face) {
    double sum = 0;
    for (const FaceId other : beyond_[face]) {
      if (!other.valid() || !is_split(other)) continue;
      for (int k = 0; k < 4; ++k)
        if (beyond_[other][k] == face)
          for (const int child : {k, (k + 1) % 4})
            sum += loss(fine_.faces()[other].children[child]);
    }
    return sum;
  }

  /// Splits a face, and before it all that have to be: its parent, and what would then be two
  /// levels coarser beyond the parent's edges.
  void split(FaceId face, Step& step) {
    if (is_split(face)) return;
    const QuadFace& own = fine_.faces()[face];
    if (own.parent.valid()) {
      split(own.parent, step);
      const int k = place_in_parent(face);
      for (const int edge : {k, (k + 3) % 4})
        if (const FaceId other = beyond_[own.parent][edge]; other.valid()) split(other, step);
    }
    step.saved += loss(face) + loss_beside(face);
    is_split_[face] = true;
    step.saved -= loss_beside(face);
    for (const FaceId child : own.children) step.saved -= loss(child);
    ++step.n_added;
    for (const FaceId other : beyond_[face])
      if (!other.valid() || !is_split(other)) ++step.n_added;
    step.splits.push_back(face);
  }

  void set_split(std::span<const FaceId> faces, bool value) {
    for (const FaceId face : faces) is_split_[face] = value;
  }

  /// A face, and as long as each vertex then saves more, one of those beside; empty if it does not
  /// fit.
  Step best_step(FaceId face) {
    Step step;
    step.wanted.push_back(face);
    split(face, step);
    while (step.wanted.size() < kLargestGroup) {
      Step longest = step;
      for (const FaceId inside : step.wanted) {
        for (const FaceId other : beyond_[inside]) {
          if (!other.valid() || is_split(other)) continue;
          Step longer = step;
          longer.wanted.push_back(other);
          split(other, longer);
          set_split(std::span(longer.splits).subspan(step.splits.size()), false);
          if (fits(longer) && longer.saves_more_each(longest)) longest = std::move(longer);
        }
      }
      if (longest.wanted.size() == step.wanted.size()) break;
      step = std::move(longest);
      set_split(step.splits, true);
    }
    set_split(step.splits, false);
    return fits(step) ? step : Step{};
  }

  void offer(FaceId face) {
    if (fine_.faces()[face].level >= *options_.level_cap) return;
    reader_ = face;
    const Step step = best_step(face);
    reader_ = FaceId();
    if (!step.splits.empty()) queue_.push({step.rate(), face, ++versions_[face]});
  }

  void make(const Step& step) {
    loss_ -= step.saved;
    n_vertices_ += step.n_added;
    std::vector<FaceId> changed;
    for (const FaceId face : step.splits) {
      const bool is_wanted =
          std::find(step.wanted.begin(), step.wanted.end(), face) != step.wanted.end();
      splits_.push_back({ids_[face], std::sqrt(loss(face) / fine_.area(face)), !is_wanted});
      is_split_[face] = true;
      std::int64_t next = fine_.n_base_faces() + 4 * static_cast<std::int64_t>(splits_.size() - 1);
      for (const FaceId child : fine_.faces()[face].children) {
        ids_[child] = FaceId(next++);
        changed.push_back(child);
      }
      changed.insert(changed.end(), readers_[face].begin(), readers_[face].end());
      readers_[face].clear();
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const FaceId face : changed)
      if (!is_split_[face]) offer(face);
  }

  const QuadMesh& fine_;
  const FaceLosses& losses_;
  const PlanOptions& options_;
  std::vector<std::array<FaceId, 4>> beyond_;
  std::vector<bool> is_split_;
  std::vector<int> versions_;                 // version of each face's offer
  std::vector<std::vector<FaceId>> readers_;  // faces whose offers change when a face is split
  FaceId reader_;                             // face whose offer is looked at, if any
  std::vector<FaceId> ids_;                   // numbers in the planned mesh
  std::priority_queue<Candidate> queue_;
  std::vector<PlannedSplit> splits_;
  double loss_ = 0;          // loss of the mesh planned so far [m^4]
  double allowed_loss_ = 0;  // [m^4]
  int n_vertices_ = 0;
};

}  // namespace

std::vector<PlannedSplit> shape_splits(const QuadMesh& fine, const FaceLosses& losses,
                                       const PlanOptions& options) {
  return ShapeSplitter(fine, losses, options).run();
}

}  // namespace pleat
