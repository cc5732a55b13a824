#pragma once

#include <cstdint>

namespace pleat {

/// An index that cannot be mistaken for an index into another array. Reads as a number, is made
/// explicitly.
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::int64_t index) : value(static_cast<std::int32_t>(index)) {}
  constexpr operator std::int32_t() const { return value; }
  constexpr bool valid() const { return value >= 0; }
};

using VertexId = Id<struct VertexTag>;
using FaceId = Id<struct FaceTag>;

}  // namespace pleat
