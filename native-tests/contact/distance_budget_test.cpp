#include "core/contact/distance_budget.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "native-tests/support/allocation_count.h"
#include "native-tests/support/particle.h"

namespace pleat {
namespace {

/// Sixteen solids of all kinds, most of which turn.
std::vector<Collider> random_solids(Random& random) {
  std::vector<Collider> solids;
  for (int k = 0; k < 14; ++k) {
    RoundedCone cone = random_cone(random);
    const Vec3 way = random_direction(random);
    cone.centre_a += way;
    cone.centre_b += way;
    Collider collider = cone_collider(cone, random.uniform(0, 1));
    const Vec3 velocity = random_direction(random) + Vec3(2, 0, 0);
    collider.motion =
        k % 4 == 0 ? steady_motion(velocity)
                   : turning_motion(random.uniform(0, 8) * random_direction(random), velocity);
    solids.push_back(collider);
  }
  solids.insert(solids.begin() + 3, ball_collider({0, 0, 0}, 0.3, 0.2));
  solids.insert(solids.begin() + 5, floor_collider(0.3));
  return solids;
}

}  // namespace

TEST_CASE("contact: solids that are passed over change no bit", "[contact]") {
  Random random(50);
  const int n_vertices = 60;
  const std::vector<Collider> solids = random_solids(random);
  const ContactOptions options{0.001, Eigen::VectorXd::LinSpaced(n_vertices, 0, 0.02)};
  ContactStage stage(solids, options);
  std::vector<Particle> particles;
  for (int i = 0; i < n_vertices; ++i)
    particles.push_back({2 * random_direction(random), Vec3::Zero()});
  int n_contacts = 0;
  double time = 0;
  for (int k = 0; k < 200; ++k) {
    // Most substeps follow one another, some are long, and some go back in time.
    const double h = k % 20 == 0 ? 0.2 : random.uniform(0.001, 0.01);
    if (k % 50 == 49) time = random.uniform(0, 1);
    ContactStage fresh(solids, options);
    fresh.begin_substep(time, time + h);
    stage.begin_substep(time, time + h);
    for (int i = 0; i < n_vertices; ++i) {
      Particle& particle = particles[static_cast<std::size_t>(i)];
      // Some vertices are where no path has led.
      if (random.below(100) == 0) particle.position = 2 * random_direction(random);
      const Vec3 begin = particle.position;
      particle.velocity += h * (20 * (Vec3(2 * time, 0, 0) - begin) + 3 * random_direction(random));
      particle.position += h * particle.velocity;
      Particle expected = particle;
      const bool met{stage.resolve(VertexId(i), begin, particle.position, particle.velocity)};
      REQUIRE(met == bool(fresh.resolve(VertexId(i), begin, expected.position, expected.velocity)));
      REQUIRE((particle.position == expected.position && particle.velocity == expected.velocity));
      n_contacts += met;
    }
    time += h;
  }
  CHECK(n_contacts > 200);
}

TEST_CASE("contact: a vertex that keeps its distance is looked at once", "[contact]") {
  DistanceBudget budget({{{Vec3(-0.1, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)}, 0.1},
                         {{Vec3(3, 0, 0), Vec3(3, 0, 0), Vec3(3, 0, 0), Vec3(3, 0, 0)}, 0.1}});
  const Vec3 velocity{1.3, 0, 0};
  int n_looks = 0;
  for (int k = 0; k < 1000; ++k) {
    const std::vector<Pose> begin(2, Pose{Mat3::Identity(), 0.01 * k * velocity});
    const std::vector<Pose> end(2, Pose{Mat3::Identity(), 0.01 * (k + 1) * velocity});
    budget.begin_substep(begin, end);
    budget.look_at_near(VertexId(0), Vec3(1, 0, 0) + 0.01 * k * velocity,
                        Vec3(1, 0, 0) + 0.01 * (k + 1) * velocity, [&](std::size_t solid) {
                          ++n_looks;
                          return solid == 0 ? 0.8 : 1.9;
                        });
  }
  CHECK(n_looks == 2);
}

TEST_CASE("contact: a vertex is looked at when its way has used its distance up", "[contact]") {
  const double speed_of_solid = GENERATE(0.0, 1.0);
  CAPTURE(speed_of_solid);
  DistanceBudget budget({{{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, 0.1},
                         {{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, 0.1}});
  // The second solid goes the other way, so that their mean stays.
  const auto pose = [&](double time, double sign) {
    return Pose{Mat3::Identity(), Vec3(sign * speed_of_solid * time, 0, 0)};
  };
  std::vector<int> looks;
  for (int k = 0; k < 100; ++k) {
    const double begin = 0.01 * k;
    const double end = 0.01 * (k + 1);
    budget.begin_substep(std::vector<Pose>{pose(begin, 1), pose(begin, -1)},
                         std::vector<Pose>{pose(end, 1), pose(end, -1)});
    budget.look_at_near(VertexId(0), {2 - begin, 0, 0}, {2 - end, 0, 0}, [&](std::size_t solid) {
      if (solid == 0) looks.push_back(k);
      return 0.505;
    });
  }
  // At 1 m/s 0.505 m last 50 substeps, and half of that when both move.
  REQUIRE(looks.size() >= 2);
  CHECK(looks[0] == 0);
  CHECK(looks[1] == (speed_of_solid == 0 ? 50 : 25));
}

// Seen from a ball that turns, resting vertices run along chords, and come nearer between their
// ends: what the turn takes up counts as what the surface moves, and both are stretched.
TEST_CASE("contact: a vertex is looked at when the turn of a solid asks for it", "[contact]") {
  const double speed = GENERATE(0.0, 0.1);  // [m] per substep
  const double distance = GENERATE(1.75, 2.0);
  CAPTURE(speed, distance);
  const double angle = 0.5;
  const double turn = 2 * std::sin(angle / 2);
  const auto pose = [&](int k) {
    return Pose{Eigen::AngleAxisd(angle * k, Vec3::UnitY()).toRotationMatrix(), Vec3::Zero()};
  };
  DistanceBudget budget({{{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, 1}});
  int next_look = 0;
  for (int k = 0; k < 4; ++k) {
    const double moved = k * (speed + turn) + (speed + turn) / (1 - turn);
    if (next_look == 0 && distance < moved) next_look = k;
    bool looked = false;
    budget.begin_substep(std::vector<Pose>{pose(k)}, std::vector<Pose>{pose(k + 1)});
    budget.look_at_near(VertexId(0), {0, 5, speed * k}, {0, 5, speed * (k + 1)}, [&](std::size_t) {
      looked = true;
      return distance;
    });
    CHECK(looked == (k == 0 || k == next_look));
    if (k == next_look && k > 0) break;
  }
}

TEST_CASE("contact: rounded cones allocate for a new vertex only", "[contact]") {
  if (!counts_allocations()) return;
  Random random(51);
  ContactStage stage(random_solids(random), {0.001, {}});
  Particle particle{{0.5, 0.05, 0}, {-20, 0, 0}};
  step(stage, Vec3(-100, -kGravity, 0), 0, 1 / 60.0, particle);
  CHECK(allocations_in([&] {
          for (int k = 1; k < 50; ++k)
            step(stage, Vec3(-100, -kGravity, 0), k / 60.0, 1 / 60.0, particle);
        }) == 0);
}

}  // namespace pleat
