#include "core/model/system_matrix.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// Some springs with b before a, as scenes may write them.
ClothModel mixed_model() {
  ClothModel model = sheet_model(square_sheet(3), soft_fabric());
  for (std::size_t s = 0; s < model.springs.size(); s += 2)
    std::swap(model.springs[s].a, model.springs[s].b);
  return model;
}

Positions moved_positions(const ClothModel& model) {
  Random random(7);
  QuadMesh mesh = square_sheet(3);
  REQUIRE(mesh.n_vertices() == model.n_vertices());
  return shaken(mesh.rest_positions(), 0.1, random);
}

/// 2 M + 3 K + 5 C.
SystemMatrix assembled(const ClothModel& model) {
  SystemMatrix matrix(model);
  matrix.set_zero();
  matrix.add_masses(2);
  matrix.add_elasticity(moved_positions(model), 3, 5, ElementHessian::exact);
  return matrix;
}

/// Sums element by element into a dense matrix.
Eigen::MatrixXd expected_sum(const ClothModel& model) {
  const int n = model.n_vertices();
  const Positions x = moved_positions(model);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int i = 0; i < n; ++i)
    sum.block<3, 3>(3 * i, 3 * i) += 2 * model.masses[i] * Mat3::Identity();
  for (const Spring& spring : model.springs) {
    const SpringAxis axis = spring_axis(spring, x);
    const Mat3 block = 3 * spring_stiffness(spring, axis, ElementHessian::exact) +
                       5 * spring_damping(spring, axis, model.damping_direction);
    const int a = 3 * spring.a;
    const int b = 3 * spring.b;
    sum.block<3, 3>(a, a) += block;
    sum.block<3, 3>(b, b) += block;
    sum.block<3, 3>(a, b) -= block;
    sum.block<3, 3>(b, a) -= block;
  }
  for (const BendElement& bend : model.bends)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum.block<3, 3>(3 * bend.vertices[i], 3 * bend.vertices[j]) +=
            3 * bend.stiffness * bend.weights[i] * bend.weights[j] * Mat3::Identity();
  return sum;
}

}  // namespace

TEST_CASE("system_matrix: the assembled matrix is the sum of its elements", "[model]") {
  const ClothModel model = mixed_model();
  const Eigen::MatrixXd expected = expected_sum(model);
  CHECK((dense(assembled(model).lower()) - expected).norm() < 1e-14 * expected.norm());
}

TEST_CASE("system_matrix: a second assembly leaves nothing of the first", "[model]") {
  const ClothModel model = mixed_model();
  SystemMatrix matrix = assembled(model);
  matrix.set_zero();
  matrix.add_masses(1);
  const Eigen::MatrixXd expected = dense(mass_matrix(model));
  CHECK((dense(matrix.lower()) - expected).norm() == 0);
}

TEST_CASE("system_matrix: vertices that it joins have a block between them", "[model]") {
  const ClothModel model = mixed_model();
  const VertexId a(2);
  const VertexId b(model.n_vertices() - 1);
  SystemMatrix matrix(model);
  CHECK_FALSE(matrix.joins(a, b));
  matrix.join(std::vector<std::array<VertexId, 2>>{{b, a}, {a, b}});
  CHECK(matrix.joins(a, b));
  CHECK(matrix.joins(b, a));
  matrix.add_masses(2);
  matrix.add_elasticity(moved_positions(model), 3, 5, ElementHessian::exact);
  Mat3 block;
  block << 4, 1, 2, 1, 5, 3, 2, 3, 6;
  matrix.add_between(b, a, block);
  Eigen::MatrixXd expected = expected_sum(model);
  expected.block<3, 3>(3 * a, 3 * b) += block;
  expected.block<3, 3>(3 * b, 3 * a) += block;
  CHECK((dense(matrix.lower()) - expected).norm() < 1e-14 * expected.norm());
  matrix.join({});
  CHECK_FALSE(matrix.joins(a, b));
  CHECK(matrix.lower().nonZeros() == SystemMatrix(model).lower().nonZeros());
}

TEST_CASE("system_matrix: prescribed vertices are eliminated as in a dense solve", "[model]") {
  const ClothModel model = mixed_model();
  const int n = model.n_vertices();
  Random random(3);
  const std::vector<VertexId> chosen{VertexId(5), VertexId(0), VertexId(6), VertexId(15)};
  const Positions values = shaken(Positions::Zero(3, 4), 1, random);
  const Positions load = shaken(Positions::Zero(3, n), 1, random);
  const Eigen::VectorXd rhs = Eigen::Map<const Eigen::VectorXd>(load.data(), 3 * n);

  // The expected solution, by Lagrange multipliers on the untouched matrix.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n + 12, 3 * n + 12);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(3 * n + 12);
  A.topLeftCorner(3 * n, 3 * n) = expected_sum(model);
  b.head(3 * n) = rhs;
  for (int k = 0; k < 4; ++k) {
    A.block<3, 3>(3 * n + 3 * k, 3 * chosen[static_cast<std::size_t>(k)]).setIdentity();
    A.block<3, 3>(3 * chosen[static_cast<std::size_t>(k)], 3 * n + 3 * k).setIdentity();
    b.segment<3>(3 * n + 3 * k) = values.col(k);
  }
  const Eigen::VectorXd expected = A.partialPivLu().solve(b).head(3 * n);

  SystemMatrix matrix = assembled(model);
  matrix.choose_prescribed(chosen);
  Eigen::VectorXd moved_rhs = rhs;
  matrix.prescribe(values, moved_rhs);
  const Eigen::VectorXd found = dense(matrix.lower()).ldlt().solve(moved_rhs);
  CHECK((found - expected).norm() < 1e-12 * expected.norm());
  for (int k = 0; k < 4; ++k)
    CHECK((found.segment<3>(3 * chosen[static_cast<std::size_t>(k)]) - values.col(k)).norm() <
          1e-14);
}

TEST_CASE("system_matrix: choosing other vertices frees the earlier ones", "[model]") {
  const ClothModel model = mixed_model();
  SystemMatrix matrix = assembled(model);
  matrix.choose_prescribed({VertexId(1), VertexId(2)});
  matrix.choose_prescribed({});
  Eigen::VectorXd rhs = Eigen::VectorXd::Ones(3 * model.n_vertices());
  matrix.prescribe(Positions(3, 0), rhs);
  CHECK(rhs == Eigen::VectorXd::Ones(3 * model.n_vertices()));
  const Eigen::MatrixXd expected = expected_sum(model);
  CHECK((dense(matrix.lower()) - expected).norm() < 1e-14 * expected.norm());
}

}  // namespace pleat
