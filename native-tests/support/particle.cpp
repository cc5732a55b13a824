#include "native-tests/support/particle.h"

#include <array>
#include <cmath>

namespace pleat {
namespace {

class TurningFrame : public MovingFrame {
 public:
  TurningFrame(const Vec3& spin, const Vec3& velocity) : spin_(spin), velocity_(velocity) {}
  Pose pose(double time) const override {
    const double rate = spin_.norm();
    return {Eigen::AngleAxisd(rate * time, spin_ / rate).toRotationMatrix(), time * velocity_};
  }

 private:
  Vec3 spin_;
  Vec3 velocity_;
};

}  // namespace

Collider floor_collider(double friction) {
  Collider collider;
  collider.shape = Plane{};
  collider.friction = friction;
  return collider;
}

Collider ball_collider(const Vec3& centre, double radius, double friction) {
  Collider collider;
  collider.shape = Sphere{centre, radius};
  collider.friction = friction;
  return collider;
}

Collider cone_collider(const RoundedCone& cone, double friction) {
  Collider collider;
  collider.shape = cone;
  collider.friction = friction;
  return collider;
}

Motion turning_motion(const Vec3& spin, const Vec3& velocity) {
  Motion motion;
  motion.kind = Motion::Kind::follow;
  motion.frame = std::make_shared<TurningFrame>(spin, velocity);
  return motion;
}

Motion steady_motion(const Vec3& velocity) {
  constexpr double kLong = 1000;  // [s]
  Motion motion;
  motion.kind = Motion::Kind::move;
  motion.offset = kLong * velocity;
  motion.time_end = kLong;
  return motion;
}

Vec3 random_direction(Random& random) {
  Vec3 direction;
  do {
    direction = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (direction.norm() < 0.1 || direction.norm() > 1);
  return direction.normalized();
}

RoundedCone random_cone(Random& random) {
  const double lengths[] = {0, 1e-7, random.uniform(0, 0.1), random.uniform(0, 0.8)};
  const Vec3 axis = random_direction(random);
  RoundedCone cone;
  cone.centre_a = random.uniform(0, 0.3) * random_direction(random);
  cone.centre_b = cone.centre_a + lengths[random.below(4)] * axis;
  cone.across = axis.unitOrthogonal();
  cone.radius_a = random.uniform(0.02, 0.4);
  cone.radius_b = random.below(3) == 0 ? cone.radius_a : random.uniform(0.02, 0.4);
  if (random.below(2) == 0) return cone;
  cone.half_width_a = random.uniform(0, 0.3);
  cone.half_width_b = random.below(3) == 0 ? cone.half_width_a : random.uniform(0, 0.3);
  return cone;
}

double height(const Collider& collider, const Vec3& place, double time) {
  return gap(swept(ContactPass::placed(collider, time), Clearance{}, Vec3::Zero()), place).distance;
}

bool resolve(ContactPass& pass, VertexId vertex, const Vec3& begin, Vec3& position,
             Vec3& velocity) {
  constexpr int kMostVertices = 4;  // capacity on the stack, as allocations are counted
  using FewPositions = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMostVertices>;
  std::array<char, kMostVertices> is_exempt;
  is_exempt.fill(1);
  is_exempt[static_cast<std::size_t>(vertex)] = 0;
  const int n_vertices = vertex + 1;
  const FewPositions positions_begin = begin.replicate(1, n_vertices);
  FewPositions positions = position.replicate(1, n_vertices);
  FewPositions velocities = velocity.replicate(1, n_vertices);
  const auto touches = pass.resolve(
      positions_begin, std::span(is_exempt).first(static_cast<std::size_t>(n_vertices)), positions,
      velocities);
  position = positions.col(vertex);
  velocity = velocities.col(vertex);
  return !touches.empty();
}

bool step(ContactPass& pass, const Vec3& acceleration, double time, double h, Particle& particle) {
  const Vec3 begin = particle.position;
  particle.velocity += h * acceleration;
  particle.position += h * particle.velocity;
  pass.begin_substep(time, time + h);
  return resolve(pass, VertexId(0), begin, particle.position, particle.velocity);
}

}  // namespace pleat
