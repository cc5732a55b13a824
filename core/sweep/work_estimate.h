#pragma once

#include <optional>
#include <span>
#include <string>

namespace pleat {

/// Work that is done one time or more.
struct ExpectedWork {
  std::string kind;     ///< work of one kind takes time in proportion to its amount, roughly
  double amount;        ///< amount of one time, in any unit, positive
  double n_times;       ///< times that it is to be done
  double n_passed = 0;  ///< times done, the last one perhaps in part
  std::optional<double> seconds = {};  ///< time that one takes [s], where that is known
};

/// Share of all of the work that has passed, by amount, in [0, 1].
double passed_share(std::span<const ExpectedWork> works);

/// How long the rest will take [s]. What is not known of one work follows from the known one of its
/// kind that is nearest in amount, else from all that are known together; nothing while none is.
std::optional<double> expected_rest(std::span<const ExpectedWork> works);

}  // namespace pleat
