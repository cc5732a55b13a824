#include "core/hard_cases/case_checks.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {
namespace {

std::vector<CaseException> tumbling_exceptions() {
  const std::string linear = momentum_kept(0).what;
  const std::string angular = angular_momentum_kept(0).what;
  const char* braked = "its implicit steps brake a rotation, the less the shorter they are";
  return {{"implicit", linear, "its equations are solved to 0.1 %", 1e-2},
          {"xpbd", linear, "it rounds to single precision", 1e-4},
          {"implicit", angular, braked},
          {"imex", angular, braked},
          {"projective", angular, braked},
          {"xpbd", angular, braked},
          {"newton", angular, braked},
          {"rk4", angular, "its error is of fifth order in the step", 1e-4}};
}

}  // namespace

std::vector<HardCase> lasting_cases() {
  return {
      {.name = "light_free_fall",
       .breaks = "Constraints that are solved in turn stretch cloth that only falls.",
       .seconds = {1, 4},
       .variants = {{"0.1 kg/m2", {}}, {"0.4 kg/m2", {{"/fabric/areal_density_kg_per_m2", 0.4}}}},
       .checks = {no_nonsense(), strain_at_most(1e-5)}},
      {.name = "tumbling",
       .breaks = "Without forces momentum leaks away, or grows.",
       .seconds = {5, 60},
       .checks = {no_nonsense(), momentum_kept(1e-8), angular_momentum_kept(1e-8)},
       .exceptions = tumbling_exceptions()},
      {.name = "ten_minutes_at_rest",
       .breaks = "Hanging cloth creeps, or gains energy from rounding.",
       .seconds = {60, 600},
       .checks = {no_nonsense(), rests(10, 1e-4), energy_grows_at_most(1e-2)},
       .exceptions = {{"projective", energy_grows_at_most(0).what,
                       "what its rounds leave of the equations is elastic energy", 5e-2}}},
      {.name = "rest_on_a_ball",
       .breaks = "Cloth on a ball trembles, or creeps down from it.",
       .seconds = {30, 600},
       .checks = {no_nonsense(), rests(1, 1e-3), outside_solids(1e-9)}},
      {.name = "below_buckling",
       .breaks =
           "Steppers that drop the negative part of compressed springs buckle where cloth does "
           "not.",
       .seconds = {20, 20},
       .checks = {speeds_explained(), rests(1, 1e-5)}},
  };
}

}  // namespace pleat
