#pragma once

#include <emscripten/val.h>

#include <vector>

#include "core/base/vec.h"

namespace pleat {

/// Three numbers a vertex [m].
Positions positions_in(const emscripten::val& places);

/// Dead after the next call that allocates.
template <class Number>
emscripten::val view_of(const std::vector<Number>& numbers) {
  return emscripten::val(emscripten::typed_memory_view(numbers.size(), numbers.data()));
}

}  // namespace pleat
