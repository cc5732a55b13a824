#include "core/dynamics/position_based/levels/gathered_sweeps.h"

namespace pleat {

GatheredSweeps::GatheredSweeps(const ClothModel& model, const LaneLayout& layout, SpringLaw law,
                               double h)
    : springs(model, layout, law, h), bends(model, layout, h), hanging(model, layout, law, h) {}

void GatheredSweeps::refresh_pins(const float* inverse_masses) {
  springs.refresh_pins(inverse_masses);
  bends.refresh_pins(inverse_masses);
}

void GatheredSweeps::refresh_rest_lengths(const ClothModel& model) {
  springs.refresh_rest_lengths(model);
  hanging.refresh_rest_lengths(model);
}

void GatheredSweeps::sweep(GatheredVertices& vertices, const Relaxation& relaxation,
                           bool is_first) {
  const float* const begins = vertices.begins();
  float* const moves = vertices.moves();
  if (is_first) {
    springs.forget();
    bends.forget();
  }
  bends.sweep(begins, moves,
              relaxation.smoother == Smoother::sor ? static_cast<float>(relaxation.omega) : 1.0f);
  springs.sweep(begins, moves, relaxation);
  if (!hanging.empty()) hanging.sweep(vertices.lanes(), is_first);
}

void GatheredSweeps::forget() {
  springs.forget();
  bends.forget();
  hanging.forget();
}

double GatheredSweeps::squared_residual(GatheredVertices& vertices) const {
  const double of_hanging = hanging.squared_residual(vertices.lanes());
  return of_hanging + springs.squared_residual(vertices.begins(), vertices.moves()) +
         bends.squared_residual(vertices.begins(), vertices.moves());
}

}  // namespace pleat
