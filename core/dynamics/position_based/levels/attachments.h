#pragma once

#include <vector>

#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/levels/length_groups.h"
#include "core/hierarchy/mesh_hierarchy.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// The longest that strain-free cloth lets a vertex come away from pins: one length for each patch
/// of pins joined by springs, at its nearest pin, and for the four nearest patches at most. Places
/// are vertices.
///
/// Lengths are exact on a flat sheet that fills a rectangle; elsewhere those of shortest paths
/// along edges of all levels and springs, a little longer. The hierarchy may be without levels.
/// Source: Kim, Chentanez & Mueller-Fischer, Long range attachments, SCA 2012.
std::vector<PlaceLength> long_range_attachments(const ClothModel& model,
                                                const MeshHierarchy& hierarchy);

/// How far apart attachments let pairs of pins be, each pair that holds a vertex once: the least
/// sum of their lengths to one. Pins further apart leave no place for a vertex.
std::vector<PlaceLength> lengths_between_pins(const std::vector<PlaceLength>& attachments);

/// Attachments of vertices in lane order, compiled into operations on four neighbours at a time.
class AttachmentProgram {
 public:
  AttachmentProgram() = default;
  /// slots  of each vertex
  /// slack  by which each may be exceeded [m]: what weight alone moves in a substep, without which
  ///        attachments pull at cloth at rest, and it trembles
  AttachmentProgram(const std::vector<PlaceLength>& attachments, const std::vector<int>& slots,
                    double slack);

  /// Moves vertices that are too far from a pin back to where they may be, the nearest pin first.
  /// Where pins themselves are further apart than attachments allow, all lengths grow with them.
  /// Returns what they are multiplied by, at least 1.
  float sweep(const LaneView& view) const;

 private:
  /// One attachment of each of four neighbours.
  struct Operation {
    int first_slot;
    bool has_one_pin;
    LaneMembers pins;     // slots
    PerLane<float> rest;  // squared lengths [m^2]; infinite without an attachment
  };
  struct PinPair {
    int a, b;       // slots
    double length;  // [m]
  };

  float stretch_of_pins(const LaneView& view) const;

  std::vector<Operation> operations_;
  std::vector<PinPair> between_pins_;
};

}  // namespace pleat
