#pragma once

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

}  // namespace pleat
