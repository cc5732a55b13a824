#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "native-tests/support/particle.h"

namespace pleat {
namespace {

constexpr int kVertices = 10000;
constexpr double kStep = 1.0 / 240;  // [s]
const Vec3 kWalk{1.24, 0, 0};        // [m/s]
const Vec3 kHip{0, 0.85, 0};         // [m]

/// A limb that swings about the hip as it walks on.
class SwingingFrame : public MovingFrame {
 public:
  explicit SwingingFrame(double phase) : phase_(phase) {}
  Pose pose(double time) const override {
    const double angle = 0.4 * (std::sin(6 * time + phase_) - std::sin(phase_));  // [rad]
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    return {turn, kHip - turn * kHip + time * kWalk};
  }

 private:
  double phase_;
};

/// Sixteen limbs that hang from one another in four rows.
std::vector<Collider> walking_limbs() {
  std::vector<Collider> limbs;
  for (int k = 0; k < 16; ++k) {
    const double top = 1.45 - 0.35 * (k / 4);
    const double side = 0.12 * (k % 4 - 1.5);
    limbs.push_back(cone_collider({{0, top, side}, {0, top - 0.35, side}, 0.07, 0.05}, 0.3));
    limbs.back().motion.kind = Motion::Kind::follow;
    limbs.back().motion.frame = std::make_shared<SwingingFrame>(k % 4 < 2 ? 0 : 3.14);
  }
  return limbs;
}

/// Median over two seconds [ns per vertex and substep], of vertices on a skirt that springs back to
/// its shape around the limbs.
double cost(ContactStage& stage, bool forgets) {
  Random random(60);
  std::vector<Particle> particles;
  std::vector<Vec3> shape;
  for (int i = 0; i < kVertices; ++i) {
    const double angle = random.uniform(0, 6.283185307179586);
    const double y = random.uniform(0.45, 1);
    const double radius = 0.32 - 0.18 * y;
    shape.emplace_back(radius * std::cos(angle), y, (radius + 0.1) * std::sin(angle));
    particles.push_back({shape.back(), kWalk});
  }
  std::vector<double> times;
  for (int k = 0; k < 480; ++k) {
    std::vector<Vec3> begins;
    for (int i = 0; i < kVertices; ++i) {
      Particle& particle = particles[static_cast<std::size_t>(i)];
      begins.push_back(particle.position);
      const Vec3 target = shape[static_cast<std::size_t>(i)] + (k + 1) * kStep * kWalk;
      particle.velocity +=
          kStep * (400 * (target - particle.position) - 20 * (particle.velocity - kWalk));
      particle.position += kStep * particle.velocity;
    }
    if (forgets) stage.set_options(stage.options());
    const auto begin = std::chrono::steady_clock::now();
    stage.begin_substep(k * kStep, (k + 1) * kStep);
    for (int i = 0; i < kVertices; ++i) {
      Particle& particle = particles[static_cast<std::size_t>(i)];
      stage.resolve(VertexId(i), begins[static_cast<std::size_t>(i)], particle.position,
                    particle.velocity);
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    times.push_back(time.count() / kVertices);
  }
  std::nth_element(times.begin(), times.begin() + 240, times.end());
  return times[240];
}

}  // namespace

TEST_CASE("contact: sixteen limbs cost little for what is away from them", "[.][cost]") {
  const ContactOptions options{0.0005, Eigen::VectorXd::Constant(kVertices, 0.008)};
  ContactStage stage(walking_limbs(), options);
  const double with_budget = cost(stage, false);
  ContactStage forgetful(walking_limbs(), options);
  const double without = cost(forgetful, true);
  ContactStage floor_and_ball({floor_collider(0.3), ball_collider({0, 0.3, 0}, 0.3, 0.3)}, options);
  const double simple = cost(floor_and_ball, false);
  WARN("ns per vertex and substep: 16 limbs " << with_budget << ", each looked at " << without
                                              << "; floor and ball " << simple);
  SUCCEED("printed, not judged");
}

}  // namespace pleat
