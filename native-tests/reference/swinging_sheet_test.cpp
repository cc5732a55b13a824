#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/dynamics/stepper_table.h"
#include "core/reference/rigid_chain.h"
#include "core/run/simulation.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr int kRows = 8;
constexpr double kHalfPi = 1.5707963267948966;

/// Fine cotton of 1 m x 1 m, limp, let go from the horizontal.
Scene limp_sheet(const MethodOptions& method) {
  Scene scene = released_sheet_scene(kRows, "fine cotton");
  scene.model.bending = BendingModel::none;
  scene.method = method;
  return scene;
}

/// Chain of as many rigid links as the sheet has rows, the last node with half the mass.
RigidChain sheet_chain() {
  std::vector<double> masses(kRows, 1.0 / kRows);
  masses.back() /= 2;
  RigidChain chain(std::vector<double>(kRows, 1.0 / kRows), masses, 9.81);
  chain.place(Eigen::VectorXd::Constant(kRows, kHalfPi), Eigen::VectorXd::Zero(kRows));
  return chain;
}

/// Distances between the sheet's vertices and their row's node of the chain [m].
struct Distance {
  double largest = 0;
  double rms = 0;  // weighted by mass, like the error of positions
};

/// The sheet swings in the plane of z and y.
Distance distance(const Simulation& simulation, const RigidChain& chain) {
  const Eigen::Matrix2Xd nodes = chain.positions();
  const Positions& x = simulation.state().positions;
  const Eigen::VectorXd& masses = simulation.model().masses;
  Distance result;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Eigen::Index row = i / (kRows + 1);
    const double apart = std::hypot(x(2, i) - nodes(0, row), x(1, i) - nodes(1, row));
    result.largest = std::max(result.largest, apart);
    result.rms += masses[i] / masses.sum() * apart * apart;
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

/// How far the sheet is from the chain after each of 60 steps of 1/60 s.
std::vector<Distance> distances(const MethodOptions& method) {
  constexpr int kChainSteps = 40;  // steps of the chain per step
  Simulation simulation(limp_sheet(method));
  RigidChain chain = sheet_chain();
  std::vector<Distance> course;
  for (int s = 1; s <= 60; ++s) {
    REQUIRE(simulation.step().ok());
    chain.advance(method.step, kChainSteps);
    course.push_back(distance(simulation, chain));
  }
  return course;
}

}  // namespace

TEST_CASE("swinging sheet: with fine steps it is the chain of rigid links within 2 mm", "[run]") {
  // Symplectic Euler at its stability bound, some hundred microseconds.
  double largest = 0;
  for (const Distance& apart : distances(everyday_methods()[0]))
    largest = std::max(largest, apart.largest);
  CHECK(largest < 0.002);
}

TEST_CASE("swinging sheet: every stepper stays as near to the chain as it is known to", "[run]") {
  struct Known {
    const StepperType* stepper;
    int substeps, iterations;
    double half, one;  // measured RMS distances at 0.5 s and 1 s [m]
  };
  const auto known = GENERATE(values<Known>({{&steppers::kExplicitEuler, 0, 1, 0.00055, 0.00026},
                                             {&steppers::kImplicitEuler, 1, 1, 0.289, 0.593},
                                             {&steppers::kImplicitEuler, 16, 1, 0.0240, 0.1072},
                                             {&steppers::kProjective, 1, 10, 0.535, 0.741},
                                             {&steppers::kProjective, 16, 10, 0.0465, 0.0673},
                                             {&steppers::kXpbd, 30, 1, 0.0020, 0.0120},
                                             {&steppers::kXpbd, 100, 1, 0.0010, 0.0039}}));
  MethodOptions method;
  method.stepper = known.stepper;
  method.substeps = known.substeps;
  method.iterations = known.iterations;
  method.solver = SolverKind::eigen;
  const std::vector<Distance> course = distances(method);
  WARN(known.stepper->name << ", steps of 1/60 s, " << known.substeps << " substeps, "
                           << known.iterations << " iterations: " << 1000 * course[29].rms
                           << " mm at 0.5 s, " << 1000 * course[59].rms << " mm at 1 s");
  constexpr double kMargin = 1.2;
  CHECK(course[29].rms < kMargin * known.half);
  CHECK(course[59].rms < kMargin * known.one);
}

}  // namespace pleat
