#include "core/dynamics/implicit/anderson_acceleration.h"

#include <algorithm>

namespace pleat {
namespace {

constexpr std::size_t kWindow = 2;

/// a . A b [J]
double inner_product(const LoadedRows& a, const LoadedRows& b) {
  return places(a).cwiseProduct(loads(b)).sum();
}

}  // namespace

AndersonAcceleration::AndersonAcceleration(Eigen::Index n_vertices)
    : point_(n_vertices, 6),
      step_(n_vertices, 6),
      image_(n_vertices, 6),
      change_(n_vertices, 6),
      directions_(kWindow + 1, {step_, image_, 0}) {}

void AndersonAcceleration::start(const LoadedRows& point, double rounding) {
  point_ = point;
  rounding_ = rounding;
  n_directions_ = 0;
  has_round_ = false;
}

/// Makes the newest direction of the room at the end, which holds the differences of step and
/// image.
void AndersonAcceleration::add_direction() {
  constexpr double kLostShare = 1e-14;  // share of a squared norm: what is left is rounding
  Direction& fresh = directions_.back();
  const double whole = inner_product(fresh.step, fresh.step);
  for (std::size_t d = 0; d < n_directions_; ++d) {
    const Direction& known = directions_[d];
    const double along = inner_product(fresh.step, known.step) / known.squared_norm;
    fresh.step -= along * known.step;
    fresh.image -= along * known.image;
  }
  fresh.squared_norm = inner_product(fresh.step, fresh.step);
  if (!(fresh.squared_norm > kLostShare * whole)) return;
  std::rotate(directions_.begin(), directions_.end() - 1, directions_.end());
  n_directions_ = std::min(n_directions_ + 1, kWindow);
}

const LoadedRows* AndersonAcceleration::propose(const VertexRows& image, const VertexRows& load) {
  Direction& fresh = directions_.back();
  std::swap(fresh.step, step_);
  std::swap(fresh.image, image_);
  places(image_) = image;
  loads(image_) = load;
  step_ = image_ - point_;
  if (loads(step_).norm() <= rounding_) {
    start(image_, rounding_);
    return nullptr;
  }
  if (has_round_) {
    fresh.step = step_ - fresh.step;
    fresh.image = image_ - fresh.image;
    add_direction();
  }
  has_round_ = true;
  if (n_directions_ == 0) {
    point_ = image_;
    return nullptr;
  }
  change_.setZero();
  for (std::size_t d = 0; d < n_directions_; ++d) {
    const Direction& known = directions_[d];
    change_ -= inner_product(step_, known.step) / known.squared_norm * known.image;
  }
  return &change_;
}

void AndersonAcceleration::refuse() {
  ++n_refused_;
  n_directions_ = 0;
  point_ = image_;
}

}  // namespace pleat
