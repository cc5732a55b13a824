#include "core/model/air_drag.h"

#include "core/base/check.h"
#include "core/model/hanging_vertices.h"

namespace pleat {

AirDrag::AirDrag(std::vector<Triangle> triangles, const AirOptions& options, int n_vertices,
                 double share)
    : triangles_(std::move(triangles)),
      options_(options),
      share_(share),
      drag_(3, n_vertices),
      resistance_(6, n_vertices) {
  PLEAT_CHECK(share > 0 && share <= 1, "a triangle counts with a positive share of its area");
  PLEAT_CHECK(options.density > 0, "air has a positive density");
  PLEAT_CHECK(options.normal_coefficient >= 0 && options.tangent_coefficient >= 0,
              "drag coefficients are not negative");
  PLEAT_CHECK(options.wind.gust_intensity >= 0 && options.wind.velocity.allFinite(),
              "wind is finite, and its gusts are not negative");
  if (!options.wind.is_still()) wind_.emplace(options.wind);
  set_time(0);
}

void AirDrag::evaluate(const PositionsView& positions, const PositionsView& velocities) {
  drag_.setZero();
  resistance_.setZero();
  for (const Triangle& t : triangles_) {
    const Vec3 x0 = positions.col(t[0]);
    const Vec3 doubled_area = (positions.col(t[1]) - x0).cross(positions.col(t[2]) - x0);
    const double area = 0.5 * doubled_area.norm();
    const Vec3 u =
        wind_velocity_ - (velocities.col(t[0]) + velocities.col(t[1]) + velocities.col(t[2])) / 3;
    const double speed = u.norm();
    if (area == 0 || speed == 0) continue;
    const Vec3 normal = doubled_area / (2 * area);
    // f = R u with R = r [C_t I + (C_n - C_t) n n^T], r = 1/2 rho A |u|.
    const double r = 0.5 * options_.density * strength_ * share_ * area * speed;
    const double tangent = r * options_.tangent_coefficient;
    const double extra = r * (options_.normal_coefficient - options_.tangent_coefficient);
    const Vec3 third = (tangent * u + extra * normal.dot(u) * normal) / 3;
    // d|u|u/du is at most twice |u|, and a corner's own velocity moves u by a third: 2 R / 3 bounds
    // its share of D.
    Eigen::Matrix<double, 6, 1> bound;
    bound << normal.x() * normal.x(), normal.y() * normal.y(), normal.z() * normal.z(),
        normal.x() * normal.y(), normal.x() * normal.z(), normal.y() * normal.z();
    bound *= extra;
    bound.head<3>().array() += tangent;
    for (const VertexId v : t) {
      drag_.col(v) += third;
      resistance_.col(v) += (2.0 / 3) * bound;
    }
  }
}

std::size_t AirDrag::bytes() const {
  const auto n_numbers = static_cast<std::size_t>(drag_.size() + resistance_.size());
  return triangles_.size() * sizeof(Triangle) + n_numbers * sizeof(double);
}

Mat3 AirDrag::resistance(VertexId vertex) const {
  const auto d = resistance_.col(vertex);
  Mat3 resistance;
  resistance << d[0], d[3], d[4], d[3], d[1], d[5], d[4], d[5], d[2];
  return resistance;
}

void AirDrag::add_forces(const PositionsView& positions, const PositionsView& velocities,
                         std::span<const HangingVertex> hanging, PositionsRef forces) {
  evaluate(positions, velocities);
  // S^T D S lumped to its diagonal gives each parent half of a hanging vertex's D.
  pull_to_parents(hanging, drag_);
  pull_to_parents(hanging, resistance_);
  forces += drag_;
}

// Solves F = f - D dv for the drag F at the end of the step: dv = h (F + G)/m makes it
// (I + a) F = f - a G, a = h D/m.
void AirDrag::set_damped_forces(const PositionsView& positions, const PositionsView& velocities,
                                const Eigen::VectorXd& masses,
                                std::span<const HangingVertex> hanging, double h,
                                const PositionsView& others, PositionsRef forces) {
  evaluate(positions, velocities);
  pull_to_parents(hanging, drag_);
  pull_to_parents(hanging, resistance_);
  forces.setZero();
  for (Eigen::Index i = 0; i < drag_.cols(); ++i) {
    if (masses[i] == 0) continue;
    const Mat3 a = h / masses[i] * resistance(VertexId(i));
    forces.col(i) = (Mat3::Identity() + a).inverse() * (drag_.col(i) - a * others.col(i));
  }
}

}  // namespace pleat
