#include "core/sweep/work_estimate.h"

#include <cmath>

namespace pleat {
namespace {

/// The known work of the same kind whose amount differs by the smallest factor.
const ExpectedWork* nearest_known(const ExpectedWork& wanted, std::span<const ExpectedWork> works) {
  const auto factor = [&](const ExpectedWork& work) {
    return std::abs(std::log(work.amount / wanted.amount));
  };
  const ExpectedWork* nearest = nullptr;
  for (const ExpectedWork& work : works)
    if (work.seconds && work.kind == wanted.kind &&
        (nearest == nullptr || factor(work) < factor(*nearest)))
      nearest = &work;
  return nearest;
}

/// Seconds for an amount of one, over all that is known.
std::optional<double> common_rate(std::span<const ExpectedWork> works) {
  double seconds = 0;
  double amount = 0;
  for (const ExpectedWork& work : works) {
    if (!work.seconds) continue;
    seconds += *work.seconds;
    amount += work.amount;
  }
  if (amount == 0) return std::nullopt;
  return seconds / amount;
}

}  // namespace

double passed_share(std::span<const ExpectedWork> works) {
  double whole = 0;
  double passed = 0;
  for (const ExpectedWork& work : works) {
    whole += work.amount * work.n_times;
    passed += work.amount * work.n_passed;
  }
  return passed / whole;
}

std::optional<double> expected_rest(std::span<const ExpectedWork> works) {
  const std::optional<double> rate = common_rate(works);
  if (!rate) return std::nullopt;
  double rest = 0;
  for (const ExpectedWork& work : works) {
    const ExpectedWork* known = work.seconds ? &work : nearest_known(work, works);
    const double own_rate = known != nullptr ? *known->seconds / known->amount : *rate;
    rest += (work.n_times - work.n_passed) * work.amount * own_rate;
  }
  return rest;
}

}  // namespace pleat
