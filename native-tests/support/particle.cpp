#include "native-tests/support/particle.h"

namespace pleat {

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

double height(const Collider& collider, const Vec3& place, double time) {
  const auto shape = ContactStage::placed(collider, time);
  if (const auto* plane = std::get_if<Plane>(&shape))
    return plane->normal.dot(place - plane->point);
  const auto& sphere = std::get<Sphere>(shape);
  return (place - sphere.centre).norm() - sphere.radius;
}

bool step(ContactStage& stage, const Vec3& acceleration, double time, double h,
          Particle& particle) {
  const Vec3 begin = particle.position;
  particle.velocity += h * acceleration;
  particle.position += h * particle.velocity;
  stage.begin_substep(time, time + h);
  return stage.resolve(begin, particle.position, particle.velocity);
}

}  // namespace pleat
