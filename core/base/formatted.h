#pragma once

#include <string>

namespace pleat {

/// printf into a string, of at most 255 bytes.
__attribute__((format(printf, 1, 2))) std::string formatted(const char* format, ...);

/// A number with three significant digits.
inline std::string three_digits(double value) { return formatted("%.3g", value); }

}  // namespace pleat
