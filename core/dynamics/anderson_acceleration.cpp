#include "core/dynamics/anderson_acceleration.h"

#include <algorithm>

namespace pleat {
namespace {

constexpr std::size_t kWindow = 2;

LoadedRows zero_rows(Eigen::Index n_vertices) {
  return {VertexRows::Zero(n_vertices, 3), VertexRows::Zero(n_vertices, 3)};
}

/// sum += factor * term
void add_multiple(double factor, const LoadedRows& term, LoadedRows& sum) {
  sum.places += factor * term.places;
  sum.loads += factor * term.loads;
}

/// Either may be the difference itself.
void set_difference(const LoadedRows& a, const LoadedRows& b, LoadedRows& difference) {
  difference.places = a.places - b.places;
  difference.loads = a.loads - b.loads;
}

/// a . A b [J]
double inner_product(const LoadedRows& a, const LoadedRows& b) {
  return a.places.cwiseProduct(b.loads).sum();
}

}  // namespace

AndersonAcceleration::AndersonAcceleration(Eigen::Index n_vertices)
    : point_(zero_rows(n_vertices)),
      step_(zero_rows(n_vertices)),
      image_(zero_rows(n_vertices)),
      change_(zero_rows(n_vertices)),
      directions_(kWindow + 1, {zero_rows(n_vertices), zero_rows(n_vertices), 0}) {}

void AndersonAcceleration::start(const LoadedRows& point) {
  point_ = point;
  n_directions_ = 0;
  has_round_ = false;
}

/// Makes the newest direction of the room at the end, which holds the differences of step and
/// image.
void AndersonAcceleration::add_direction() {
  constexpr double kLostShare = 1e-14;  // of a squared norm: what is left is rounding
  Direction& fresh = directions_.back();
  const double whole = inner_product(fresh.step, fresh.step);
  for (std::size_t d = 0; d < n_directions_; ++d) {
    const Direction& known = directions_[d];
    const double along = inner_product(fresh.step, known.step) / known.squared_norm;
    add_multiple(-along, known.step, fresh.step);
    add_multiple(-along, known.image, fresh.image);
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
  image_.places = image;
  image_.loads = load;
  set_difference(image_, point_, step_);
  if (has_round_) {
    set_difference(step_, fresh.step, fresh.step);
    set_difference(image_, fresh.image, fresh.image);
    add_direction();
  }
  has_round_ = true;
  if (n_directions_ == 0) {
    point_ = image_;
    return nullptr;
  }
  change_.places.setZero();
  change_.loads.setZero();
  for (std::size_t d = 0; d < n_directions_; ++d) {
    const Direction& known = directions_[d];
    add_multiple(-inner_product(step_, known.step) / known.squared_norm, known.image, change_);
  }
  return &change_;
}

void AndersonAcceleration::accept() {
  point_ = image_;
  add_multiple(1, change_, point_);
}

void AndersonAcceleration::refuse() {
  ++n_refused_;
  n_directions_ = 0;
  point_ = image_;
}

}  // namespace pleat
