#include "core/deform/deform_settling.h"

namespace pleat {

DeformSettling::DeformSettling(DeformSolver& solver, Ways ways, int max_linearisations)
    : solver_(solver), ways_(ways), max_linearisations_(max_linearisations) {}

void DeformSettling::step() {
  if (done()) return;
  if (is_between()) begin_trial();
  SolveReport report;
  if (!solver_.converged()) report = solver_.step_towards_end(max_linearisations_);
  if (solver_.converged() || !report.ok()) end_way(std::move(report));
}

void DeformSettling::begin_trial() {
  kept_ = solver_.shape();
  kept_energy_ = solver_.energy();
  solver_.restart();
  stage_ = Stage::from_rest;
}

void DeformSettling::end_way(SolveReport report) {
  report.iterations = solver_.n_recent_linearisations();
  if (stage_ == Stage::from_rest) return keep_lower(std::move(report));
  report_ = std::move(report);
  stage_ = ways_ == Ways::from_here ? Stage::done : Stage::between;
}

void DeformSettling::keep_lower(SolveReport from_rest) {
  const int n_both = report_.iterations + from_rest.iterations;
  if (solver_.energy() < kept_energy_)
    report_ = std::move(from_rest);
  else
    solver_.take_back(*std::move(kept_));
  report_.iterations = n_both;
  kept_.reset();
  stage_ = Stage::done;
}

}  // namespace pleat
