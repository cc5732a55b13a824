#pragma once

#include <array>
#include <vector>

#include "core/contact/contact_pass.h"
#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/lane_operations.h"
#include "core/dynamics/position_based/lanes/group_freedom.h"
#include "core/dynamics/position_based/lanes/lane_cone.h"

namespace pleat {

/// Contact of four vertices at a time, in single precision: which of them may meet a solid, and,
/// where that is one plane, ball or rounded cone, what ContactPass would make of it. It holds
/// vertices further off by what single precision rounds off. What else there is it leaves to
/// ContactPass. Source: docs/methods/contact.md, "In lanes".
class ContactProgram {
 public:
  explicit ContactProgram(const LaneLayout& layout);

  /// Takes how far off solids hold the vertices, which may be anywhere.
  void begin_step(const ContactPass& contact, const LaneLayout& layout);

  /// Takes the solids of the substep that was begun.
  ///
  /// origin  of the lanes' positions [m]
  /// extent  how far from it vertices are, about [m]: rounding grows with it
  void place_solids(const ContactPass& contact, const Vec3& origin, double extent);

  /// Corrects the moves of vertices that meet one solid.
  ///
  /// rounded_off  x, y, z of each slot: a vertex began at begin + rounded_off, and its velocity
  ///              times the substep is move - rounded_off [m]; corrected as well
  ///
  /// Returns the slots of the other moving vertices that may meet a solid, ascending; valid until
  /// the next call.
  const std::vector<int>& resolve(const LaneView& view, const std::array<float*, 3>& rounded_off);

 private:
  enum class Kind { plane, ball, cone };
  /// A half space below n.x = size, a ball, or a cone in a ball; what surely holds a solid or, if
  /// exact, itself.
  struct Solid {
    Kind kind;
    bool is_exact;
    std::array<float, 3> place;      // the centre at the substep's end [m], or n
    std::array<float, 3> place_low;  // rest that single precision rounds off the centre [m]
    float size, size_low;            // radius, or level and what is rounded off that [m]
    std::array<float, 3> middle;     // middle of the centre's way [m], or n
    float reach;                     // a vertex that moves no further may touch from so near [m]
    std::array<float, 3>
        shift;       // shift during the substep [m]; for a cone, of a point at the origin
    float rounding;  // error of a vertex's place [m]
    float friction;
    std::array<std::array<float, 3>, 3> turn;  // rows: a point at x shifts by turn x more
    LaneCone cone;
  };
  struct Slots {
    std::vector<int> slots;
    int count = 0;

    void append(int lanes, int slot);
  };
  /// Ways of four vertices, as a solid sees them [m].
  struct Ways;
  struct Meeting;
  struct Group;
  /// A solid near some of four vertices.
  struct Near {
    int solid;
    int lanes;       // vertices that are near
    int hits, deep;  // lanes that meet it, and that begin deep inside
    Float4 margin;   // a cone's height at the start less the length of the way [m]
    Float4 length;   // length of the way, seen from a cone [m]
  };

  static Float4 gap_of(const Solid& solid, const Vec3Lanes<Float4>& place);
  static void place(const SweptPlane& plane, const Vec3& origin, double extent, Solid& solid);
  static void place(const SweptSphere& ball, const Vec3& origin, double extent, Solid& solid);
  static void place_cone(const ContactPass& contact, const ContactPass::Outline& outline,
                         const Vec3& origin, Solid& solid);
  void list_cones(const ContactPass& contact);
  static int near_lanes(const Solid& solid, const Vec3Lanes<Float4>& begin, Float4 length);
  static Ways ways(const Solid& solid, const Vec3Lanes<Float4>& begin,
                   const Vec3Lanes<Float4>& move, const Vec3Lanes<Float4>& low);
  static void judge(const Solid& solid, const Ways& ways, Near& near);
  static void judge_cone(const Solid& solid, const Ways& ways, Float4 face_squares, Near& near);
  static Meeting meeting(const Solid& solid, const Ways& ways);
  static Meeting cone_meeting(const Solid& solid, const Ways& ways, Float4 face_squares);
  void look_at_cone(int cone, const Group& group, float further);
  void look_at_cones(Group& group);
  void look_at_others(const Group& group);
  /// Lists each vertex that this file can answer for at the one solid that it hits. Returns the
  /// lanes of the others that may meet a solid.
  int assign_hits(const Group& group);
  void respond(const Solid& solid, const LaneView& view, const std::array<float*, 3>& rounded_off,
               const LaneMembers& slots) const;
  void respond_to(const Slots& hits, const Solid& solid, const LaneView& view,
                  const std::array<float*, 3>& rounded_off) const;

  int n_slots_;
  std::vector<float> face_squares_;  // squared radius of each slot's faces [m^2]; where cones are
  std::vector<ContactPass::Outline> outlines_;
  std::vector<Solid> solids_;
  std::vector<int> others_;         // planes, balls and bounds among the solids
  std::vector<int> cones_;          // exact ones
  std::vector<float> cone_shifts_;  // shifts beyond the drift [m]
  std::array<float, 3> drift_{};    // drift of the cones in the substep [m]
  bool knows_groups_ = false;
  GroupFreedom freedom_;    // distance of groups from cones
  std::vector<Near> near_;  // solids near the group that is looked at; the first n_near_ count
  std::size_t n_near_ = 0;
  std::vector<Slots> hits_;  // vertices that meet this solid alone, for each solid
  std::vector<int> left_over_;
};

}  // namespace pleat
