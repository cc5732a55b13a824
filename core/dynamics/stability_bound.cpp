#include "core/dynamics/stability_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/check.h"
#include "core/dynamics/stepper_table.h"
#include "core/fabric/taut_springs.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

constexpr double kStepShare = 0.9;  // of the bound, used when the substeps are ours to choose

[[noreturn]] void refuse(const char* format, double bound, double found, double enough) {
  char sentence[200];
  std::snprintf(sentence, sizeof sentence, format, bound, found, enough);
  throw InputError("/method/substeps", sentence);
}

/// Half of what the rows of K and C around each vertex add up to: k and c of a spring count once at
/// each end.
struct VertexSums {
  Eigen::VectorXd stiffness;  // [N/m]
  Eigen::VectorXd damping;    // [N s/m]
};

/// The largest that either law reaches, at any chord [N/m].
double largest_stiffness(const ChordBend& bend) {
  return bend.law == ChordLaw::linear ? bend.stiffness : bend.stiffness / std::pow(bend.length, 3);
}

void add_springs(const std::vector<Spring>& springs, VertexSums& sums) {
  for (const Spring& spring : springs) {
    for (const VertexId v : {spring.a, spring.b}) {
      sums.stiffness[v] += spring.stiffness;
      sums.damping[v] += spring.damping;
    }
  }
}

void add_bends(const ClothModel& model, VertexSums& sums) {
  for (const BendElement& bend : model.bends) {
    const auto& w = bend.weights;
    const double sum = std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]);
    for (int k = 0; k < 3; ++k)
      sums.stiffness[bend.vertices[k]] += bend.stiffness * std::abs(w[k]) * sum / 2;
  }
  for (const ChordBend& bend : model.chord_bends)
    for (const VertexId v : {bend.a, bend.b}) sums.stiffness[v] += largest_stiffness(bend);
  const SparseMatrix& bending = model.fitted_bending;
  for (int column = 0; column < bending.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(bending, column); entry; ++entry) {
      const double half = std::abs(entry.value()) / 2;
      sums.stiffness[column] += half;
      if (entry.row() != column) sums.stiffness[entry.row()] += half;
    }
  }
}

/// The material part of an unstrained element's stiffness: its shape lies in the gradients.
Eigen::Matrix<double, 9, 9> rest_stiffness(const MembraneLaw& law, MembraneElement element) {
  const Eigen::Matrix2d ends = element.gradients.bottomRows<2>().inverse();  // columns x1, x2
  Positions positions = Positions::Zero(3, 3);
  positions.topRightCorner<2, 2>() = ends;
  element.vertices = {VertexId(0), VertexId(1), VertexId(2)};
  return membrane_viscosity(law, element, positions);
}

/// The norm of a block does not change when the element turns, and stretched by a few per cent it
/// hardly does.
void add_membrane(const ClothModel& model, VertexSums& sums) {
  const Membrane& membrane = model.membrane;
  const double stiffening = membrane.law.stiffening_strain > 0 ? kTautFactor : 1;
  for (const MembraneElement& element : membrane.elements) {
    const Eigen::Matrix<double, 9, 9> material = rest_stiffness(membrane.law, element);
    for (int i = 0; i < 3; ++i) {
      double row = 0;
      for (int j = 0; j < 3; ++j) row += material.block<3, 3>(3 * i, 3 * j).norm();
      sums.stiffness[element.vertices[i]] += stiffening * row / 2;
      sums.damping[element.vertices[i]] += model.membrane_relaxation * row / 2;
    }
  }
}

}  // namespace

double largest_stable_step(const ClothModel& model) {
  VertexSums sums{Eigen::VectorXd::Zero(model.n_vertices()),
                  Eigen::VectorXd::Zero(model.n_vertices())};
  add_springs(model.springs, sums);
  add_springs(model.taut_springs, sums);
  add_bends(model, sums);
  add_membrane(model, sums);
  // A row of S^T K S adds up to at most what S^T makes of the sums, as rows of S add up to 1.
  pull_to_parents(model.hanging, sums.stiffness.transpose());
  pull_to_parents(model.hanging, sums.damping.transpose());
  // h^2 k + 2 h c = 2 m has the positive root h = 2 m / (c + sqrt(c^2 + 2 m k)).
  double bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i < model.n_vertices(); ++i) {
    const double c = sums.damping[i];
    const double root = c + std::sqrt(c * c + 2 * model.masses[i] * sums.stiffness[i]);
    if (root > 0) bound = std::min(bound, 2 * model.masses[i] / root);
  }
  return bound;
}

int stable_substeps(const ClothModel& model, const MethodOptions& options) {
  if (!model.hinges.empty())
    throw InputError("/model/bending", std::string("expected fitted or none with ") +
                                           options.stepper->name + ", got hinge");
  const double bound = largest_stable_step(model);
  const double enough = std::max(1.0, std::ceil(options.step / (kStepShare * bound)));
  if (options.substeps > 0) {
    const double h = options.step / options.substeps;
    if (h <= bound) return options.substeps;
    refuse(
        "expected substeps of at most %.3g s, the stability bound of this cloth, got %.3g "
        "s (%.7g substeps would do)",
        bound, h, enough);
  }
  if (enough <= kMaxSubsteps) return static_cast<int>(enough);
  refuse(
      "expected cloth that is stable in substeps of %.3g s, got one that needs %.3g s "
      "(%.7g substeps)",
      options.step / kMaxSubsteps, bound, enough);
}

}  // namespace pleat
