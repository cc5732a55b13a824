#include "core/files/json_reader.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/files/nearest_word.h"

namespace pleat {
namespace {

std::string number_text(double number) { return Json(number).dump(); }

std::string description(const NumberRange& range) {
  const bool open = range.ends != NumberRange::Ends::included;
  if (range.low == -kLargestNumber && range.high == kLargestNumber) return "a number";
  if (range.high == kLargestNumber)
    return std::string("a number ") + (open ? "> " : ">= ") + number_text(range.low);
  return "a number between " + number_text(range.low) + " and " + number_text(range.high) +
         (open ? ", both excluded" : "");
}

std::string listed(std::span<const char* const> keys) {
  std::string text;
  for (const char* key : keys) text += (text.empty() ? "\"" : ", \"") + std::string(key) + '"';
  return text;
}

}  // namespace

void JsonReader::fail(const std::string& expected) const {
  throw InputError(pointer_, "expected " + expected + ", got " + abbreviated(*json_));
}

void JsonReader::allow_keys(std::span<const char* const> keys) const {
  if (!json_->is_object()) fail("an object");
  for (const auto& item : json_->items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
    const std::string_view near = nearest_word(item.key(), keys);
    const std::string expected =
        near.empty() ? (keys.size() == 1 ? "only the key " : "one of the keys ") + listed(keys)
                     : "the key \"" + std::string(near) + '"';
    throw InputError(pointer_ + "/" + pointer_token(item.key()),
                     "expected " + expected + ", got " + abbreviated(Json(item.key())));
  }
}

std::optional<JsonReader> JsonReader::find(const char* key) const {
  if (!json_->is_object()) fail("an object");
  const auto it = json_->find(key);
  if (it == json_->end()) return std::nullopt;
  return JsonReader(*it, pointer_ + "/" + pointer_token(key));
}

JsonReader JsonReader::at(const char* key) const {
  const std::optional<JsonReader> value = find(key);
  if (!value) fail("the key \"" + std::string(key) + '"');
  return *value;
}

std::size_t JsonReader::only_one_of(std::span<const char* const> keys) const {
  std::optional<std::size_t> found;
  std::size_t index = 0;
  for (const char* key : keys) {
    if (find(key)) {
      if (found)
        throw InputError(pointer_,
                         "expected only one of the keys " + listed(keys) + ", got several");
      found = index;
    }
    ++index;
  }
  if (!found) fail("one of the keys " + listed(keys));
  return *found;
}

std::size_t JsonReader::one_of(std::span<const char* const> words) const {
  const auto at = json_->is_string() ? std::find(words.begin(), words.end(), text()) : words.end();
  if (at == words.end()) fail("one of " + listed(words));
  return static_cast<std::size_t>(at - words.begin());
}

double JsonReader::number(const NumberRange& range) const {
  if (!json_->is_number()) fail(description(range));
  const double number = json_->get<double>();
  if (!std::isfinite(number) || std::abs(number) > kLargestNumber)
    fail("a number of at most 1e12 in size");
  if (!range.contains(number)) fail(description(range));
  return number;
}

double JsonReader::number_or(double missing) const {
  if (is_null()) return missing;
  if (!json_->is_number()) fail("a number or null");
  return json_->get<double>();
}

std::int64_t JsonReader::integer(std::int64_t low, std::int64_t high) const {
  const std::string expected =
      "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  if (!json_->is_number()) fail(expected);
  const double number = json_->get<double>();
  if (!(number >= static_cast<double>(low) && number <= static_cast<double>(high))) fail(expected);
  if (number != std::floor(number)) fail(expected);
  return static_cast<std::int64_t>(number);
}

bool JsonReader::boolean() const {
  if (!json_->is_boolean()) fail("true or false");
  return json_->get<bool>();
}

const std::string& JsonReader::text() const {
  if (!json_->is_string()) fail("a text in quotes");
  return json_->get_ref<const std::string&>();
}

std::vector<JsonReader> JsonReader::elements() const {
  if (!json_->is_array()) fail("an array");
  std::vector<JsonReader> elements;
  elements.reserve(json_->size());
  for (const Json& element : *json_)
    elements.push_back(JsonReader(element, pointer_ + "/" + std::to_string(elements.size())));
  return elements;
}

std::vector<JsonReader> JsonReader::elements(std::size_t n) const {
  if (!json_->is_array() || json_->size() != n)
    fail("an array of " + std::to_string(n) + " values");
  return elements();
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
  if (!json_->is_object()) fail("an object");
  std::vector<std::pair<std::string, JsonReader>> members;
  for (const auto& item : json_->items())
    members.emplace_back(item.key(),
                         JsonReader(item.value(), pointer_ + "/" + pointer_token(item.key())));
  return members;
}

Vec3 JsonReader::vec3() const {
  if (!json_->is_array() || json_->size() != 3) fail("an array of 3 numbers");
  const std::vector<JsonReader> coordinates = elements();
  return {coordinates[0].number(), coordinates[1].number(), coordinates[2].number()};
}

Vec3 JsonReader::direction() const {
  // A direction of length one within rounding is kept to the bit, so that what was written is read
  // back.
  constexpr double kUnitTolerance = 1e-14;
  constexpr double kSmallestLength = 1e-12;  // shorter ones are zero spoilt by rounding
  const Vec3 given = vec3();
  const double length = given.stableNorm();
  if (length < kSmallestLength) throw InputError(pointer_, "expected a direction, got three zeros");
  return std::abs(length - 1) < kUnitTolerance ? given : Vec3(given / length);
}

void read_perpendicular(const JsonReader& reader, const std::array<const char*, 2>& keys,
                        Vec3& first, Vec3& second) {
  constexpr double kWrittenDigits = 1e-6;  // cosine; a file with six digits is meant perpendicular
  constexpr double kRoundedDigits =
      1e-14;  // cosine; kept to the bit, so that what was written is read back
  if (const auto at = reader.find(keys[0])) first = at->direction();
  if (const auto at = reader.find(keys[1])) second = at->direction();
  const double cosine = first.dot(second);
  if (std::abs(cosine) > kWrittenDigits)
    throw InputError(
        reader.pointer() + "/" + keys[1],
        std::string("expected a direction perpendicular to ") + keys[0] + ", got one at " +
            Json(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI).dump() + " degrees");
  if (std::abs(cosine) > kRoundedDigits) second = (second - cosine * first).normalized();
}

Json json_vec3(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

}  // namespace pleat
