#include "core/dynamics/implicit/anderson_acceleration.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "core/base/random.h"

namespace pleat {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index n_rows, Eigen::Index n_columns, Random& random) {
  Eigen::MatrixXd matrix(n_rows, n_columns);
  for (double& entry : matrix.reshaped()) entry = random.uniform(-1, 1);
  return matrix;
}

LoadedRows loaded(const VertexRows& x, const VertexRows& load) {
  LoadedRows rows(x.rows(), 6);
  rows << x, load;
  return rows;
}

/// A g = B x + c, whose rounds shrink the error by four distinct rates, in the norm of A.
struct LinearRounds {
  Eigen::MatrixXd A, B;
  VertexRows c;

  explicit LinearRounds(Random& random) {
    constexpr Eigen::Index kSize = 12;
    const Eigen::MatrixXd root =
        random_matrix(kSize, kSize, random) + 3 * Eigen::MatrixXd::Identity(kSize, kSize);
    const Eigen::MatrixXd Q = random_matrix(kSize, kSize, random).householderQr().householderQ();
    const Eigen::Vector4d rates(0.1, 0.5, 0.9, 0.99);
    A = root * root.transpose();
    B = root * Q * rates.replicate<3, 1>().asDiagonal() * Q.transpose() * root.transpose();
    c = random_matrix(kSize, 3, random);
  }
  LoadedRows point(const VertexRows& x) const { return loaded(x, A * x); }
  LoadedRows image(const VertexRows& x) const {
    const VertexRows load = B * x + c;
    return loaded(A.llt().solve(load), load);
  }
  VertexRows fixed_point() const { return (A - B).llt().solve(c); }
};

}  // namespace

TEST_CASE("anderson_acceleration: rounds of four rates end at the fixed point after five",
          "[dynamics]") {
  Random random(GENERATE(1u, 2u, 3u));
  const LinearRounds rounds(random);
  AndersonAcceleration acceleration(rounds.c.rows());
  VertexRows x = VertexRows::Zero(rounds.c.rows(), 3);
  acceleration.start(rounds.point(x));
  for (int round = 0; round < 5; ++round) {
    CHECK((x - rounds.fixed_point()).norm() > 1e-3 * rounds.fixed_point().norm());
    const LoadedRows image = rounds.image(x);
    const LoadedRows* change = acceleration.propose(places(image), loads(image));
    CHECK((change == nullptr) == (round == 0));
    x = places(image);
    if (change == nullptr) continue;
    CHECK((rounds.A * places(*change) - loads(*change)).norm() < 1e-9 * loads(*change).norm());
    x += places(*change);
    acceleration.accept();
  }
  CHECK((x - rounds.fixed_point()).norm() < 1e-9 * rounds.fixed_point().norm());
  CHECK(acceleration.n_refused() == 0);
}

TEST_CASE("anderson_acceleration: after a refusal rounds before it are forgotten", "[dynamics]") {
  Random random(4);
  const LinearRounds rounds(random);
  AndersonAcceleration refused(rounds.c.rows());
  VertexRows x = VertexRows::Zero(rounds.c.rows(), 3);
  refused.start(rounds.point(x));
  const auto take_round = [&](AndersonAcceleration& acceleration) {
    const LoadedRows image = rounds.image(x);
    return acceleration.propose(places(image), loads(image));
  };
  for (int round = 0; round < 3; ++round) {
    const LoadedRows* change = take_round(refused);
    x = VertexRows(places(rounds.image(x)));
    if (change == nullptr) continue;
    x += places(*change);
    refused.accept();
  }
  AndersonAcceleration fresh(rounds.c.rows());
  fresh.start(rounds.point(x));
  CHECK(take_round(fresh) == nullptr);
  REQUIRE(take_round(refused) != nullptr);
  refused.refuse();
  CHECK(refused.n_refused() == 1);
  x = VertexRows(places(rounds.image(x)));
  const LoadedRows* expected = take_round(fresh);
  const LoadedRows* change = take_round(refused);
  REQUIRE(expected != nullptr);
  REQUIRE(change != nullptr);
  CHECK((*change - *expected).norm() < 1e-9 * expected->norm());
}

TEST_CASE("anderson_acceleration: rounds that stand still propose nothing", "[dynamics]") {
  Random random(5);
  const LinearRounds rounds(random);
  AndersonAcceleration acceleration(rounds.c.rows());
  acceleration.start(rounds.point(rounds.fixed_point()));
  const LoadedRows image = rounds.point(rounds.fixed_point());
  for (int round = 0; round < 3; ++round)
    CHECK(acceleration.propose(places(image), loads(image)) == nullptr);
}

}  // namespace pleat
