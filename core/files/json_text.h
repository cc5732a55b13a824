#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace pleat {

/// Keeps the keys of an object in the order of the file, for messages and for writing.
using Json = nlohmann::ordered_json;

/// Parses JSON text. Throws InputError for what is not JSON (where: line and column), for a key
/// that stands twice in one object and for nesting deeper than any file of ours (where: the JSON
/// pointer).
Json parse_json(std::string_view text);

/// Indents by two spaces and keeps every object and array that fits within 100 columns on one line.
/// Numbers are written with the fewest digits that read back to the same bits.
std::string format_json(const Json& json);

/// A number, or null for what JSON cannot write: what is infinite or no number.
Json number_json(double value);

/// A text cut to a length that fits into a sentence.
std::string cut(const std::string& text);

/// One value on one line, cut.
std::string abbreviated(const Json& json);

/// A text in quotation marks on one line, cut.
std::string quotation(std::string_view text);

/// A key as one token of a JSON pointer (RFC 6901: "~" and "/" are escaped), cut like a value.
std::string pointer_token(std::string_view key);

/// Control characters written as JSON escapes them, so that no text from outside moves a terminal's
/// cursor or begins a line of its own.
std::string printable(std::string_view text);

}  // namespace pleat
