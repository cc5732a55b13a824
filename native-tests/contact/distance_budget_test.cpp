#include "core/contact/distance_budget.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
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

const Vec3 kWalk{1.24, 0, 0};  // [m/s]
const Vec3 kHip{0, 0.85, 0};   // [m]

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

}  // namespace

TEST_CASE("contact: solids that are passed over change no bit", "[contact]") {
  Random random(50);
  const int n_vertices = 60;
  const std::vector<Collider> solids = random_solids(random);
  const ContactOptions options{0.001, Eigen::VectorXd::LinSpaced(n_vertices, 0, 0.02)};
  ContactPass pass(solids, options);
  Positions positions(3, n_vertices);
  for (int i = 0; i < n_vertices; ++i) positions.col(i) = 2 * random_direction(random);
  Positions velocities = Positions::Zero(3, n_vertices);
  const std::vector<char> is_exempt(n_vertices, 0);
  std::size_t n_contacts = 0;
  double time = 0;
  for (int k = 0; k < 200; ++k) {
    // Most substeps follow one another, some are long, and some go back in time.
    const double h = k % 20 == 0 ? 0.2 : random.uniform(0.001, 0.01);
    if (k % 50 == 49) time = random.uniform(0, 1);
    ContactPass fresh(solids, options);
    fresh.begin_substep(time, time + h);
    pass.begin_substep(time, time + h);
    for (int i = 0; i < n_vertices; ++i)  // some vertices are where no path has led
      if (random.below(100) == 0) positions.col(i) = 2 * random_direction(random);
    const Positions begin = positions;
    for (int i = 0; i < n_vertices; ++i)
      velocities.col(i) +=
          h * (20 * (Vec3(2 * time, 0, 0) - begin.col(i)) + 3 * random_direction(random));
    positions += h * velocities;
    Positions expected_positions = positions;
    Positions expected_velocities = velocities;
    const auto touches = pass.resolve(begin, is_exempt, positions, velocities);
    const auto expected = fresh.resolve(begin, is_exempt, expected_positions, expected_velocities);
    REQUIRE(touches.size() == expected.size());
    REQUIRE((positions == expected_positions && velocities == expected_velocities));
    n_contacts += touches.size();
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
    budget.visit_near(VertexId(0), Vec3(1, 0, 0) + 0.01 * k * velocity,
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
    budget.visit_near(VertexId(0), {2 - begin, 0, 0}, {2 - end, 0, 0}, [&](std::size_t solid) {
      if (solid == 0) looks.push_back(k);
      return 0.505;
    });
  }
  // A distance of 0.505 m lasts 50 substeps at 1 m/s, and half of that when both move.
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
    budget.visit_near(VertexId(0), {0, 5, speed * k}, {0, 5, speed * (k + 1)}, [&](std::size_t) {
      looked = true;
      return distance;
    });
    CHECK(looked == (k == 0 || k == next_look));
    if (k == next_look && k > 0) break;
  }
}

TEST_CASE("contact: few of sixteen walking limbs are looked at", "[contact]") {
  const int n_vertices = 200;
  const std::vector<Collider> limbs = walking_limbs();
  std::vector<DistanceBudget::Hull> hulls;
  for (const Collider& limb : limbs) {
    const auto& cone = std::get<RoundedCone>(limb.shape);
    hulls.push_back({{cone.centre_a, cone.centre_a, cone.centre_b, cone.centre_b}, cone.radius_a});
  }
  DistanceBudget budget(hulls);
  Random random(60);
  Positions skirt(3, n_vertices);
  for (int i = 0; i < n_vertices; ++i) {
    const double angle = random.uniform(0, 6.283185307179586);
    const double y = random.uniform(0.45, 1);
    const double radius = 0.32 - 0.18 * y;
    skirt.col(i) = Vec3(radius * std::cos(angle), y, (radius + 0.1) * std::sin(angle));
  }
  const double h = 1.0 / 240;
  const int n_substeps = 480;
  int n_looks = 0;
  for (int k = 0; k < n_substeps; ++k) {
    std::vector<Pose> begin;
    std::vector<Pose> end;
    std::vector<SweptSolid> solids;
    for (const Collider& limb : limbs) {
      begin.push_back(limb.motion.pose(k * h));
      end.push_back(limb.motion.pose((k + 1) * h));
      solids.push_back(swept(placed(limb.shape, begin.back()), Clearance{}, Vec3::Zero()));
    }
    budget.begin_substep(begin, end);
    for (int i = 0; i < n_vertices; ++i) {
      const Vec3 from = skirt.col(i) + k * h * kWalk;
      budget.visit_near(VertexId(i), from, from + h * kWalk, [&](std::size_t solid) {
        ++n_looks;
        return gap(solids[solid], from).distance;
      });
    }
  }
  const double share = static_cast<double>(n_looks) / (16.0 * n_vertices * n_substeps);
  CAPTURE(share);
  CHECK(share < 0.05);
}

TEST_CASE("contact: rounded cones allocate for a new vertex only", "[contact]") {
  if (!counts_allocations()) return;
  Random random(51);
  ContactPass pass(random_solids(random), {0.001, {}});
  Particle particle{{0.5, 0.05, 0}, {-20, 0, 0}};
  step(pass, Vec3(-100, -kGravity, 0), 0, 1 / 60.0, particle);
  CHECK(allocations_in([&] {
          for (int k = 1; k < 50; ++k)
            step(pass, Vec3(-100, -kGravity, 0), k / 60.0, 1 / 60.0, particle);
        }) == 0);
}

}  // namespace pleat
