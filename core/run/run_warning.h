#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/files/json_reader.h"

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
    held_back,      ///< the guard of self-contact shortened the ways of many vertices
    blocked,        ///< pins left cloth no way, and stayed behind
    soft,           ///< cloth stretches more than its fabric would, as yet by no nonsense
  };
  Kind kind;
  double time;      ///< when it was first seen [s]
  VertexId vertex;  ///< vertex where it was at its worst
  /// Worst value: |l/L - 1|, [m/s], relative residual, share of the weight or of the vertices,
  /// substeps.
  double value;
  double bound;  ///< limit that the first one exceeded, in the same unit
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

}  // namespace pleat
