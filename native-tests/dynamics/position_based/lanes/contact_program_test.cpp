#include "core/dynamics/position_based/lanes/contact_program.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "native-tests/support/particle.h"

namespace pleat {
namespace {

constexpr int kVertices = 64;
constexpr double kSubstep = 1e-3;  // [s]

/// Vertices in single precision, one per slot.
struct Lanes {
  LaneLayout layout;
  std::array<std::array<float, kVertices>, 3> begins{}, moves{}, rounded_off{};
  std::array<float, kVertices> inverse_masses{};

  Lanes() {
    layout.n_slots = kVertices;
    for (int i = 0; i < kVertices; ++i) layout.places.push_back({0, i, i});
    inverse_masses.fill(1);
  }
  LaneView view() {
    return {{moves[0].data(), moves[1].data(), moves[2].data()},
            {begins[0].data(), begins[1].data(), begins[2].data()},
            inverse_masses.data()};
  }
  std::array<float*, 3> lows() {
    return {rounded_off[0].data(), rounded_off[1].data(), rounded_off[2].data()};
  }
  void place(std::size_t i, const Particle& particle, const Vec3& origin) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const double local = particle.position[axis] - origin[axis];
      begins[k][i] = static_cast<float>(local);
      rounded_off[k][i] = static_cast<float>(local - begins[k][i]);
      moves[k][i] = static_cast<float>(rounded_off[k][i] + kSubstep * particle.velocity[axis]);
    }
  }
  Vec3 end(std::size_t i, const Vec3& origin) const {
    Vec3 place = origin;
    for (std::size_t k = 0; k < 3; ++k)
      place[static_cast<Eigen::Index>(k)] += static_cast<double>(begins[k][i]) + moves[k][i];
    return place;
  }
  Vec3 velocity(std::size_t i) const {
    Vec3 velocity;
    for (std::size_t k = 0; k < 3; ++k)
      velocity[static_cast<Eigen::Index>(k)] =
          (static_cast<double>(moves[k][i]) - rounded_off[k][i]) / kSubstep;
    return velocity;
  }
};

/// Two limbs that swing, joined by a wide hip, that all go on.
std::vector<Collider> hips_and_thighs(double friction) {
  const Vec3 on(0, 0, 1.5);
  RoundedCone hip{{-0.05, 0.1, 0}, {0.05, 0.1, 0}, 0.12, 0.1};
  hip.across = Vec3::UnitZ();
  hip.half_width_a = 0.05;
  hip.half_width_b = 0.03;
  std::vector<Collider> solids = {
      cone_collider({{-0.1, 0, 0}, {-0.12, -0.4, 0}, 0.09, 0.06}, friction),
      cone_collider({{0.1, 0, 0}, {0.12, -0.4, 0}, 0.09, 0.06}, friction),
      cone_collider(hip, friction)};
  solids[0].motion = turning_motion({6, 1, 0}, on);
  solids[1].motion = turning_motion({-6, 1, 0}, on);
  solids[2].motion = steady_motion(on);
  return solids;
}

}  // namespace

// Single precision, of lengths below a metre.
constexpr double kFloatError = 4e-6;  // [m]

TEST_CASE("contact in lanes: limbs make of ways what they make of them one by one", "[dynamics]") {
  const double friction = GENERATE(0.0, 0.35);
  const bool is_graded = GENERATE(false, true);
  CAPTURE(friction, is_graded);
  Random random(7);
  ContactOptions options{0.001, Eigen::VectorXd::Constant(kVertices, 0.01)};
  if (is_graded)
    for (double& radius : options.face_radii) radius = random.uniform(0.002, 0.02);
  ContactPass pass(hips_and_thighs(friction), options);
  const Vec3 origin(0.1, -0.2, 0.05);
  Lanes lanes;
  ContactProgram program(lanes.layout);
  std::vector<Particle> particles(kVertices);
  for (Particle& particle : particles) {
    const Vec3 aside(random.uniform(-1, 1), 0, random.uniform(-1, 1));
    particle.position = random.uniform(-0.45, 0.25) * kUp + 0.25 * aside.normalized();
    particle.velocity = {0, 0, 1.5};
  }
  program.begin_step(pass, lanes.layout);
  int n_hits = 0;
  int n_left = 0;
  int n_grazing = 0;
  for (int step = 0; step < 200; ++step) {
    pass.begin_substep(step * kSubstep, (step + 1) * kSubstep);
    for (std::size_t i = 0; i < kVertices; ++i) lanes.place(i, particles[i], origin);
    program.place_solids(pass, origin, 0.5);
    const std::vector<int> left = program.resolve(lanes.view(), lanes.lows());
    n_left += static_cast<int>(left.size());
    for (std::size_t i = 0; i < kVertices; ++i) {
      Particle& particle = particles[i];
      const Vec3 begin = particle.position;
      particle.position += kSubstep * particle.velocity;
      const bool hits =
          pass.resolve(VertexId(static_cast<int>(i)), begin, particle.position, particle.velocity)
              .has_value();
      if (std::find(left.begin(), left.end(), static_cast<int>(i)) == left.end()) {
        n_hits += hits ? 1 : 0;
        CAPTURE(step, i, hits);
        const double apart = (lanes.end(i, origin) - particle.position).norm();
        const double velocity_apart = kSubstep * (lanes.velocity(i) - particle.velocity).norm();
        // Held further off by what is rounded, some meet a surface that others just miss.
        if (!hits && velocity_apart > kFloatError) {
          ++n_grazing;
          REQUIRE(apart < 2 * kFloatError);
        } else {
          REQUIRE(apart < kFloatError);
          REQUIRE(velocity_apart < kFloatError);
        }
      }
      // Drawn to the body, and about.
      const Vec3 to_body =
          Vec3(0, particle.position.y(), 1.5 * step * kSubstep) - particle.position;
      particle.velocity += kSubstep * (300 * to_body + 100 * random_direction(random));
    }
  }
  REQUIRE(n_hits > 500);
  REQUIRE(n_left < n_hits / 2);
  REQUIRE(n_grazing < n_hits / 200);
}

}  // namespace pleat
