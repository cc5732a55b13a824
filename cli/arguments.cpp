#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/base/check.h"

namespace pleat {
namespace {

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] == '-';
}

}  // namespace

int parse_whole_number(const std::string& text, const std::string& where, int low, int high) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < low || value > high)
    throw InputError(where, "expected a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high) + ", got \"" + text + "\"");
  return value;
}

double parse_positive_number(const std::string& text, const std::string& where) {
  char* stop = nullptr;
  const double value = std::strtod(text.c_str(), &stop);
  if (text.empty() || *stop != '\0' || !std::isfinite(value) || value <= 0)
    throw InputError(where, "expected a number > 0, got \"" + text + "\"");
  return value;
}

bool Arguments::flag(const char* option) {
  const auto place = std::find(words_.begin(), words_.end(), option);
  if (place == words_.end()) return false;
  words_.erase(place);
  return true;
}

std::optional<std::string> Arguments::text(const char* option) {
  const auto place = std::find(words_.begin(), words_.end(), option);
  if (place == words_.end()) return std::nullopt;
  const auto value = place + 1;
  if (value == words_.end() || is_option(*value))
    throw InputError(option, "expected a value after it, got none");
  std::string text = *value;
  words_.erase(place, value + 1);
  return text;
}

std::optional<double> Arguments::positive_number(const char* option) {
  const std::optional<std::string> value = text(option);
  if (!value) return std::nullopt;
  return parse_positive_number(*value, option);
}

std::optional<int> Arguments::whole_number(const char* option, int low, int high) {
  const std::optional<std::string> value = text(option);
  if (!value) return std::nullopt;
  return parse_whole_number(*value, option, low, high);
}

std::vector<std::string> Arguments::list(const char* option) {
  std::vector<std::string> entries;
  const std::optional<std::string> value = text(option);
  if (!value) return entries;
  std::size_t begin = 0;
  while (begin <= value->size()) {
    const std::size_t end = std::min(value->find(',', begin), value->size());
    entries.push_back(value->substr(begin, end - begin));
    if (entries.back().empty())
      throw InputError(option,
                       "expected entries separated by single commas, got \"" + *value + "\"");
    begin = end + 1;
  }
  return entries;
}

std::string Arguments::word(const char* what) {
  const auto place = std::find_if_not(words_.begin(), words_.end(), is_option);
  if (place == words_.end())
    throw InputError("", std::string("expected ") + what + ", got nothing");
  std::string word = *place;
  words_.erase(place);
  return word;
}

void Arguments::finish() const {
  if (words_.empty()) return;
  const char* kind =
      is_option(words_.front()) ? "unknown option or given twice" : "one word too many";
  throw InputError(words_.front(),
                   std::string(kind) + "; \"pleat help\" lists what each command takes");
}

}  // namespace pleat
