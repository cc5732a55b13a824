#include "core/base/formatted.h"

#include <cstdarg>
#include <cstdio>

namespace pleat {

std::string formatted(const char* format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace pleat
