#include "core/files/json_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <vector>

#include "core/base/check.h"
#include "core/base/formatted.h"

namespace pleat {
namespace {

constexpr std::size_t kMaxDepth = 32;      // levels of nesting; a scene needs 7
constexpr std::size_t kLineLength = 100;   // columns
constexpr std::size_t kMaxQuotation = 60;  // bytes of a value or key repeated in a sentence

/// An object or array that the parser is inside of.
struct OpenValue {
  bool is_array = false;
  std::size_t n_begun = 0;     // elements begun, of an array
  std::string key;             // the last one read, of an object
  std::set<std::string> keys;  // all read so far
};

/// Watches the parser's events for what it does not refuse by itself.
class ParseWatch {
 public:
  bool operator()(Json::parse_event_t event, const Json& parsed) {
    switch (event) {
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        begin_element();
        open_.emplace_back();
        open_.back().is_array = event == Json::parse_event_t::array_start;
        if (open_.size() > kMaxDepth) fail("expected at most 32 levels of nesting, got more");
        break;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        open_.pop_back();
        break;
      case Json::parse_event_t::key:
        open_.back().key = parsed.get_ref<const std::string&>();
        if (!open_.back().keys.insert(open_.back().key).second)
          fail("expected each key once, got this one twice");
        break;
      case Json::parse_event_t::value:
        begin_element();
        break;
    }
    return true;
  }

 private:
  void begin_element() {
    if (!open_.empty() && open_.back().is_array) ++open_.back().n_begun;
  }

  [[noreturn]] void fail(const char* sentence) const {
    std::string pointer;
    for (const OpenValue& value : open_) {
      if (value.is_array ? value.n_begun == 0 : value.keys.empty()) continue;
      pointer += '/';
      pointer += value.is_array ? std::to_string(value.n_begun - 1) : pointer_token(value.key);
    }
    throw InputError(pointer, sentence);
  }

  std::vector<OpenValue> open_;
};

/// The line and column of a place in the text.
std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " + std::to_string(before.size() - line_begin + 1);
}

/// The part of `text` behind `begin` and before `end`; empty when either is missing.
std::string between(const std::string& text, std::string_view begin, std::string_view end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  const std::size_t to = text.find(end, from);
  return to == std::string::npos ? "" : text.substr(from, to - from);
}

/// The last word that the library read, with the rest of it when the library stopped inside. A
/// string is one word.
std::string last_word(std::string word, bool is_string, std::string_view text, std::size_t offset) {
  if (!is_string && word.size() > 1)
    word.erase(0, word.find_last_of(" :,[{>", word.size() - 2) + 1);
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  if (word.empty() || !is_letter(word.back())) return word;
  while (offset < text.size() && is_letter(text[offset]) && word.size() <= kMaxQuotation)
    word += text[offset++];
  return word;
}

/// The library's message reads "[id] parse error at line 1, column 5: syntax error while parsing
/// value - reason; last read: 'bytes that need not be text'", without the last part where the text
/// is JSON up to a sign that does not belong there.
[[noreturn]] void throw_input_error(const Json::parse_error& error, std::string_view text) {
  constexpr std::string_view kLastRead = "; last read: '";
  const std::string message = error.what();
  const std::size_t end = message.find(kLastRead);
  std::string got = "an error";
  if (end != std::string::npos) {
    const std::size_t from = end + kLastRead.size();
    const std::size_t to = std::max(from, message.rfind('\''));
    const bool is_string = message.find("invalid string") < end;
    got =
        abbreviated(Json(last_word(message.substr(from, to - from), is_string, text, error.byte)));
  }
  const std::string reason = message.substr(0, end) + '\n';
  throw InputError(between(message, " at ", ": "),
                   "expected JSON, got " + got + ' ' + between(reason, "syntax error ", "\n"));
}

/// The only message without a place quotes the number as it stands in the text.
[[noreturn]] void throw_input_error(const Json::out_of_range& error, std::string_view text) {
  const std::string number = between(error.what(), "'", "'");
  throw InputError(line_and_column(text, text.find(number)),
                   "expected a number of at most 1.8e308 in size, got " + cut(number));
}

std::string scalar_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string text_on_one_line(const Json& json) {
  if (!json.is_structured()) return scalar_text(json);
  std::string text(1, json.is_object() ? '{' : '[');
  bool first = true;
  for (const auto& item : json.items()) {
    if (!first) text += ", ";
    first = false;
    if (json.is_object()) text += scalar_text(Json(item.key())) + ": ";
    text += text_on_one_line(item.value());
  }
  return text + (json.is_object() ? '}' : ']');
}

/// column  where the text begins, and what its last line needs after it.
void append(const Json& json, std::size_t indent, std::size_t column, std::string& text) {
  const std::string flat = text_on_one_line(json);
  if (!json.is_structured() || json.empty() || column + flat.size() < kLineLength) {
    text += flat;
    return;
  }
  const std::string inner(indent + 2, ' ');
  text += json.is_object() ? "{\n" : "[\n";
  std::size_t left = json.size();
  for (const auto& item : json.items()) {
    const std::string key = json.is_object() ? scalar_text(Json(item.key())) + ": " : "";
    text += inner + key;
    append(item.value(), indent + 2, inner.size() + key.size(), text);
    text += --left > 0 ? ",\n" : "\n";
  }
  text += std::string(indent, ' ') + (json.is_object() ? '}' : ']');
}

}  // namespace

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string cut(const std::string& text) {
  if (text.size() <= kMaxQuotation) return text;
  std::size_t length = kMaxQuotation;
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U)
    --length;  // whole UTF-8 characters
  return text.substr(0, length) + "...";
}

std::string pointer_token(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return cut(token);
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : '\0');
    const bool is_c1 = byte == 0xc2 && next >= 0x80 && next < 0xa0;  // U+0080 to U+009F
    if (byte >= 0x20 && byte != 0x7f && !is_c1) {
      result += text[i];
      continue;
    }
    result += formatted("\\u%04x", static_cast<unsigned>(is_c1 ? next : byte));
    if (is_c1) ++i;
  }
  return result;
}

std::string abbreviated(const Json& json) {
  if (json.is_null()) return "null";
  if (json.is_object()) return json.empty() ? "an empty object" : "an object";
  if (json.is_array())
    return "an array of " + std::to_string(json.size()) + (json.size() == 1 ? " value" : " values");
  return cut(scalar_text(json));
}

std::string quotation(std::string_view text) { return abbreviated(Json(std::string(text))); }

std::string format_json(const Json& json) {
  std::string text;
  append(json, 0, 0, text);
  return text + "\n";
}

Json parse_json(std::string_view text) {
  ParseWatch watch;
  try {
    return Json::parse(
        text, [&](int, Json::parse_event_t event, Json& parsed) { return watch(event, parsed); });
  } catch (const Json::parse_error& error) {
    throw_input_error(error, text);
  } catch (const Json::out_of_range& error) {
    throw_input_error(error, text);
  }
}

}  // namespace pleat
