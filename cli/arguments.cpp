#include "cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/files/nearest_word.h"

namespace pleat {
namespace {

/// A dash begins an option, unless it is a number's.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word.find_first_of(".0123456789") != 1;
}

/// The option of a word, without the value that "=" may join to it.
std::string option_of(const std::string& word) {
  return is_option(word) ? word.substr(0, word.find('=')) : word;
}

bool has_joined_value(const std::string& word) { return word.find('=') != std::string::npos; }

/// NaN where it says no finite number.
double parsed_number(const std::string& text) {
  char* stop = nullptr;
  const double value = std::strtod(text.c_str(), &stop);
  return text.empty() || *stop != '\0' || !std::isfinite(value) ? std::nan("") : value;
}

}  // namespace

std::string either(const std::vector<const char*>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 < words.size() ? ", " : " or ") + std::string(words[k]);
  return text;
}

int parse_whole_number(const std::string& text, const std::string& where, int low, int high) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < low || value > high)
    throw InputError(where, "expected a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high) + ", got " + quotation(text));
  return value;
}

double parse_positive_number(const std::string& text, const std::string& where) {
  const double value = parsed_number(text);
  if (!(value > 0)) throw InputError(where, "expected a number > 0, got " + quotation(text));
  return value;
}

double parse_number_from_zero(const std::string& text, const std::string& where) {
  const double value = parsed_number(text);
  if (!(value >= 0)) throw InputError(where, "expected a number >= 0, got " + quotation(text));
  return value;
}

std::vector<std::string>::iterator Arguments::find(const char* option) {
  asked_.push_back(option);
  return std::find_if(words_.begin(), words_.end(),
                      [&](const std::string& word) { return option_of(word) == option; });
}

bool Arguments::flag(const char* option) {
  const auto place = find(option);
  if (place == words_.end()) return false;
  if (has_joined_value(*place))
    throw InputError(option, "expected no value, got " + quotation(*place));
  words_.erase(place);
  return true;
}

std::optional<std::string> Arguments::text(const char* option) {
  const auto place = find(option);
  if (place == words_.end()) return std::nullopt;
  const bool is_joined = has_joined_value(*place);
  const auto last = is_joined ? place : place + 1;
  if (last == words_.end() || (!is_joined && is_option(*last)))
    throw InputError(option, "expected a value after it, got " +
                                 (last == words_.end() ? "none" : quotation(*last)));
  std::string text = is_joined ? last->substr(last->find('=') + 1) : *last;
  if (text.empty()) throw InputError(option, "expected a value after it, got an empty one");
  words_.erase(place, last + 1);
  return text;
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
      throw InputError(
          option, "expected entries separated by single commas, got " + abbreviated(Json(*value)));
    begin = end + 1;
  }
  return entries;
}

void Arguments::refuse(const char* option, const std::string& sentence) {
  if (find(option) != words_.end()) throw InputError(option, sentence);
}

void Arguments::refuse_options() const {
  const auto word = std::find_if(words_.begin(), words_.end(), is_option);
  if (word == words_.end()) return;
  const std::string option = option_of(*word);
  if (std::find(asked_.begin(), asked_.end(), option) != asked_.end())
    throw InputError(option, "expected this option once, got it twice");
  std::vector<const char*> known;  // without dashes, which would make all of them alike
  for (const char* asked : asked_) known.push_back(asked + 2);
  const std::string_view near =
      nearest_word(option.substr(std::min(option.size(), std::size_t{2})), known);
  throw InputError(cut(option), near.empty()
                                    ? "unknown option; \"pleat help COMMAND\" lists what it takes"
                                    : "unknown option; the nearest is --" + std::string(near));
}

std::string Arguments::first_word(const char* what) {
  if (words_.empty() || is_option(words_.front()))
    throw InputError("", std::string("expected ") + what + ", got " +
                             (words_.empty() ? "nothing" : abbreviated(Json(words_.front()))));
  std::string word = words_.front();
  words_.erase(words_.begin());
  return word;
}

bool Arguments::has_word_ending(std::string_view ending) const {
  return std::any_of(words_.begin(), words_.end(), [&](std::string_view word) {
    return word.size() >= ending.size() && word.substr(word.size() - ending.size()) == ending;
  });
}

std::string Arguments::word(const char* what) {
  refuse_options();
  return first_word(what);
}

void Arguments::finish() const {
  refuse_options();
  if (words_.empty()) return;
  throw InputError(cut(words_.front()),
                   "one word too many; \"pleat help COMMAND\" lists what it takes");
}

}  // namespace pleat
