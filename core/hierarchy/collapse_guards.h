#pragma once

#include <array>
#include <string_view>

namespace pleat {

/// Guards against faults of collapses; one is switched off only to show its fault.
struct CollapseGuards {
  /// No triangle turns over or is left without area.
  bool flips = true;
  /// The border counts in the cost, keeps its corners and is left only along itself.
  bool borders = true;
  /// Nothing is joined that was apart: an edge keeps at most two triangles.
  bool links = true;
};

/// Their names on the command line, in the order of the members.
constexpr std::array<std::string_view, 3> kCollapseGuardNames{"flips", "borders", "links"};

}  // namespace pleat
