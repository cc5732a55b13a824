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
    float reach;                     // a vertex that moves no further may touch from so near [m]
    std::array<float, 3> shift;      // during the substep [m]
    float rounding;                  // of a vertex's place [m]
    float friction;
  };
  /// Of a group: lanes of vertices that may meet a solid, and which.
  struct Nearness {
    int lanes = 0;
    int solid = 0;  // or kSeveral
  };
  struct Slots {
    std::vector<int> slots;
    int count = 0;

    void append(int lanes, int slot);
  };
  /// Ways of four vertices, as a solid sees them [m].
  struct Ways;
  struct Meeting;
  /// Positive where a vertex meets the solid, and where it begins deep inside.
  struct Verdict {
    Float4 hits, is_deep;
  };

  void find_near(const Solid& solid, int index, const LaneView& view);
  static Float4 gap_of(const Solid& solid, const Vec3Lanes<Float4>& place);
  static Ways ways(const Solid& solid, const Vec3Lanes<Float4>& begin,
                   const Vec3Lanes<Float4>& move, const Vec3Lanes<Float4>& low);
  static Verdict verdict(const Solid& solid, const Ways& ways);
  static Meeting meeting(const Solid& solid, const Ways& ways);
  static void respond(const Solid& solid, const LaneView& view,
                      const std::array<float*, 3>& rounded_off, const LaneMembers& slots);
  static void respond_to(const Slots& hits, const Solid& solid, const LaneView& view,
                         const std::array<float*, 3>& rounded_off);

  int n_slots_;
  std::vector<ContactStage::Outline> outlines_;
  std::vector<Solid> solids_;
  std::vector<Nearness> near_;
  std::vector<Slots> hits_;  // of each solid, where it alone is met
  std::vector<int> left_over_;
};

}  // namespace pleat
