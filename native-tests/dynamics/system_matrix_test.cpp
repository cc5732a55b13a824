#include "core/dynamics/system_matrix.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "native-tests/support/models.h"

namespace pleat {
namespace {

/// A symmetric block, another one for each spring.
Mat3 block_of(std::size_t spring) {
  Random random(100 + spring);
  Mat3 block;
  for (double& value : block.reshaped()) value = random.uniform(-1, 1);
  return block + block.transpose().eval() + 8 * Mat3::Identity();
}

/// Some springs with b before a, as scenes may write them.
ClothModel mixed_model() {
  ClothModel model = sheet_model(square_sheet(3), soft_fabric());
  for (std::size_t s = 0; s < model.springs.size(); s += 2)
    std::swap(model.springs[s].a, model.springs[s].b);
  return model;
}

SystemMatrix assembled(const ClothModel& model) {
  SystemMatrix matrix(model);
  matrix.set_zero();
  matrix.add_masses(model.masses, 2);
  for (std::size_t s = 0; s < model.springs.size(); ++s) matrix.add_spring(s, block_of(s));
  for (std::size_t b = 0; b < model.bends.size(); ++b) matrix.add_bend(b, 3);
  return matrix;
}

/// The same sum, element by element into a dense matrix.
Eigen::MatrixXd expected_sum(const ClothModel& model) {
  const int n = model.n_vertices();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int i = 0; i < n; ++i)
    sum.block<3, 3>(3 * i, 3 * i) += 2 * model.masses[i] * Mat3::Identity();
  for (std::size_t s = 0; s < model.springs.size(); ++s) {
    const int a = 3 * model.springs[s].a;
    const int b = 3 * model.springs[s].b;
    sum.block<3, 3>(a, a) += block_of(s);
    sum.block<3, 3>(b, b) += block_of(s);
    sum.block<3, 3>(a, b) -= block_of(s);
    sum.block<3, 3>(b, a) -= block_of(s);
  }
  for (const BendElement& bend : model.bends)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum.block<3, 3>(3 * bend.vertices[i], 3 * bend.vertices[j]) +=
            3 * bend.stiffness * bend.weights[i] * bend.weights[j] * Mat3::Identity();
  return sum;
}

}  // namespace

TEST_CASE("system_matrix: the assembled matrix is the sum of its elements", "[dynamics]") {
  const ClothModel model = mixed_model();
  const Eigen::MatrixXd expected = expected_sum(model);
  CHECK((dense(assembled(model).lower()) - expected).norm() < 1e-14 * expected.norm());
}

TEST_CASE("system_matrix: a second assembly leaves nothing of the first", "[dynamics]") {
  const ClothModel model = mixed_model();
  SystemMatrix matrix = assembled(model);
  matrix.set_zero();
  matrix.add_masses(model.masses, 1);
  const Eigen::MatrixXd expected = dense(mass_matrix(model));
  CHECK((dense(matrix.lower()) - expected).norm() == 0);
}

TEST_CASE("system_matrix: prescribed vertices are eliminated as in a dense solve", "[dynamics]") {
  const ClothModel model = mixed_model();
  const int n = model.n_vertices();
  Random random(3);
  const std::vector<VertexId> chosen{VertexId(5), VertexId(0), VertexId(6), VertexId(15)};
  const Positions values = shaken(Positions::Zero(3, 4), 1, random);
  const Positions load = shaken(Positions::Zero(3, n), 1, random);
  const Eigen::VectorXd rhs = Eigen::Map<const Eigen::VectorXd>(load.data(), 3 * n);

  // By Lagrange multipliers on the untouched matrix.
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

TEST_CASE("system_matrix: choosing other vertices frees the earlier ones", "[dynamics]") {
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
