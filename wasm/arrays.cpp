#include "wasm/arrays.h"

namespace pleat {

Positions positions_in(const emscripten::val& places) {
  const auto numbers = emscripten::convertJSArrayToNumberVector<double>(places);
  return Eigen::Map<const Positions>(numbers.data(), 3,
                                     static_cast<Eigen::Index>(numbers.size() / 3));
}

}  // namespace pleat
