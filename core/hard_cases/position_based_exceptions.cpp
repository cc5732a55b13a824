#include "core/hard_cases/position_based_exceptions.h"

#include <string>

#include "core/base/check.h"
#include "core/hard_cases/case_checks.h"

namespace pleat {
namespace {

/// For several steppers and cases the same.
struct SharedException {
  std::vector<std::string> steppers, cases;
  std::string check;
  const char* reason;
  std::optional<double> bound = std::nullopt;
};

std::vector<SharedException> shared_exceptions() {
  const std::vector<std::string> all = {"pbd", "hpbd", "multigrid"};
  const std::string nonsense = no_nonsense().what;
  const char* slow = "a pull goes a few springs far in a sweep: 200 rows need thousands of these";
  const char* order = "it takes springs one after another, and their order has no mirror image";
  const char* rigid = "its springs are rigid: what sags is what is left unsolved";
  const char* of_2008 = "what its levels move is not smooth: it is kept to compare with";
  const char* trembles = "rigid constraints that contradict each other tremble";
  return {
      {{"pbd", "hpbd"}, {"sag_of_rows"}, nonsense, slow},
      {all, {"sag_of_rows", "sag_of_steps"}, sags_agree(0).what, rigid},
      {all, {"symmetric_swing", "symmetric_drape"}, stays_symmetric(0).what, order},
      {all, {"tumbling"}, momentum_kept(0).what, "it rounds to single precision", 1e-4},
      {all,
       {"tumbling"},
       angular_momentum_kept(0).what,
       "its implicit steps brake a rotation, the less the shorter they are"},
      {all,
       {"scale_of_a_drape"},
       variants_agree(0).what,
       "roundings of single precision differ, and folds of rigid cloth magnify them"},
      {{"hpbd"}, {"fold_across_a_border"}, nonsense, of_2008},
      {{"pbd", "hpbd"}, {"one_pinned_corner"}, rests(1, 0).what, trembles},
      {{"pbd", "hpbd"}, {"ten_minutes_at_rest"}, rests(10, 0).what, trembles},
      {{"pbd", "hpbd"}, {"ten_minutes_at_rest"}, energy_grows_at_most(0).what, trembles},
      {all,
       {"jerked_corner", "inside_a_ball"},
       end_strain_at_most(0).what,
       "rigid springs that were thrown across each other stay tangled"},
      {{"multigrid"}, {"scale_of_a_drape"}, nonsense, trembles},
      {{"multigrid"},
       {"contradicting_pins", "limited_against_pins"},
       speeds_explained().what,
       trembles},
      {{"hpbd"}, {"folded_flat"}, speeds_explained().what, of_2008},
      {{"hpbd"}, {"rest_on_a_ball", "symmetric_drape"}, nonsense, of_2008},
      {{"hpbd"}, {"rest_on_a_ball"}, rests(1, 0).what, of_2008},
      {{"hpbd"}, {"scale_of_a_swing"}, variants_agree(0).what, of_2008},
  };
}

HardCase& find_case(std::vector<HardCase>& cases, const std::string& name) {
  for (HardCase& hard_case : cases)
    if (hard_case.name == name) return hard_case;
  PLEAT_CHECK(false, "an exception names a case that there is");
  return cases.front();
}

}  // namespace

void except_position_based(std::vector<HardCase>& cases) {
  for (const SharedException& shared : shared_exceptions())
    for (const std::string& name : shared.cases)
      for (const std::string& stepper : shared.steppers)
        find_case(cases, name)
            .exceptions.push_back({stepper, shared.check, shared.reason, shared.bound});
}

}  // namespace pleat
