#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pleat {

/// The words after a command's name. Each one is asked for once, options before words; `word` and
/// `finish` refuse what nobody asked for. Everything here throws InputError naming the option.
class Arguments {
 public:
  explicit Arguments(std::vector<std::string> words) : words_(std::move(words)) {}

  bool flag(const char* option);
  /// The word after an option or joined to it by "=", not empty, or nothing.
  std::optional<std::string> text(const char* option);
  std::optional<int> whole_number(const char* option, int low, int high);
  /// Separated by commas, none empty.
  std::vector<std::string> list(const char* option);
  /// Throws InputError{option, sentence} when it is there: for what only other commands take.
  void refuse(const char* option, const std::string& sentence);

  /// The first word, before any option is asked for; `what` names it when it is missing.
  std::string first_word(const char* what);
  /// The next word, once no option is left; `what` names it when it is missing.
  std::string word(const char* what);

  /// Those that nobody has asked for yet.
  const std::vector<std::string>& words() const { return words_; }
  bool has_words() const { return !words_.empty(); }
  /// Of any word that is left.
  bool has_word_ending(std::string_view ending) const;

  /// Refuses words that are left over.
  void finish() const;

 private:
  std::vector<std::string>::iterator find(const char* option);
  void refuse_options() const;

  std::vector<std::string> words_;
  std::vector<const char*> asked_;  // options
};

/// "one, two or three".
std::string either(const std::vector<const char*>& words);

/// The number that a whole text says. Throws InputError{where} unless it is in [low, high].
int parse_whole_number(const std::string& text, const std::string& where, int low, int high);
double parse_positive_number(const std::string& text, const std::string& where);
double parse_number_from_zero(const std::string& text, const std::string& where);

}  // namespace pleat
