#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/number_range.h"
#include "core/base/vec.h"
#include "core/files/json_text.h"

namespace pleat {

/// A word of the file format and what it stands for.
template <class Value>
struct Word {
  const char* text;
  Value value;
};

/// The word for a value; every value of the enumeration has one.
template <class Value, std::size_t n>
const char* word_for(const std::array<Word<Value>, n>& words, Value value) {
  for (const Word<Value>& word : words)
    if (word.value == value) return word.text;
  return "";
}

/// A place in a parsed JSON document that knows its JSON pointer. Everything that is not as asked
/// for throws InputError{pointer, "expected ..., got ..."}. The document outlives its readers.
class JsonReader {
 public:
  explicit JsonReader(const Json& document) : JsonReader(document, "") {}

  const std::string& pointer() const { return pointer_; }
  const Json& json() const { return *json_; }

  /// Refuses anything but an object with no other keys than these.
  void allow_keys(std::span<const char* const> keys) const;
  void allow_keys(std::initializer_list<const char*> keys) const {
    allow_keys(std::span<const char* const>(keys.begin(), keys.size()));
  }
  /// The value of a key that has to be there.
  JsonReader at(const char* key) const;
  /// Nothing when the key is absent.
  std::optional<JsonReader> find(const char* key) const;
  /// The one of `keys` that is there, the index into `keys`; an error unless it is exactly one.
  std::size_t only_one_of(std::span<const char* const> keys) const;
  std::size_t only_one_of(std::initializer_list<const char*> keys) const {
    return only_one_of(std::span<const char* const>(keys.begin(), keys.size()));
  }

  double number(const NumberRange& range = kAnyNumber) const;
  /// Number of any size, for computed values. JSON has neither NaN nor infinity: null is `missing`.
  double number_or(double missing) const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  bool boolean() const;
  const std::string& text() const;
  bool is_text() const { return json_->is_string(); }
  bool is_object() const { return json_->is_object(); }
  bool is_array() const { return json_->is_array(); }
  bool is_null() const { return json_->is_null(); }
  Vec3 vec3() const;
  /// A vector of length one, whatever length is given (not zero).
  Vec3 direction() const;
  std::vector<JsonReader> elements() const;
  /// The elements of an array that has to have this many.
  std::vector<JsonReader> elements(std::size_t n) const;
  /// The values of an object with their keys, in the order of the file.
  std::vector<std::pair<std::string, JsonReader>> members() const;

  /// The index into `words` of the text that stands here.
  std::size_t one_of(std::span<const char* const> words) const;
  template <class Value, std::size_t n>
  Value word(const std::array<Word<Value>, n>& words) const {
    std::array<const char*, n> texts;
    for (std::size_t i = 0; i < n; ++i) texts[i] = words[i].text;
    return words[one_of(texts)].value;
  }

  /// Throws InputError "expected <expected>, got <this value>".
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  JsonReader(const Json& json, std::string pointer) : json_(&json), pointer_(std::move(pointer)) {}

  const Json* json_;
  std::string pointer_;
};

/// Three numbers in one range, by their keys in the order of the members of `Three`.
template <class Three>
Three read_three(const JsonReader& reader, const std::array<const char*, 3>& keys,
                 const NumberRange& range) {
  return {reader.at(keys[0]).number(range), reader.at(keys[1]).number(range),
          reader.at(keys[2]).number(range)};
}

/// Reads two unit vectors by their keys; one that is not there stays. They are perpendicular: up to
/// the digits of a file they are made so to the last bit, beyond them refused.
void read_perpendicular(const JsonReader& reader, const std::array<const char*, 2>& keys,
                        Vec3& first, Vec3& second);

/// A vector as the array of numbers that JsonReader::vec3 reads.
Json json_vec3(const Vec3& v);

}  // namespace pleat
