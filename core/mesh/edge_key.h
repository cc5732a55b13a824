#pragma once

#include <cstdint>

#include "core/base/ids.h"

namespace pleat {

/// Different for every edge and each of its two directions.
inline std::uint64_t directed_edge_key(VertexId from, VertexId to) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(from.value)) << 32) |
         static_cast<std::uint32_t>(to.value);
}

/// Key of an edge, equal for both directions.
inline std::uint64_t edge_key(VertexId a, VertexId b) {
  return a < b ? directed_edge_key(a, b) : directed_edge_key(b, a);
}

}  // namespace pleat
