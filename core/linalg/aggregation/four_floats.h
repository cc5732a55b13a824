#pragma once

#include <cstring>

namespace pleat {

/// Four floats that are worked on at once.
using FourFloats = float __attribute__((vector_size(16)));

/// Numbers that arrays have to hold beyond their end where `load4` may read across it.
constexpr int kLoadRoom = 4;

inline FourFloats load4(const float* from) {
  FourFloats four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

inline void store4(float* to, FourFloats four) { std::memcpy(to, &four, sizeof four); }

}  // namespace pleat
