#pragma once

#include <array>
#include <vector>

#include "core/contact/contact_stage.h"
#include "core/dynamics/xpbd/lane_layout.h"
#include "core/dynamics/xpbd/lane_operations.h"

namespace pleat {

/// Contact of four vertices at a time, in single precision: which of them may meet a solid, and,
/// where that is one plane or ball, what ContactStage would make of it. It holds vertices further
/// off by what single precision rounds off. What else there is it leaves to ContactStage.
///
/// Source: docs/methods/contact.md, "In lanes".
class ContactProgram {
 public:
  explicit ContactProgram(const LaneLayout& layout);

  /// Takes the solids of the substep that was begun.
  ///
  /// origin  of the lanes' positions [m]
  /// extent  how far from it vertices are, about [m]: rounding grows with it
  void place_solids(const ContactStage& contact, const Vec3& origin, double extent);

  /// Corrects the moves of vertices that meet one plane or ball.
  ///
  /// rounded_off  x, y, z of each slot: a vertex began at begin + rounded_off, and its velocity
  ///              times the substep is move - rounded_off [m]; corrected as well
  ///
  /// Returns the slots of the other moving vertices that may meet a solid, ascending; valid until
  /// the next call.
  const std::vector<int>& resolve(const LaneView& view, const std::array<float*, 3>& rounded_off);

 private:
  /// A half space below n.x = size, or a ball; what surely holds a solid or, if exact, itself.
  struct Solid {
    bool is_ball, is_exact;
    std::array<float, 3> place;      // the centre at the substep's end [m], or n
    std::array<float, 3> place_low;  // what single precision rounds off the centre [m]
    float size, size_low;            // radius, or level and what is rounded off that [m]
    std::array<float, 3> middle;     // of the centre's way [m], or n
    float reach;                     // how near the middle of a vertex's way may touch [m]
    std::array<float, 3> shift;      // during the substep [m]
    float rounding;                  // of a vertex's place [m]
    float friction;
  };
  /// Ways of four vertices, as a solid sees them [m].
  struct Ways;
  struct Meeting;

  static Float4 reached(const Solid& solid, const LaneView& view, int slot);
  static Meeting meeting(const Solid& solid, const Ways& ways);
  static int meet(const Solid& solid, const LaneView& view,
                  const std::array<float*, 3>& rounded_off, int slot);

  int n_slots_;
  std::vector<ContactStage::Outline> outlines_;
  std::vector<Solid> solids_;
  std::vector<int> left_over_;
};

}  // namespace pleat
