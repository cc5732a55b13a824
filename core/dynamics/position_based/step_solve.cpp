#include "core/dynamics/position_based/step_solve.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/dynamics/stepper_type.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

PredictedStep predicted_step(const ClothModel& model, State state, double time_end, double h) {
  PLEAT_CHECK(h > 0, "a step is positive");
  place_between_parents(model.hanging, state);
  PredictedStep step{h, state.positions, {}};
  step.predicted = state.positions + h * state.velocities;
  step.predicted.colwise() += h * h * model.gravity;
  place_between_parents(model.hanging, step.predicted);
  for (const Pin& pin : model.pins) step.predicted.col(pin.vertex) = pin.position(time_end);
  return step;
}

StepSolve::StepSolve(const ClothModel& model, const MethodOptions& options,
                     const PredictedStep& step)
    : layout_(lane_layout(model)),
      hanging_(model.hanging),
      pitch_(layout_.pitch()),
      data_(pitch_ * kArrays, 0.0f),
      origin_((step.begins.rowwise().minCoeff() + step.begins.rowwise().maxCoeff()) / 2) {
  PLEAT_CHECK(options.stepper->make_projections != nullptr, "a position-based stepper");
  projections_ = options.stepper->make_projections(model, options, layout_,
                                                   spring_law(options.constraints), step.h);
  const double mean_mass = model.masses.mean();
  for (int i = 0; i < model.n_vertices(); ++i) {
    const int slot = layout_.places[static_cast<std::size_t>(i)].slot;
    for (int k = 0; k < 3; ++k) {
      const auto rounded = static_cast<float>(step.begins(k, i) - origin_[k]);
      array(begin + k)[slot] = rounded;
      array(move + k)[slot] = static_cast<float>(step.predicted(k, i) - origin_[k] - rounded);
    }
    if (!model.hangs(VertexId(i)))
      array(inverse_mass)[slot] = static_cast<float>(mean_mass / model.masses[i]);
  }
  for (const Pin& pin : model.pins)
    array(inverse_mass)[layout_.places[static_cast<std::size_t>(pin.vertex)].slot] = 0;
  first_moves_.assign(array(move), array(inverse_mass));
  projections_->refresh_pins(model, array(inverse_mass));
  projections_->refresh_rest_lengths(model);
  projections_->forget();
  residual_begin_ = std::sqrt(projections_->squared_residual(view()));
}

LaneView StepSolve::view() {
  return {{array(move), array(move + 1), array(move + 2)},
          {array(begin), array(begin + 1), array(begin + 2)},
          array(inverse_mass)};
}

void StepSolve::solve(int rounds) {
  std::copy(first_moves_.begin(), first_moves_.end(), array(move));
  projections_->forget();
  if (rounds > 0) projections_->solve(view(), rounds);
}

double StepSolve::relative_error() {
  return residual_begin_ > 0 ? std::sqrt(projections_->squared_residual(view())) / residual_begin_
                             : 0;
}

Positions StepSolve::positions() const {
  Positions places(3, static_cast<Eigen::Index>(layout_.places.size()));
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const auto slot = static_cast<std::size_t>(layout_.places[static_cast<std::size_t>(i)].slot);
    for (std::size_t k = 0; k < 3; ++k)
      places(static_cast<Eigen::Index>(k), i) = origin_[static_cast<Eigen::Index>(k)] +
                                                static_cast<double>(data_[k * pitch_ + slot]) +
                                                data_[(move + k) * pitch_ + slot];
  }
  place_between_parents(hanging_, places);
  return places;
}

}  // namespace pleat
