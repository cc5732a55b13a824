#pragma once

#include <emscripten/val.h>

#include "core/base/vec.h"

namespace pleat {

/// Three numbers a vertex [m].
Positions positions_in(const emscripten::val& places);

/// A view of a vector or matrix of numbers. Dead after the next call that allocates.
template <class Numbers>
emscripten::val view_of(const Numbers& numbers) {
  return emscripten::val(
      emscripten::typed_memory_view(static_cast<std::size_t>(numbers.size()), numbers.data()));
}

}  // namespace pleat
