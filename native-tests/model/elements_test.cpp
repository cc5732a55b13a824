#include "core/model/elements.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "native-tests/support/finite_difference.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

constexpr double kThird = 1.0 / 3;  // edge of the small sheet [m]

/// A dense matrix that elements put their blocks in.
class DenseBlocks {
 public:
  template <class Kind>
  DenseBlocks(const Kind& kind, Eigen::Index n_vertices)
      : matrix_(Eigen::MatrixXd::Zero(3 * n_vertices, 3 * n_vertices)) {
    kind.for_each_pair([this](VertexId a, VertexId b) { pairs_.push_back({a, b}); });
  }

  void add_difference(VertexId a, VertexId b, const Mat3& block) {
    const auto pair = next_pair();
    REQUIRE(pair == std::array{a, b});
    at(a, a) += block;
    at(b, b) += block;
    at(a, b) -= block;
    at(b, a) -= block.transpose();
  }
  void skip_pair() { ++n_taken_; }
  template <std::size_t n>
  void add_element(const std::array<VertexId, n>& vertices,
                   const Eigen::Matrix<double, 3 * n, 3 * n>& block) {
    n_taken_ += n * (n - 1) / 2;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        at(vertices[i], vertices[j]) += block.template block<3, 3>(3 * i, 3 * j);
  }
  void add_to_diagonal(VertexId vertex, double factor) {
    at(vertex, vertex) += factor * Mat3::Identity();
  }
  void add_to_pair(double factor) {
    const auto [a, b] = next_pair();
    at(a, b) += factor * Mat3::Identity();
    at(b, a) += factor * Mat3::Identity();
  }

  bool has_taken_all() const { return n_taken_ == pairs_.size(); }
  const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  std::array<VertexId, 2> next_pair() {
    REQUIRE(n_taken_ < pairs_.size());
    return pairs_[n_taken_++];
  }
  Eigen::Block<Eigen::MatrixXd, 3, 3> at(VertexId row, VertexId column) {
    return matrix_.block<3, 3>(3 * row, 3 * column);
  }

  std::vector<std::array<VertexId, 2>> pairs_;
  std::size_t n_taken_ = 0;
  Eigen::MatrixXd matrix_;
};

template <class Kind>
Eigen::MatrixXd matrix_of(const Kind& kind, const Positions& x, const MatrixShares& shares) {
  DenseBlocks blocks(kind, x.cols());
  kind.add_to_matrix(x, shares, blocks);
  REQUIRE(blocks.has_taken_all());
  return blocks.matrix();
}

template <class Kind>
double energy(const Kind& kind, const Eigen::VectorXd& x) {
  double sum = 0;
  kind.add_energy(columns(x), sum);
  return sum;
}

template <class Kind>
Eigen::VectorXd forces(const Kind& kind, const Eigen::VectorXd& x) {
  Positions sum = Positions::Zero(3, x.size() / 3);
  kind.add_forces(columns(x), sum);
  return flat(sum);
}

template <class Kind>
Eigen::VectorXd damping_forces(const Kind& kind, const Positions& x, const Eigen::VectorXd& v) {
  Positions sum = Positions::Zero(3, x.cols());
  kind.add_damping_forces(x, columns(v), sum);
  return flat(sum);
}

}  // namespace

TEST_CASE("elements: each kind alone has its own derivatives", "[model]") {
  Random random(GENERATE(1, 2, 3));
  const QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  const ClothModel model = model_of_everything(mesh, library_fabric("wool"));
  const Positions x = shaken(mesh.rest_positions(), 0.2 * kThird, random);
  const double step = difference_step(kThird);
  int kind_number = 0;
  for_each_element_kind(model, [&](const auto& kind) {
    CAPTURE(kind_number++);
    REQUIRE_FALSE(kind.empty());
    const Eigen::VectorXd gradient = difference_gradient(
        [&](const Eigen::VectorXd& y) { return energy(kind, y); }, flat(x), step);
    REQUIRE(gradient.norm() > 0);
    CHECK(relative_error(-forces(kind, flat(x)), gradient) < 1e-7);
    const Eigen::MatrixXd jacobian = difference_jacobian(
        [&](const Eigen::VectorXd& y) { return forces(kind, y); }, flat(x), step);
    const Eigen::MatrixXd stiffness = matrix_of(kind, x, {1, 0, ElementHessian::exact});
    CHECK(relative_error(stiffness, -jacobian) < 1e-6);
    const Eigen::MatrixXd drag_jacobian = difference_jacobian(
        [&](const Eigen::VectorXd& v) { return damping_forces(kind, x, v); },
        flat(shaken(Positions::Zero(3, x.cols()), 1, random)), difference_step(1));
    const Eigen::MatrixXd damping = matrix_of(kind, x, {0, 1, ElementHessian::exact});
    CHECK(relative_error(damping, -drag_jacobian) < 1e-8);
  });
  CHECK(kind_number == 8);
}

TEST_CASE("elements: each kind's projected stiffness is positive", "[model]") {
  Random random(GENERATE(5, 6));
  const QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  const ClothModel model = model_of_everything(mesh, library_fabric("wool"));
  const Positions x = shaken(mesh.rest_positions(), 0.2 * kThird, random);
  int kind_number = 0;
  for_each_element_kind(model, [&](const auto& kind) {
    CAPTURE(kind_number++);
    const Eigen::MatrixXd K = matrix_of(kind, x, {1, 0, ElementHessian::projected});
    const Eigen::VectorXd values = K.selfadjointView<Eigen::Lower>().eigenvalues();
    CHECK(values[0] > -1e-12 * values.tail<1>()[0]);
  });
}

TEST_CASE("elements: an element that leaves the model is refused, whatever its kind", "[model]") {
  const QuadMesh mesh = sheet_with_aspect(3, 3, 1.2);
  const ClothModel model = model_of_everything(mesh, library_fabric("wool"));
  REQUIRE_NOTHROW(model.validate());
  const VertexId missing(mesh.n_vertices());
  ClothModel broken = model;
  SECTION("spring") { broken.springs.back().a = missing; }
  SECTION("taut spring") { broken.taut_springs.back().b = missing; }
  SECTION("bend") { broken.bends.back().vertices[2] = missing; }
  SECTION("chord") { broken.chord_bends.back().a = missing; }
  SECTION("membrane") { broken.membrane.elements.back().vertices[0] = missing; }
  SECTION("hinge") { broken.hinges.back().vertices[3] = missing; }
  SECTION("fitted bending") { broken.fitted_bending.resize(missing + 1, missing + 1); }
  CHECK_THROWS_AS(broken.validate(), ContractError);
}

}  // namespace pleat
