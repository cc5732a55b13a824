#include "core/hard_cases/hard_case_table.h"

#include <iterator>

#include "core/base/check.h"
#include "core/hard_cases/case_checks.h"

namespace pleat {
namespace {

/// Exception that several steppers and cases share.
struct SharedException {
  std::vector<std::string> steppers, cases;
  std::string check;
  const char* reason;
  std::optional<double> bound = std::nullopt;
};

std::vector<SharedException> shared_exceptions() {
  const std::vector<std::string> all = {"pbd", "hpbd", "multigrid"};
  const std::string nonsense = no_nonsense().what;
  const char* slow =
      "a pull goes a few springs far in a sweep: hundreds of rows need thousands of these";
  const char* order = "it takes springs one after another, and their order has no mirror image";
  const char* rigid = "its springs are rigid: what sags is what is left unsolved";
  const char* unsolved =
      "what its sweeps leave of rigid lengths counts as elastic energy of the fabric's springs";
  const char* swinging =
      "air alone brakes its swing, as it does with implicit steps of 1/600 s: it rests a minute "
      "later";
  const char* rounded = "it rounds to single precision, of which a swing and a drape make much";
  const char* stuck = "links pull a vertex into the ball, and friction holds it there";
  const char* limited =
      "rigid links, a limit and pins contradict each other: places jump by up to a link within a "
      "substep, however short";
  // Faults, with what experiments showed of them: docs/log/multigrid.md.
  const char* turning =
      "a fault: a pull lies between a link's directions before and in the substep, and turns what "
      "hangs by one corner";
  const char* interpolated =
      "a fault: interpolated corrections of coarse levels keep momentum, but turn and move what "
      "hangs";
  const char* both_sides =
      "a fault of its levels of 2008: they push chords of folded cloth apart, and interpolate that";
  const char* ties =
      "a fault of its levels of 2008: rounding decides which of two alike vertices they keep";
  const char* bursting =
      "springs without a length have no direction: the one that rounding gives them may burst the "
      "cloth apart, which is told";
  return {
      {{"xpbd"}, {"one_point"}, speeds_explained().what, bursting},
      {{"xpbd"}, {"one_point"}, stays_within(0).what, bursting},
      {{"pbd", "hpbd"}, {"sag_of_rows", "fine_curtain"}, nonsense, slow},
      {{"pbd", "hpbd"}, {"needle_cells"}, stays_within(0).what, slow},
      {all, {"sag_of_rows", "sag_of_steps"}, sags_agree(0).what, rigid},
      {all, {"symmetric_swing", "symmetric_drape"}, stays_symmetric(0).what, order},
      {all, {"tumbling"}, momentum_kept(0).what, "it rounds to single precision", 1e-4},
      {all,
       {"tumbling"},
       angular_momentum_kept(0).what,
       "its implicit steps brake a rotation, the less the shorter they are"},
      {{"pbd"}, {"one_pinned_corner"}, rests(1, 0).what, turning, 0.1},
      {{"hpbd", "multigrid"}, {"one_pinned_corner"}, rests(1, 0).what, interpolated, 0.6},
      {{"pbd"}, {"ten_minutes_at_rest"}, rests(10, 0).what, swinging, 5e-3},
      {{"hpbd"}, {"ten_minutes_at_rest"}, rests(10, 0).what, interpolated, 0.1},
      {{"multigrid"}, {"ten_minutes_at_rest"}, rests(10, 0).what, interpolated, 5e-3},
      {{"pbd", "hpbd"}, {"ten_minutes_at_rest"}, energy_grows_at_most(0).what, unsolved},
      {{"hpbd"}, {"rest_on_a_ball"}, rests(1, 0).what, both_sides, 0.1},
      {all, {"inside_a_ball"}, end_strain_at_most(0).what, stuck, 6},
      {{"pbd"}, {"scale_of_a_drape"}, variants_agree(0).what, rounded, 1e-3},
      {{"multigrid"}, {"scale_of_a_drape"}, variants_agree(0).what, rounded, 0.2},
      {{"multigrid"},
       {"far_from_the_origin", "scale_of_a_swing"},
       variants_agree(0).what,
       rounded,
       1e-2},
      {{"hpbd"}, {"scale_of_a_drape"}, variants_agree(0).what, ties, 2},
      {{"hpbd"}, {"scale_of_a_swing"}, variants_agree(0).what, ties, 0.1},
      {{"multigrid"}, {"limited_against_pins"}, speeds_explained().what, limited, 1},
      {{"hpbd"}, {"folded_flat"}, speeds_explained().what, both_sides, 1},
      {{"hpbd"}, {"symmetric_drape"}, nonsense, both_sides, 1},
  };
}

HardCase& find_case(std::vector<HardCase>& cases, const std::string& name) {
  for (HardCase& hard_case : cases)
    if (hard_case.name == name) return hard_case;
  PLEAT_CHECK(false, "an exception names a case that there is");
  return cases.front();
}

/// Adds to each case what position-based steppers do not meet there: what is so by their nature, as
/// they project rigid constraints one after another in single precision, and faults whose cause is
/// not known, which say so and, where the measure is finite, how large they may be.
void except_position_based(std::vector<HardCase>& cases) {
  for (const SharedException& shared : shared_exceptions())
    for (const std::string& name : shared.cases)
      for (const std::string& stepper : shared.steppers)
        find_case(cases, name)
            .exceptions.push_back({stepper, shared.check, shared.reason, shared.bound});
}

}  // namespace

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> all;
  for (const auto part :
       {element_cases, holding_cases, contact_cases, lasting_cases, likeness_cases, still_cases}) {
    std::vector<HardCase> cases = part();
    std::move(cases.begin(), cases.end(), std::back_inserter(all));
  }
  except_position_based(all);
  return all;
}

}  // namespace pleat
