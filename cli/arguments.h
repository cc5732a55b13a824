#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/check.h"
#include "core/files/json_reader.h"

namespace pleat {

/// "one, two or three".
std::string either(const std::vector<const char*>& words);

/// Texts between commas, which may be empty.
std::vector<std::string> split(const std::string& text);

/// The number that a whole text says. Throws InputError{where} unless it is in [low, high].
int parse_whole_number(const std::string& text, const std::string& where, int low, int high);

/// The numbers that are taken.
enum class Numbers { positive, not_negative };
/// The number that a whole text says. Throws InputError{where} for others.
double parse_number(const std::string& text, const std::string& where,
                    Numbers which = Numbers::positive);

/// The words after a command's name. Each one is asked for once, options before words; `word` and
/// `finish` refuse what nobody asked for. Everything here throws InputError naming the option.
class Arguments {
 public:
  explicit Arguments(std::vector<std::string> words) : words_(std::move(words)) {}

  bool flag(const char* option);
  /// The word after an option or joined to it by "=", not empty, or nothing.
  std::optional<std::string> text(const char* option);
  /// Values of an option that may come several times.
  std::vector<std::string> texts(const char* option);
  std::optional<int> whole_number(const char* option, int low, int high);
  std::optional<double> number(const char* option, Numbers which = Numbers::positive);
  /// The value of the word that is given, one of `words`, else `usual`.
  template <class Value, class Words = std::initializer_list<Word<Value>>>
  Value choice(const char* option, Value usual, const Words& words) {
    const std::optional<std::string> given = text(option);
    if (!given) return usual;
    std::vector<const char*> known;
    for (const Word<Value>& word : words) {
      if (*given == word.text) return word.value;
      known.push_back(word.text);
    }
    throw InputError(option, "expected " + either(known) + ", got " + quotation(*given));
  }
  /// Entries between commas, none empty.
  std::vector<std::string> list(const char* option);
  /// Throws InputError{option, sentence} when one is there: for what only other commands take.
  void refuse(std::initializer_list<const char*> options, const std::string& sentence);

  /// The first word, before any option is asked for; `what` names it when it is missing.
  std::string first_word(const char* what);
  /// The next word, once no option is left; `what` names it when it is missing.
  std::string word(const char* what);

  /// Words that nobody has asked for yet.
  const std::vector<std::string>& words() const { return words_; }
  bool has_words() const { return !words_.empty(); }
  /// Looks at all words that are left.
  bool has_word_ending(std::string_view ending) const;

  /// Refuses words that are left over.
  void finish() const;

 private:
  std::vector<std::string>::iterator find(const char* option);
  void refuse_options() const;

  std::vector<std::string> words_;
  std::vector<const char*> asked_;  // options
};

}  // namespace pleat
