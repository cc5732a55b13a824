#include "core/model/momentum.h"

#include <Eigen/Geometry>

namespace pleat {

Vec3 momentum(const ClothModel& model, const State& state) {
  return state.velocities * model.masses;
}

Vec3 angular_momentum(const ClothModel& model, const State& state) {
  const Vec3 centre = state.positions * model.masses / model.masses.sum();
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    sum += model.masses[i] *
           (Vec3(state.positions.col(i)) - centre).cross(Vec3(state.velocities.col(i)));
  return sum;
}

}  // namespace pleat
