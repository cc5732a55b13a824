#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/motion_guard.h"
#include "core/contact/pair_response.h"
#include "core/contact/watched_pairs.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// Keeps a cloth from passing through itself, whatever a stepper proposes.
class ClothContact {
 public:
  /// model  outlives it; with self_contact
  explicit ClothContact(ClothModel& model);

  /// Starts a step: takes over pins that changed in number or vertex.
  void begin_step();

  /// Places where a substep starts, to be filled before it [m].
  PositionsRef begins() { return begins_.leftCols(n_vertices()); }
  /// Places bodies where they begin and end a substep [s]. Call it when `begins` are filled.
  void place_bodies(double begin, double end);
  /// Places that the substep proposes, to be filled before `hold` [m].
  PositionsRef ends() { return ends_.leftCols(n_vertices()); }

  /// Change of a vertex: to its place in `ends`, and that much faster [m/s].
  struct Change {
    VertexId vertex;
    Vec3 velocity{0, 0, 0};
  };
  /// Corrects the ends of a substep from `begin` to `end` [s]. Returns what changed; valid until
  /// the next call. Solids of the model are placed.
  std::span<const Change> hold(double begin, double end);

  /// Pairs that may meet, as they were listed last, with what is known of them.
  std::span<WatchedPair> pairs() { return pairs_.pairs(); }
  std::span<const WatchedPair> pairs() const { return pairs_.pairs(); }
  const Movers& movers() const { return movers_; }
  bool is_pinned(VertexId vertex) const { return is_pinned_[vertex] != 0; }
  double friction(const WatchedPair& pair) const { return pairs_.friction(pair); }
  /// Places of the cloth, and behind them of bodies, when the substep begins and ends [m].
  const Positions& all_begins() const { return begins_; }
  const Positions& all_ends() const { return ends_; }

  /// Says for each vertex whether cloth pressed it, or the guard held it back, since the step
  /// began.
  std::span<const char> pressed() const {
    return std::span(is_pressed_).first(static_cast<std::size_t>(n_vertices()));
  }

  /// Sums over all substeps since this was made.
  struct Sums {
    std::int64_t n_substeps = 0;
    std::int64_t n_held = 0;     ///< vertices held back, once for each substep
    double squared_loss = 0;     ///< sum over their ways [m^2]
    std::int64_t n_blocked = 0;  ///< substeps in which prescribed motions left cloth no way
  };
  const Sums& sums() const { return sums_; }
  /// Mean share of the vertices that were held back in a substep.
  double held_back_share() const { return static_cast<double>(sums_.n_held) / n_ways(); }
  /// Root mean square of the way that they lost, over all vertices and substeps [m].
  double rms_loss() const { return std::sqrt(sums_.squared_loss / n_ways()); }
  int n_pairs() const { return static_cast<int>(pairs_.pairs().size()); }
  /// Pairs that pushed in the last substep.
  int n_touching() const { return response_.n_active(); }
  int n_vertices() const { return model_.n_vertices(); }
  int n_lists() const { return pairs_.n_lists(); }
  std::size_t bytes() const;

 private:
  void press(double h);
  void note_pressed();
  bool meet_solids(double h);
  double n_ways() const {
    return static_cast<double>(std::max<std::int64_t>(1, sums_.n_substeps)) * n_vertices();
  }

  ClothModel& model_;
  WatchedPairs pairs_;
  Movers movers_;
  PairResponse response_;
  MotionGuard guard_;
  std::vector<char> is_pinned_, is_pressed_;  // and of bodies, whose vertices come last
  std::vector<Movers::RigidBody> bodies_;
  double bodies_time_;  // time at which bodies are where the last substep has left them [s]
  Positions begins_, ends_, proposed_, pushed_, parted_;
  Sums sums_;
  std::vector<Change> changes_;
};

}  // namespace pleat
