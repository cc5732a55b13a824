#include "core/dynamics/position_based/levels/cycle_projections.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/position_based/lanes/bend_program.h"
#include "core/dynamics/position_based/lanes/hanging_program.h"
#include "core/dynamics/position_based/lanes/lane_projections.h"
#include "core/dynamics/position_based/levels/attachments.h"
#include "core/dynamics/position_based/levels/coarse_levels.h"
#include "core/dynamics/position_based/levels/cycle_acceleration.h"
#include "core/dynamics/position_based/levels/gathered_springs.h"
#include "core/dynamics/position_based/levels/gathered_vertices.h"
#include "core/dynamics/position_based/levels/strain_correction.h"

namespace pleat {
namespace {

HierarchyOptions hierarchy_options(const MethodOptions& options) {
  HierarchyOptions hierarchy;
  hierarchy.n_coarser = options.levels;
  hierarchy.ratio = options.ratio;
  hierarchy.selection = options.selection;
  return hierarchy;
}

/// omega  0: the usual one
Relaxation relaxation(Smoother smoother, double omega) {
  constexpr double kUsualOmega = 1.1;  // sor's: more smooths less (docs/methods/multigrid.md)
  if (omega == 0) omega = smoother == Smoother::sor ? kUsualOmega : 1;
  return {smoother, omega};
}

/// Levels without the lengths of vertices that hang: these follow their parents, and would hold
/// what is joined to them as pins do.
MeshHierarchy hierarchy_of(const ClothModel& model, const MethodOptions& options) {
  if (options.levels == 0 || model.surface.triangles.empty()) return {};
  MeshHierarchy hierarchy =
      mesh_hierarchy(model.surface, model.pinned(), hierarchy_options(options));
  for (MeshLevel& level : hierarchy.levels)
    std::erase_if(level.edges, [&](const LevelEdge& edge) {
      return model.hangs(level.vertices[edge.a]) || model.hangs(level.vertices[edge.b]);
    });
  return hierarchy;
}

/// Lines need a grid, are what both smoothers ask for, and tell nobody their errors.
bool sweeps_lines(const MethodOptions& options, const LaneLayout& layout) {
  const auto takes_lines = [](Smoother smoother) {
    return smoother == Smoother::lines || smoother == Smoother::none;
  };
  return takes_lines(options.smoother_before) && takes_lines(options.smoother_after) &&
         layout.n_rows > 1 && options.level_lengths != LevelLengths::error;
}

/// Why lines that are asked for are swept one constraint after the other; empty where they are not.
std::string lines_remark(const MethodOptions& options, const LaneLayout& layout) {
  const bool asks_for_lines =
      options.smoother_before == Smoother::lines || options.smoother_after == Smoother::lines;
  if (!asks_for_lines || sweeps_lines(options, layout)) return {};
  const char* why = layout.n_rows <= 1 ? "this cloth has no grid"
                    : options.level_lengths == LevelLengths::error
                        ? "levels by errors ask springs for theirs one by one"
                        : "the other smoother is none";
  return std::string("gauss_seidel in the place of lines, as ") + why;
}

/// The constraints of a cloth's own mesh, whatever that is: the bending of whole threads at once,
/// then springs one after the other, in sets that share no vertex, four at a time.
struct GatheredSweeps {
  GatheredSprings springs;
  BendProgram bends;
  HangingProgram hanging;

  GatheredSweeps(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h)
      : springs(model, layout, law, h), bends(model, layout, h), hanging(model, layout, law, h) {}

  void refresh_pins(const float* inverse_masses) {
    springs.refresh_pins(inverse_masses);
    bends.refresh_pins(inverse_masses);
  }

  void refresh_rest_lengths(const ClothModel& model) {
    springs.refresh_rest_lengths(model);
    hanging.refresh_rest_lengths(model);
  }

  /// Projects each constraint once. The first sweep of a substep starts from multipliers of zero.
  void sweep(GatheredVertices& vertices, const Relaxation& relaxation, bool is_first) {
    if (!bends.empty())
      bends.sweep(vertices.lanes(), is_first ? Multipliers::begun : Multipliers::kept);
    if (is_first) springs.forget();
    springs.sweep(vertices.begins(), vertices.moves(), relaxation);
    if (!hanging.empty()) hanging.sweep(vertices.lanes(), is_first);
  }

  void forget() {
    springs.forget();
    bends.forget();
    hanging.forget();
  }

  double squared_residual(GatheredVertices& vertices) const {
    const LaneView& lanes = vertices.lanes_to_read();
    return hanging.squared_residual(lanes) +
           springs.squared_residual(vertices.begins(), vertices.moves()) +
           bends.squared_residual(lanes);
  }
};

/// Sweeps of the finest level after each correction by strains: half of what the cycle costs.
constexpr int kSweepsByStrain = 3;

class CycleProjections final : public Projections {
 public:
  CycleProjections(const ClothModel& model, const MethodOptions& options, const LaneLayout& layout,
                   SpringLaw law, double h)
      : options_(options),
        smoothing_{relaxation(options.smoother_before, options.omega),
                   relaxation(options.smoother_after, options.omega)},
        vertices_(layout.n_slots),
        n_constraints_(active_springs(model).size() + bend_constraints(model, h).size()),
        hierarchy_(hierarchy_of(model, options)),
        lines_remark_(lines_remark(options, layout)) {
    if (sweeps_lines(options, layout))
      lines_.emplace(model, layout, law, h);
    else
      gathered_.emplace(model, layout, law, h);
    for (const LaneLayout::Place& place : layout.places) slots_.push_back(place.slot);
  }

  void refresh_pins(const ClothModel& model, const float* inverse_masses) override {
    lines_ ? lines_->refresh_pins(model, inverse_masses) : gathered_->refresh_pins(inverse_masses);
    std::vector<double> of_vertices;
    for (const int slot : slots_) of_vertices.push_back(inverse_masses[slot]);
    if (options_.level_lengths == LevelLengths::error && hierarchy_.levels.size() > 1) {
      by_strain_ = {{hierarchy_, slots_, of_vertices, gathered_->springs.strained_edges(model),
                     model.surface.rest_positions},
                    gathered_->springs};
    } else {
      levels_ = {hierarchy_, slots_, of_vertices, options_.level_lengths};
    }
    if (options_.attachments == Attachments::none) return;
    const double h = options_.step / options_.substeps;
    attachments_ = {long_range_attachments(model, hierarchy_), slots_,
                    model.gravity.norm() * h * h};
  }

  void refresh_rest_lengths(const ClothModel& model) override {
    lines_ ? lines_->refresh_rest_lengths(model) : gathered_->refresh_rest_lengths(model);
    if (options_.level_lengths != LevelLengths::error || model.springs.empty()) return;
    double sum = 0;
    for (const Spring& spring : model.springs) sum += spring.rest_length;
    if (sum > 0) mean_length_ = static_cast<float>(sum / static_cast<double>(model.springs.size()));
  }

  void solve(const LaneView& view, int rounds) override {
    const float growth = attachments_.sweep(view);
    vertices_.begin(view);
    is_swept_ = false;
    by_strain_.empty() ? solve_by_lengths(rounds, growth) : solve_by_strains(rounds);
    vertices_.lanes();
  }

  double sweeps_per_round() const override {
    const double n_after = by_strain_.empty() ? 1 : kSweepsByStrain;
    const double n_sweeps = (smoothing_.before.smoother != Smoother::none ? 1 : 0) +
                            (smoothing_.after.smoother != Smoother::none ? n_after : 0);
    const CoarseLevels<Float4>& levels = by_strain_.empty() ? levels_ : by_strain_.levels();
    return n_sweeps + levels.n_projections(smoothing_) / static_cast<double>(n_constraints_);
  }

  double squared_residual(const LaneView& view) override {
    if (lines_) return lines_->squared_residual(view);
    vertices_.begin(view);
    return gathered_->squared_residual(vertices_);
  }

  void forget() override { lines_ ? lines_->forget() : gathered_->forget(); }

  std::string remark() const override {
    const bool says_both = !hierarchy_.shortage.empty() && !lines_remark_.empty();
    return hierarchy_.shortage + (says_both ? "; " : "") + lines_remark_;
  }

 private:
  void sweep(const Relaxation& relaxation) {
    if (relaxation.smoother == Smoother::none) return;
    const bool is_first = !is_swept_;
    is_swept_ = true;
    if (lines_)
      lines_->sweep(vertices_.lanes(), is_first);
    else
      gathered_->sweep(vertices_, relaxation, is_first);
  }

  /// growth  of the coarser levels' lengths: else they throw cloth that pins stretch
  void solve_by_lengths(int rounds, float growth) {
    for (int round = 0; round < rounds; ++round) {
      sweep(smoothing_.before);
      if (levels_.n_levels() > 0)
        levels_.correct(vertices_.begins(), vertices_.moves(), smoothing_, nullptr, growth);
      sweep(smoothing_.after);
    }
  }

  /// A cycle: sweep, measure, correct by coarse levels, sweep, and let the acceleration propose
  /// where cycles lead.
  void solve_by_strains(int rounds) {
    auto& [springs, bends, hanging] = *gathered_;
    by_strain_.begin();
    acceleration_.begin();
    springs.forget();
    bends.forget();
    take_errors();
    for (int round = 0; round < rounds; ++round) {
      if (smoothing_.before.smoother != Smoother::none) {
        sweep(smoothing_.before);
        take_errors();
      }
      by_strain_.correct(springs, vertices_.begins(), vertices_.moves(), vertices_.n_numbers(),
                         errors_.data(), smoothing_);
      for (int i = 0; i < kSweepsByStrain; ++i) sweep(smoothing_.after);
      take_errors();
      const std::array<std::span<float>, 3> point = {
          std::span(vertices_.moves(), vertices_.n_numbers()), springs.multipliers(),
          bends.multipliers()};
      if (acceleration_.propose(point, errors_)) take_errors();
      acceleration_.settle(point, errors_);
    }
  }

  /// Takes the errors: strains of springs, and bending over the springs' mean length.
  void take_errors() {
    const GatheredSprings& springs = gathered_->springs;
    const BendProgram& bends = gathered_->bends;
    errors_.resize(springs.n_strains() + bends.n_errors());
    springs.strains(vertices_.begins(), vertices_.moves(), errors_.data());
    bends.errors(vertices_.lanes_to_read(), mean_length_, errors_.data() + springs.n_strains());
  }

  MethodOptions options_;
  CycleSmoothing smoothing_;
  GatheredVertices vertices_;
  std::optional<LaneProjections> lines_;  // cloth whose own mesh is swept in lines, else
  std::optional<GatheredSweeps> gathered_;
  std::size_t n_constraints_;  // constraints of that mesh
  MeshHierarchy hierarchy_;
  std::string lines_remark_;  // see lines_remark
  std::vector<int> slots_;    // one for each vertex
  CoarseLevels<Float4> levels_;
  StrainCorrection by_strain_;  // replaces levels_ where the options ask for it
  CycleAcceleration acceleration_;
  std::vector<float> errors_;  // taken by take_errors()
  float mean_length_ = 1;      // mean rest length of springs [m]
  bool is_swept_ = false;      // this solve's first sweep is done
  AttachmentProgram attachments_;
};

}  // namespace

std::unique_ptr<Projections> cycle_projections(const ClothModel& model,
                                               const MethodOptions& options,
                                               const LaneLayout& layout, SpringLaw law, double h) {
  return std::make_unique<CycleProjections>(model, options, layout, law, h);
}

}  // namespace pleat
