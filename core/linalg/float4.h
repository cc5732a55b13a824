#pragma once

#include <cstring>

namespace pleat {

/// Four floats that are worked on at once.
using Float4 = float __attribute__((vector_size(16)));

/// Numbers that arrays have to hold beyond their end where `load4` may read across it.
constexpr int kLoadRoom = 4;

inline Float4 load4(const float* from) {
  Float4 four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

inline void store4(float* to, Float4 four) { std::memcpy(to, &four, sizeof four); }

}  // namespace pleat
