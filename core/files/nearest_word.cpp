#include "core/files/nearest_word.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace pleat {
namespace {

/// How many letters have to be inserted, deleted or replaced to turn a into b.
/// Source: Wagner & Fischer, The string-to-string correction problem, J. ACM 21, 1974.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const char* const> known) {
  constexpr std::size_t kLongestWord = 64;  // letters worth comparing; the comparison is quadratic
  const std::string_view start = word.substr(0, kLongestWord);
  std::string_view best;
  std::size_t best_distance = (start.size() + 1) / 3 + 1;  // a word as wrong as this is another one
  for (const std::string_view candidate : known) {
    const bool is_start = !start.empty() && candidate.substr(0, start.size()) == start;
    const std::size_t distance = is_start ? 0 : edit_distance(start, candidate);
    if (distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

}  // namespace pleat
