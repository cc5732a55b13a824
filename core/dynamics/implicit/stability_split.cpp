#include "core/dynamics/implicit/stability_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kSafety = 0.8;

/// How much an element asks of a vertex [kg]: h^2 k + 2 h c.
struct Demand {
  VertexId vertex;
  double amount;
};

/// Two for a spring, three for a bending element.
using Demands = std::vector<Demand>;

Demands demands_of(const Spring& spring, double h) {
  const double amount = h * h * spring.stiffness + 2 * h * spring.damping;
  return {{spring.a, amount}, {spring.b, amount}};
}

Demands demands_of(const BendElement& bend, double h) {
  double sum = 0;
  for (const double weight : bend.weights) sum += std::abs(weight);
  Demands demands;
  for (std::size_t i = 0; i < bend.vertices.size(); ++i)
    demands.push_back(
        {bend.vertices[i], h * h * bend.stiffness * std::abs(bend.weights[i]) * sum / 2});
  return demands;
}

/// Elements in the order springs, bending elements.
std::vector<Demands> all_demands(const ClothModel& model, double h) {
  std::vector<Demands> all;
  all.reserve(model.springs.size() + model.bends.size());
  for (const Spring& spring : model.springs) all.push_back(demands_of(spring, h));
  for (const BendElement& bend : model.bends) all.push_back(demands_of(bend, h));
  return all;
}

/// Everything of the model but its elements.
ClothModel without_elements(const ClothModel& model) {
  ClothModel bare;
  bare.masses = model.masses;
  bare.hanging = model.hanging;
  bare.damping_direction = model.damping_direction;
  bare.gravity = model.gravity;
  bare.pins = model.pins;
  bare.rest_coordinates = model.rest_coordinates;
  return bare;
}

StabilitySplit split(const ClothModel& model, const std::vector<char>& is_stiff) {
  StabilitySplit parts{without_elements(model), without_elements(model), is_stiff};
  for (std::size_t s = 0; s < model.springs.size(); ++s)
    (is_stiff[s] != 0 ? parts.stiff : parts.soft).springs.push_back(model.springs[s]);
  for (std::size_t b = 0; b < model.bends.size(); ++b)
    (is_stiff[model.springs.size() + b] != 0 ? parts.stiff : parts.soft)
        .bends.push_back(model.bends[b]);
  parts.is_stiff.resize(model.springs.size());
  return parts;
}

/// Says for each element whether it is stiff in substeps of h.
std::vector<char> stiff_elements(const ClothModel& model, double h) {
  PLEAT_CHECK(model.is_plain_spring_lattice(), "springs with quadratic bending alone are split");
  PLEAT_CHECK(h > 0, "a substep is positive");
  const std::vector<Demands> demands = all_demands(model, h);
  std::vector<double> inverse_mass(static_cast<std::size_t>(model.n_vertices()));
  for (int v = 0; v < model.n_vertices(); ++v)
    if (!model.hangs(VertexId(v))) inverse_mass[static_cast<std::size_t>(v)] = 1 / model.masses[v];
  for (const Pin& pin : model.pins) inverse_mass[static_cast<std::size_t>(pin.vertex)] = 0;

  std::vector<double> stiffness(demands.size());
  for (std::size_t e = 0; e < demands.size(); ++e)
    for (const Demand& demand : demands[e])
      stiffness[e] += demand.amount * inverse_mass[static_cast<std::size_t>(demand.vertex)];
  std::vector<std::size_t> order(demands.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stiffness[a] < stiffness[b]; });

  std::vector<char> is_stiff(demands.size(), 0);
  std::vector<double> sums(inverse_mass.size(), 0.0);
  for (const std::size_t e : order) {
    const bool fits = std::all_of(demands[e].begin(), demands[e].end(), [&](const Demand& demand) {
      const auto v = static_cast<std::size_t>(demand.vertex);
      return !model.hangs(demand.vertex) &&
             2 * inverse_mass[v] * (sums[v] + demand.amount) < 4 * kSafety;
    });
    is_stiff[e] = fits ? 0 : 1;
    if (fits)
      for (const Demand& demand : demands[e])
        sums[static_cast<std::size_t>(demand.vertex)] += demand.amount;
  }
  return is_stiff;
}

}  // namespace

StabilitySplit split_by_stability(const ClothModel& model, double h) {
  return split(model, stiff_elements(model, h));
}

double explicit_share(const ClothModel& model, double h) {
  if (model.springs.empty()) return 1;
  const std::vector<char> is_stiff = stiff_elements(model, h);
  const auto end = is_stiff.begin() + static_cast<std::ptrdiff_t>(model.springs.size());
  return static_cast<double>(std::count(is_stiff.begin(), end, char{0})) /
         static_cast<double>(model.springs.size());
}

StabilitySplit split_structural(const ClothModel& model) {
  PLEAT_CHECK(model.is_plain_spring_lattice(), "springs with quadratic bending alone are split");
  const std::vector<Demands> demands = all_demands(model, 1);
  std::vector<char> is_stiff(demands.size(), 0);
  for (std::size_t e = 0; e < demands.size(); ++e) {
    const bool is_taut = e < model.springs.size() && is_structural(model.springs[e].kind);
    const bool hangs = std::any_of(demands[e].begin(), demands[e].end(), [&](const Demand& demand) {
      return model.hangs(demand.vertex);
    });
    is_stiff[e] = is_taut || hangs ? 1 : 0;
  }
  return split(model, is_stiff);
}

}  // namespace pleat
