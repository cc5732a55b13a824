#include "core/dynamics/position_based/levels/gathered_bends.h"

#include "core/dynamics/position_based/spring_law.h"

namespace pleat {

GatheredBends::GatheredBends(const ClothModel& model, const LaneLayout& layout, double h) {
  for (const BendConstraint& bend : bend_constraints(model, h)) {
    if (any_hangs(model, bend.vertices)) continue;
    const auto first = [&](std::size_t k) {
      return 4 * layout.places[static_cast<std::size_t>(bend.vertices[k])].slot;
    };
    Element element{};
    element.before = first(0);
    element.middle = first(1);
    element.after = first(2);
    element.b_0 = static_cast<float>(bend.weights[0]);
    element.b_2 = static_cast<float>(bend.weights[2]);
    element.compliance = bend.compliance;
    elements_.push_back(element);
  }
  multipliers_.resize(4 * elements_.size());
}

void GatheredBends::refresh_pins(const float* inverse_masses) {
  for (Element& e : elements_) {
    const float b_1 = e.b_0 + e.b_2;
    e.w_0 = inverse_masses[e.before / 4] * e.b_0;
    e.w_1 = inverse_masses[e.middle / 4] * b_1;
    e.w_2 = inverse_masses[e.after / 4] * e.b_2;
    e.gain = -1 / (e.w_0 * e.b_0 + e.w_1 * b_1 + e.w_2 * e.b_2 + e.compliance + kRigidCompliance);
  }
}

namespace {

/// C + compliance/h^2 lambda, with C = b_0 (x_0 - x_1) + b_2 (x_2 - x_1).
template <class Element>
Float4 error_of(const Element& e, const float* begins, const float* moves,
                const float* multiplier) {
  const Float4 begin_1 = Float4::load(begins + e.middle);
  const Float4 move_1 = Float4::load(moves + e.middle);
  const Float4 d_0 =
      (Float4::load(begins + e.before) - begin_1) + (Float4::load(moves + e.before) - move_1);
  const Float4 d_2 =
      (Float4::load(begins + e.after) - begin_1) + (Float4::load(moves + e.after) - move_1);
  return Float4::all(e.b_0) * d_0 + Float4::all(e.b_2) * d_2 +
         Float4::all(e.compliance) * Float4::load(multiplier);
}

void add(float* to, float factor, Float4 change) {
  (Float4::load(to) + Float4::all(factor) * change).store(to);
}

}  // namespace

void GatheredBends::sweep(const float* begins, float* moves, float omega) {
  float* multiplier = multipliers_.data();
  for (const Element& e : elements_) {
    const Float4 error = error_of(e, begins, moves, multiplier);
    const Float4 change = Float4::all(omega * e.gain) * error;
    add(multiplier, 1, change);
    add(moves + e.before, e.w_0, change);
    add(moves + e.middle, -e.w_1, change);
    add(moves + e.after, e.w_2, change);
    multiplier += Float4::kLanes;
  }
}

void GatheredBends::errors(const float* begins, const float* moves, float unit,
                           float* errors) const {
  const float lanes[Float4::kLanes] = {1 / unit, 1 / unit, 1 / unit, 0};  // the fourth is unused
  const Float4 inverse = Float4::load(lanes);
  const float* multiplier = multipliers_.data();
  for (const Element& e : elements_) {
    (inverse * error_of(e, begins, moves, multiplier)).store(errors);
    errors += Float4::kLanes;
    multiplier += Float4::kLanes;
  }
}

double GatheredBends::squared_residual(const float* begins, const float* moves) const {
  Float4 sum = Float4::all(0);
  const float* multiplier = multipliers_.data();
  for (const Element& e : elements_) {
    const Float4 error = error_of(e, begins, moves, multiplier);
    sum = sum + error * error;
    multiplier += Float4::kLanes;
  }
  float lanes[Float4::kLanes];
  sum.store(lanes);
  return (static_cast<double>(lanes[0]) + lanes[1]) + lanes[2];  // the fourth is unused
}

}  // namespace pleat
