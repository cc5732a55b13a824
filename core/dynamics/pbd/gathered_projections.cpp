#include "core/dynamics/pbd/gathered_projections.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/dynamics/pbd/attachments.h"
#include "core/dynamics/pbd/coarse_levels.h"
#include "core/dynamics/pbd/gathered_bends.h"
#include "core/dynamics/pbd/gathered_springs.h"
#include "core/dynamics/pbd/quad_vectors.h"
#include "core/dynamics/xpbd/hanging_program.h"

namespace pleat {
namespace {

/// Begins and moves with the components of a vertex side by side, by slot.
class GatheredVertices {
 public:
  explicit GatheredVertices(int n_slots)
      : begins_(4 * static_cast<std::size_t>(n_slots), 0.0f), moves_(begins_) {}

  void load(const LaneView& view) {
    for (std::size_t i = 0; i < begins_.size(); i += 16) {
      take(view.begins, i / 4, &begins_[i]);
      take(view.moves, i / 4, &moves_[i]);
    }
  }

  void store_moves(const LaneView& view) const {
    for (std::size_t i = 0; i < moves_.size(); i += 16)
      pleat::store(in_lanes(gather<Float4>(&moves_[i], kFour)), view.moves,
                   static_cast<int>(i / 4));
  }

  std::size_t n_slots() const { return begins_.size() / 4; }
  const float* begins() const { return begins_.data(); }
  float* moves() { return moves_.data(); }

 private:
  static constexpr std::array<int, 4> kFour = {0, 4, 8, 12};

  template <class Pointer>
  static void take(const std::array<Pointer, 3>& from, std::size_t slot, float* to) {
    QuadVectors<Float4> vectors = {Float4::load(from[0] + slot), Float4::load(from[1] + slot),
                                   Float4::load(from[2] + slot), Float4::all(0)};
    transpose(vectors[0], vectors[1], vectors[2], vectors[3]);
    scatter(vectors, to, kFour);
  }

  std::vector<float> begins_, moves_;
};

HierarchyOptions hierarchy_options(const MethodOptions& options) {
  HierarchyOptions hierarchy;
  hierarchy.n_coarser = options.levels;
  hierarchy.ratio = options.ratio;
  hierarchy.selection = options.selection;
  return hierarchy;
}

std::vector<bool> pinned(const ClothModel& model) {
  std::vector<bool> is_pinned(static_cast<std::size_t>(model.n_vertices()), false);
  for (const Pin& pin : model.pins) is_pinned[pin.vertex] = true;
  return is_pinned;
}

/// omega  0: the usual one
Relaxation relaxation(Smoother smoother, double omega) {
  constexpr double kUsualOmega = 1.1;  // of sor: more smooths less (docs/methods/multigrid.md)
  if (omega == 0) omega = smoother == Smoother::sor ? kUsualOmega : 1;
  return {smoother, omega};
}

/// Levels without the lengths of vertices that hang: these follow their parents, and would hold
/// what is joined to them as pins do.
MeshHierarchy hierarchy_of(const ClothModel& model, const MethodOptions& options) {
  if (options.levels == 0 || model.surface.triangles.empty()) return {};
  MeshHierarchy hierarchy =
      mesh_hierarchy(model.surface, pinned(model), hierarchy_options(options));
  for (MeshLevel& level : hierarchy.levels)
    std::erase_if(level.edges, [&](const LevelEdge& edge) {
      return model.hangs(level.vertices[edge.a]) || model.hangs(level.vertices[edge.b]);
    });
  return hierarchy;
}

class GatheredProjections final : public Projections {
 public:
  GatheredProjections(const ClothModel& model, const MethodOptions& options,
                      const LaneLayout& layout, SpringLaw law, double h)
      : options_(options),
        smoothing_{relaxation(options.smoother_before, options.omega),
                   relaxation(options.smoother_after, options.omega)},
        vertices_(layout.n_slots),
        springs_(model, layout, law, h),
        bends_(model, layout, h),
        hanging_(model, layout, law, h),
        hierarchy_(hierarchy_of(model, options)) {
    for (const LaneLayout::Place& place : layout.places) slots_.push_back(place.slot);
  }

  void refresh_pins(const ClothModel& model, const float* inverse_masses) override {
    springs_.refresh_pins(inverse_masses);
    bends_.refresh_pins(inverse_masses);
    std::vector<double> of_vertices;
    for (const int slot : slots_) of_vertices.push_back(inverse_masses[slot]);
    levels_ = {hierarchy_, slots_, of_vertices, options_.level_lengths};
    if (options_.attachments == Attachments::long_range) attach(model, inverse_masses);
  }

  void refresh_rest_lengths(const ClothModel& model) override {
    springs_.refresh_rest_lengths(model);
    hanging_.refresh_rest_lengths(model);
  }

  void solve(const LaneView& view, int rounds) override {
    vertices_.load(view);
    is_first_ = true;
    for (int round = 0; round < rounds; ++round) {
      attachments_.sweep(vertices_.begins(), vertices_.moves(), {}, stretch_of_pins());
      sweep(view, smoothing_.before);
      levels_.correct(vertices_.begins(), vertices_.moves(), smoothing_);
      sweep(view, smoothing_.after);
    }
    vertices_.store_moves(view);
  }

  double squared_residual(const LaneView& view) override {
    return springs_.squared_residual(vertices_.begins(), vertices_.moves()) +
           bends_.squared_residual(vertices_.begins(), vertices_.moves()) +
           hanging_.squared_residual(view);
  }

  double squared_residual_before(const LaneView& view) override {
    vertices_.load(view);
    return springs_.squared_residual_before_sweeps(vertices_.begins(), vertices_.moves()) +
           bends_.squared_residual_before_sweeps(vertices_.begins(), vertices_.moves()) +
           hanging_.squared_residual_before_sweeps(view);
  }

 private:
  void attach(const ClothModel& model, const float* inverse_masses) {
    std::vector<PlaceLength> lengths = long_range_attachments(model, hierarchy_);
    for (PlaceLength& length : lengths)
      for (int& place : length.places) place = slots_[static_cast<std::size_t>(place)];
    between_pins_ = lengths_between_pins(lengths);
    const std::size_t n_slots = vertices_.n_slots();
    attachments_ = {lengths, std::vector<double>(inverse_masses, inverse_masses + n_slots),
                    LengthSide::longer};
  }

  /// By how much pins are further apart than attachments allow: 1 where they are not.
  float stretch_of_pins() {
    float most = 1;
    for (const auto& [pins, length] : between_pins_) {
      const auto place = [&](int slot) {
        return Float4::load(vertices_.begins() + 4 * slot) +
               Float4::load(vertices_.moves() + 4 * slot);
      };
      const Float4 d = place(pins[0]) - place(pins[1]);
      std::array<float, 4> squares{};
      (d * d).store(squares.data());
      most = std::max(most,
                      std::sqrt(squares[0] + squares[1] + squares[2]) / static_cast<float>(length));
    }
    return most;
  }

  void sweep(const LaneView& view, const Relaxation& relaxation) {
    if (relaxation.smoother == Smoother::none) return;
    const float* const begins = vertices_.begins();
    float* const moves = vertices_.moves();
    const float omega =
        relaxation.smoother == Smoother::sor ? static_cast<float>(relaxation.omega) : 1.0f;
    if (is_first_) {
      bends_.first_sweep(begins, moves, omega);
      springs_.first_sweep(begins, moves, relaxation);
    } else {
      bends_.next_sweep(begins, moves, omega);
      springs_.next_sweep(begins, moves, relaxation);
    }
    if (!hanging_.empty()) {
      vertices_.store_moves(view);
      is_first_ ? hanging_.first_sweep(view) : hanging_.next_sweep(view);
      vertices_.load(view);
    }
    is_first_ = false;
  }

  MethodOptions options_;
  CycleSmoothing smoothing_;
  GatheredVertices vertices_;
  GatheredSprings springs_;
  GatheredBends bends_;
  HangingProgram hanging_;
  MeshHierarchy hierarchy_;
  std::vector<int> slots_;  // of each vertex
  CoarseLevels<Float4> levels_;
  LengthGroups<Float4> attachments_;
  std::vector<PlaceLength> between_pins_;  // by their slots
  bool is_first_ = true;                   // sweep of the substep
};

}  // namespace

std::unique_ptr<Projections> gathered_projections(const ClothModel& model,
                                                  const MethodOptions& options,
                                                  const LaneLayout& layout, SpringLaw law,
                                                  double h) {
  return std::make_unique<GatheredProjections>(model, options, layout, law, h);
}

}  // namespace pleat
