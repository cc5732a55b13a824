#include "core/dynamics/position_based/levels/coarse_levels.h"

#include <algorithm>

#include "core/base/simd.h"

namespace pleat {
namespace {

/// Share of its correction that a level hands back. All of it throws cloth that lies on a solid
/// (docs/methods/multigrid.md).
constexpr double kShare = 0.5;

/// Sweeps of the coarsest level where lengths follow strains: it is small, and is all but solved.
constexpr int kCoarsestSweeps = 16;

/// Sums of masses as the transfer hands them on.
std::vector<double> coarse_masses(const Transfer& transfer, const std::vector<double>& masses,
                                  int n_coarse) {
  std::vector<double> sums(static_cast<std::size_t>(n_coarse), 0);
  for (int row = 0; row < transfer.n_rows(); ++row)
    for (std::int32_t i = transfer.begin[static_cast<std::size_t>(row)];
         i < transfer.begin[static_cast<std::size_t>(row) + 1]; ++i) {
      const auto& [coarse, weight] = transfer.terms[static_cast<std::size_t>(i)];
      sums[coarse] += weight * masses[static_cast<std::size_t>(row)];
    }
  return sums;
}

std::vector<PlaceLength> lengths_of(const MeshLevel& level, LevelLengths lengths) {
  std::vector<PlaceLength> all;
  for (const LevelEdge& edge : level.edges)
    all.push_back(
        {{edge.a, edge.b}, lengths == LevelLengths::surface ? edge.geodesic : edge.chord});
  return all;
}

}  // namespace

// Rows to vertices that do not move have nothing to hand back to.
template <class Quad>
void CoarseLevels<Quad>::take_rows(const Transfer& transfer, const FinerLevel& finer,
                                   Level& level) {
  for (std::size_t row = 0; row < finer.places.size(); ++row) {
    if (finer.inverse_masses[row] == 0) continue;
    level.targets.push_back(finer.places[row]);
    for (auto i = transfer.begin[row]; i < transfer.begin[row + 1]; ++i) {
      const auto& [coarse, weight] = transfer.terms[static_cast<std::size_t>(i)];
      level.columns.push_back(4 * coarse);
      level.weights.push_back(static_cast<Real>(weight));
    }
    level.row_ends.push_back(static_cast<int>(level.columns.size()));
  }
}

// Each round makes a level of the next finer one: the rows by which it hands corrections back, the
// vertices that it copies, their masses, and its lengths. A vertex that does not move hands no mass
// on and takes none: its coarse copy does not move either.
template <class Quad>
CoarseLevels<Quad>::CoarseLevels(const MeshHierarchy& hierarchy, const std::vector<int>& places,
                                 const std::vector<double>& inverse_masses, LevelLengths lengths)
    : share_(static_cast<Real>(lengths == LevelLengths::error ? 1 : kShare)) {
  std::vector<double> masses;
  for (const double w : inverse_masses) masses.push_back(w > 0 ? 1 / w : 0);
  FinerLevel finer{{}, inverse_masses};
  for (const int place : places) finer.places.push_back(4 * place);
  for (std::size_t k = 1; k < hierarchy.levels.size(); ++k) {
    const std::vector<VertexId>& fine = hierarchy.levels[k - 1].vertices;
    const MeshLevel& mesh = hierarchy.levels[k];
    const Transfer& transfer = hierarchy.levels[k - 1].from_coarser;
    Level level;
    take_rows(transfer, finer, level);
    masses = coarse_masses(transfer, masses, mesh.n_vertices());
    FinerLevel next;
    auto at = fine.begin();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      at = std::lower_bound(at, fine.end(), mesh.vertices[i]);
      const auto source = static_cast<std::size_t>(at - fine.begin());
      level.sources.push_back(finer.places[source]);
      next.places.push_back(4 * static_cast<int>(i));
      next.inverse_masses.push_back(finer.inverse_masses[source] > 0 ? 1 / masses[i] : 0);
    }
    std::vector<double> with_nobody = next.inverse_masses;
    with_nobody.push_back(0);
    level.lengths = LengthGroups<Quad>(
        lengths_of(mesh, lengths), with_nobody,
        lengths == LevelLengths::surface ? LengthSide::longer : LengthSide::both);
    for (std::vector<Real>* array : {&level.begins, &level.moves, &level.corrections})
      array->resize(4 * with_nobody.size(), 0);
    levels_.push_back(std::move(level));
    finer = std::move(next);
  }
}

template <class Quad>
CoarseLevels<Quad>::CoarseLevels(const MeshHierarchy& hierarchy, const std::vector<int>& places,
                                 const std::vector<double>& inverse_masses,
                                 const StrainedEdges& finest, const Positions& rest)
    : CoarseLevels(hierarchy, places, inverse_masses, LevelLengths::error) {
  StrainedEdges finer = finest;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const MeshLevel& mesh = hierarchy.levels[k + 1];
    Level& level = levels_[k];
    StrainedEdges edges{{}, level.lengths.strain_places()};
    for (const LevelEdge& edge : mesh.edges)
      edges.ends.push_back({mesh.vertices[edge.a], mesh.vertices[edge.b]});
    level.from_finer = strain_rows(edges, finer, rest);
    level.strains.resize(level.lengths.n_strains(), 0);
    finer = std::move(edges);
  }
}

template <class Quad>
void CoarseLevels<Quad>::correct(const Real* begins, Real* moves, const CycleSmoothing& smoothing,
                                 const Real* strains, Real growth) {
  if (!levels_.empty()) correct_level(0, begins, moves, smoothing, strains, growth);
}

template <class Quad>
int CoarseLevels<Quad>::n_sweeps(std::size_t k) const {
  return is_by_error() && k + 1 == levels_.size() ? kCoarsestSweeps : 1;
}

template <class Quad>
int CoarseLevels<Quad>::n_projections(const CycleSmoothing& smoothing) const {
  int n = 0;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    if (smoothing.before.smoother != Smoother::none) n += levels_[k].lengths.n_lengths();
    if (smoothing.after.smoother != Smoother::none)
      n += n_sweeps(k) * levels_[k].lengths.n_lengths();
  }
  return n;
}

template <class Quad>
void CoarseLevels<Quad>::correct_level(std::size_t k, const Real* begins, Real* moves,
                                       const CycleSmoothing& smoothing, const Real* strains,
                                       Real growth) {
  Level& level = levels_[k];
  for (std::size_t i = 0; i < level.sources.size(); ++i) {
    const int source = level.sources[i];
    Quad::load(begins + source).store(&level.begins[4 * i]);
    const Quad move = Quad::load(moves + source);
    move.store(&level.moves[4 * i]);
    move.store(&level.corrections[4 * i]);
  }
  const bool is_coarsest = k + 1 == levels_.size();
  if (is_by_error()) {
    level.from_finer.apply(strains, level.strains.data());
    level.lengths.aim_at(level.begins.data(), level.moves.data(), level.strains.data());
  }
  level.lengths.sweep(level.begins.data(), level.moves.data(), smoothing.before, growth);
  if (is_by_error() && !is_coarsest)
    level.lengths.strains(level.begins.data(), level.moves.data(), level.strains.data());
  if (!is_coarsest)
    correct_level(k + 1, level.begins.data(), level.moves.data(), smoothing, level.strains.data(),
                  growth);
  for (int sweep = n_sweeps(k); sweep > 0; --sweep)
    level.lengths.sweep(level.begins.data(), level.moves.data(), smoothing.after, growth);

  const Quad share = Quad::all(share_);
  for (std::size_t i = 0; i < level.moves.size(); i += 4)
    (share * (Quad::load(&level.moves[i]) - Quad::load(&level.corrections[i])))
        .store(&level.corrections[i]);
  int term = 0;
  for (std::size_t row = 0; row < level.targets.size(); ++row) {
    Real* const target = moves + level.targets[row];
    Quad sum = Quad::load(target);
    for (; term < level.row_ends[row]; ++term)
      sum = sum + Quad::all(level.weights[static_cast<std::size_t>(term)]) *
                      Quad::load(&level.corrections[static_cast<std::size_t>(
                          level.columns[static_cast<std::size_t>(term)])]);
    sum.store(target);
  }
}

template class CoarseLevels<Float4>;
template class CoarseLevels<Double4>;

}  // namespace pleat
