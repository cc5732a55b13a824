#include "core/dynamics/pbd/cycle_projections.h"

#include <algorithm>

#include "core/dynamics/pbd/attachments.h"
#include "core/dynamics/pbd/coarse_levels.h"
#include "core/dynamics/pbd/error_correction.h"
#include "core/dynamics/pbd/mesh_sweeps.h"

namespace pleat {
namespace {

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

/// Lines need a grid, are what both smoothers ask for, and tell nobody their errors.
std::unique_ptr<MeshSweeps> sweeps_of(const ClothModel& model, const MethodOptions& options,
                                      const LaneLayout& layout, SpringLaw law, double h) {
  const auto takes_lines = [](Smoother smoother) {
    return smoother == Smoother::lines || smoother == Smoother::none;
  };
  const bool in_lines = takes_lines(options.smoother_before) &&
                        takes_lines(options.smoother_after) && layout.n_rows > 1 &&
                        options.level_lengths != LevelLengths::error;
  return (in_lines ? line_sweeps : gathered_sweeps)(model, layout, law, h);
}

class CycleProjections final : public Projections {
 public:
  CycleProjections(const ClothModel& model, const MethodOptions& options, const LaneLayout& layout,
                   SpringLaw law, double h)
      : options_(options),
        smoothing_{relaxation(options.smoother_before, options.omega),
                   relaxation(options.smoother_after, options.omega)},
        vertices_(layout.n_slots),
        sweeps_(sweeps_of(model, options, layout, law, h)),
        hierarchy_(hierarchy_of(model, options)) {
    for (const LaneLayout::Place& place : layout.places) slots_.push_back(place.slot);
  }

  void refresh_pins(const ClothModel& model, const float* inverse_masses) override {
    sweeps_->refresh_pins(inverse_masses);
    std::vector<double> of_vertices;
    for (const int slot : slots_) of_vertices.push_back(inverse_masses[slot]);
    if (options_.level_lengths == LevelLengths::error && hierarchy_.levels.size() > 1) {
      by_error_ = {{hierarchy_, slots_, of_vertices, sweeps_->springs()->strained_edges(model),
                    model.surface.rest_positions},
                   *sweeps_->springs()};
    } else {
      levels_ = {hierarchy_, slots_, of_vertices, options_.level_lengths};
    }
    if (options_.attachments == Attachments::long_range)
      attachments_ = {long_range_attachments(model, hierarchy_), slots_};
  }

  void refresh_rest_lengths(const ClothModel& model) override {
    sweeps_->refresh_rest_lengths(model);
  }

  void solve(const LaneView& view, int rounds) override {
    attachments_.sweep(view);
    vertices_.begin(view);
    if (!by_error_.empty()) {
      by_error_.begin();
      sweeps_->springs()->forget();
    }
    bool is_first = true;
    const auto sweep = [&](const Relaxation& relaxation) {
      if (relaxation.smoother == Smoother::none) return;
      sweeps_->sweep(vertices_, relaxation, is_first);
      is_first = false;
    };
    for (int round = 0; round < rounds; ++round) {
      sweep(smoothing_.before);
      correct();
      sweep(smoothing_.after);
    }
    vertices_.lanes();
  }

  double sweeps_per_round() const override {
    const double n_sweeps = (smoothing_.before.smoother != Smoother::none ? 1 : 0) +
                            (smoothing_.after.smoother != Smoother::none ? 1 : 0);
    const CoarseLevels<Float4>& levels = by_error_.empty() ? levels_ : by_error_.levels();
    return n_sweeps + static_cast<double>(levels.n_projections(smoothing_)) / sweeps_->size();
  }

  double squared_residual(const LaneView& view) override {
    vertices_.begin(view);
    return sweeps_->squared_residual(vertices_);
  }

  double squared_residual_before(const LaneView& view) override {
    vertices_.begin(view);
    return sweeps_->squared_residual_before(vertices_);
  }

 private:
  void correct() {
    if (!by_error_.empty()) {
      by_error_.correct(*sweeps_->springs(), vertices_.begins(), vertices_.moves(),
                        vertices_.n_numbers(), smoothing_);
    } else if (levels_.n_levels() > 0) {
      levels_.correct(vertices_.begins(), vertices_.moves(), smoothing_);
    }
  }

  MethodOptions options_;
  CycleSmoothing smoothing_;
  GatheredVertices vertices_;
  std::unique_ptr<MeshSweeps> sweeps_;
  MeshHierarchy hierarchy_;
  std::vector<int> slots_;  // of each vertex
  CoarseLevels<Float4> levels_;
  ErrorCorrection by_error_;  // in the place of levels_, where the options ask for it
  AttachmentProgram attachments_;
};

}  // namespace

std::unique_ptr<Projections> cycle_projections(const ClothModel& model,
                                               const MethodOptions& options,
                                               const LaneLayout& layout, SpringLaw law, double h) {
  return std::make_unique<CycleProjections>(model, options, layout, law, h);
}

}  // namespace pleat
