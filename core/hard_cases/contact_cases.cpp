#include "core/hard_cases/case_checks.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {

std::vector<HardCase> contact_cases() {
  return {
      {.name = "fast_ball",
       .breaks = "At 50 m/s a sheet crosses the side of a ball within one step.",
       .seconds = {0.5, 5},
       .checks = {speeds_explained(), stays_within(300), outside_solids(1e-9)}},
      {.name = "fast_figure",
       .breaks = "The same against the ends of rounded cones: hands, head and shoulders.",
       .seconds = {0.3, 5},
       .checks = {speeds_explained(), stays_within(300), outside_solids(1e-9)}},
      {.name = "fast_groove",
       .breaks = "Two balls and a wall that are met at once push a vertex from one into the next.",
       .seconds = {0.3, 5},
       .checks = {speeds_explained(), stays_within(300), outside_solids(1e-9)}},
      {.name = "minute_of_free_fall",
       .breaks = "A minute of falling makes coordinates of 17 km and ends at 590 m/s.",
       .seconds = {20.5, 62},
       .brief_changes = {{"/cloth/sheet/origin_m", Json{-0.5, 1962, -0.5}}},
       .checks = {speeds_explained(), stays_within(2e4), outside_solids(1e-9)}},
      {.name = "inside_a_ball",
       .breaks = "Cloth that begins inside of a solid is thrown out with whatever speed it takes.",
       .seconds = {1.5, 10},
       .checks = {stays_within(5), outside_solids(1e-9), end_strain_at_most(0.35)}},
      {.name = "folded_napkin",
       .breaks = "Cloth dropped folded falls through itself where its halves meet on a ball.",
       .seconds = {0.5, 5},
       .checks = {no_crossings(), speeds_explained(), stays_within(3), outside_solids(1e-9)}},
      {.name = "twisted_sheet",
       .breaks = "Cloth that is wrung by three turns ends up in front of itself and behind.",
       .seconds = {3, 10},
       .checks = {no_crossings(), stays_within(3)}},
  };
}

}  // namespace pleat
