#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/files/json_reader.h"
#include "core/run/rest_watch.h"
#include "core/run/simulation.h"

namespace pleat {

/// A value in the scene that may help a run: its JSON pointer.
struct SettingHint {
  std::string pointer;
  Json value;
};

/// A sign that a run's numbers are finite nonsense (docs/methods/plausibility.md).
struct RunWarning {
  enum class Kind {
    stretch,        ///< cloth is longer than its load explains
    speed,          ///< a vertex is faster than falling and pulling explain
    unsolved,       ///< step after step left most of its equations unsolved
    not_converged,  ///< a step reported it, by more than a thousandth: no nonsense, as the next
    given_up,       ///< a factor solved what the solver that was asked for gave up
    unbalanced,     ///< cloth is at rest where its model is in no equilibrium
    soft,           ///< cloth stretches more than its fabric would, as yet by no nonsense
  };
  Kind kind;
  double time;      ///< when it was first seen [s]
  VertexId vertex;  ///< vertex where it was at its worst
  double value;     ///< worst value: |l/L - 1|, [m/s], relative residual or share of the weight
  double bound;     ///< limit that the first one exceeded, in the same unit
  std::vector<SettingHint> hints;

  bool is_nonsense() const {
    return kind == Kind::stretch || kind == Kind::speed || kind == Kind::unsolved;
  }
};

/// Sentence on the observation, its place, its time, and what the scene explains.
std::string sentence(const RunWarning& warning);
/// "try /method/substeps = 4".
std::string advice(const RunWarning& warning);

Json json_warning(const RunWarning& warning);
/// JSON of each warning.
Json json_warnings(std::span<const RunWarning> warnings);
/// Reads the text of json_warnings. Throws InputError with the JSON pointer.
std::vector<RunWarning> read_warnings(const JsonReader& reader);

/// Looks at a running simulation and tells when it shows what the scene cannot explain. Costs
/// nothing between looks.
class RunWatch {
 public:
  /// simulation  at the start of its run
  explicit RunWatch(const Simulation& simulation);

  /// step  the report of the steps since the last look
  void check(const Simulation& simulation, const SolveReport& step);
  /// Call it after the last step: what has come to rest is looked at once more.
  void check_end(const Simulation& simulation);

  /// At most one of each kind, as they were seen, but that which is not nonsense last.
  const std::vector<RunWarning>& warnings() const { return warnings_; }
  /// Share of the weight of cloth at rest that is not balanced, at the last look; NaN before.
  double unbalanced_share() const;
  const RestWatch& rest() const { return rest_; }

 private:
  void check_stretch(const Simulation& simulation);
  double explained_softness(const Simulation& simulation) const;
  void check_speed(const Simulation& simulation);
  void check_report(const Simulation& simulation, const SolveReport& step);
  void tell_unbalanced(const Simulation& simulation, const std::optional<RestWatch::Look>& look);
  void warn(const Simulation& simulation, RunWarning warning);

  double stiffness_;         // force per strain of what holds the cloth [N]
  double load_stretch_;      // stretch under the cloth's whole weight, with room for motion [1]
  double room_for_swing_;    // weights that a swing pulls by at most
  double soft_stretch_;      // stretch that the fabric explains, as far as it was asked for [1]
  double start_stretch_;     // [1]
  double start_height_;      // height of the highest vertex against gravity [m]
  double start_slack_;       // way that cloth falls until its pins hold it [m]
  double start_speed_;       // speed at the start, with what the energy stored there can give [m/s]
  double driven_speed_ = 0;  // the largest so far of pins and solids [m/s]
  int n_unsolved_ = 0;       // looks in a row that saw a step left unsolved
  double unsolved_since_ = 0;  // the first of them [s]
  RestWatch rest_;
  std::vector<RunWarning> warnings_;
};

}  // namespace pleat
