#pragma once

#include <optional>

#include "core/deform/deform_solver.h"

namespace pleat {

/// DeformSolver::settle a step at a time, so that a page can show the way and give up on it.
class DeformSettling {
 public:
  /// Choice of trying a second way, from rest.
  enum class Ways { from_here, from_here_and_rest };

  /// solver  outlives this; nothing but `step` steps it until done
  explicit DeformSettling(DeformSolver& solver, Ways ways = Ways::from_here_and_rest,
                          int max_linearisations = DeformSolver::kMaxLinearisations);

  /// One step on the way at hand; nothing once done.
  void step();
  bool done() const { return stage_ == Stage::done; }
  /// The first way is at its end, and the next step goes back to rest.
  bool is_between() const { return stage_ == Stage::between; }
  /// True on the way from rest, whose shapes are worth nothing unless it ends lower.
  bool is_on_trial() const { return stage_ == Stage::from_rest; }
  /// Ends a way from rest where it is and keeps the shape of lower energy; nothing on the other.
  void end_trial() {
    if (is_on_trial())
      end_way({SolveStatus::not_converged, 0, 0, "the way from rest was given up"});
  }

  /// Report of the way to the shape that was kept; iterations are those of both ways.
  const SolveReport& report() const { return report_; }

 private:
  enum class Stage { from_here, between, from_rest, done };

  void begin_trial();
  void end_way(SolveReport report);
  void keep_lower(SolveReport from_rest);

  DeformSolver& solver_;
  Ways ways_;
  int max_linearisations_;
  Stage stage_ = Stage::from_here;
  std::optional<DeformShape> kept_;  // end of the first way, while the second is tried
  double kept_energy_ = 0;
  SolveReport report_;  // report of the first way, then of all
};

}  // namespace pleat
