#include "core/hard_cases/case_checks.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {
namespace {

/// A metre of sheet made `scale` times as large so that it moves alike: with times and densities as
/// they are, lengths and weight by the scale, stretch by its square, bending by its fourth power.
std::vector<SceneOverride> scaled_sheet(double scale) {
  const double s2 = scale * scale;
  return {{"/cloth/sheet/width_m", scale},
          {"/cloth/sheet/height_m", scale},
          {"/world/gravity_m_per_s2", Json{0, -9.81 * scale, 0}},
          {"/fabric/stretch_warp_n_per_m", 4500 * s2},
          {"/fabric/stretch_weft_n_per_m", 2800 * s2},
          {"/fabric/shear_n_per_m", 66 * s2},
          {"/fabric/bend_warp_n_m", 9e-6 * s2 * s2},
          {"/fabric/bend_weft_n_m", 6e-6 * s2 * s2}};
}

std::vector<SceneOverride> scaled_sheet_and_ball(double scale) {
  std::vector<SceneOverride> changes = scaled_sheet(scale);
  changes.push_back(
      {"/world/colliders/0/sphere/centre_m", Json{0.5 * scale, -0.35 * scale, 0.5 * scale}});
  changes.push_back({"/world/colliders/0/sphere/radius_m", 0.3 * scale});
  return changes;
}

std::vector<CaseVariant> in_three_sizes(std::vector<SceneOverride> (*scaled)(double)) {
  return {{"1 m", {}}, {"1 cm", scaled(0.01)}, {"100 m", scaled(100)}};
}

constexpr const char* kPullIsSlow =
    "a pull goes a few springs far in a substep: 200 rows need thousands of these, and the run "
    "says "
    "so";

/// Solvers that stop early stop at something that is not symmetric.
std::vector<StepperSetting> solved_exactly() {
  return {{"implicit", {"/method/tolerance", 1e-12}}, {"imex", {"/method/tolerance", 1e-12}}};
}

}  // namespace

std::vector<HardCase> likeness_cases() {
  return {
      {.name = "far_from_the_origin",
       .breaks = "Ten kilometres from the origin single precision has steps of a millimetre.",
       .seconds = {1, 2},
       .variants = {{"here", {}}, {"10 km away", {{"/cloth/sheet/origin_m", Json{1e4, 1e4, 1e4}}}}},
       .checks = {no_nonsense()},
       .variant_checks = {variants_agree(1e-4)}},
      {.name = "scale_of_a_swing",
       .breaks = "Tolerances in metres: what holds for a metre of cloth fails for a centimetre.",
       .seconds = {1, 2},
       .variants = in_three_sizes(scaled_sheet),
       .checks = {no_nonsense()},
       .variant_checks = {variants_agree(1e-4)}},
      {.name = "scale_of_a_drape",
       .breaks = "The same of contact, whose clearances are lengths too.",
       .seconds = {1, 2},
       .variants = in_three_sizes(scaled_sheet_and_ball),
       .checks = {no_nonsense()},
       .variant_checks = {variants_agree(1e-4)}},
      {.name = "sag_of_rows",
       .breaks = "The same cloth hangs down further the finer its mesh is.",
       .seconds = {5, 20},
       .variants = {{"10 rows", {}},
                    {"50 rows", {{"/cloth/sheet/rows", 50}}},
                    {"200 rows", {{"/cloth/sheet/rows", 200}}}},
       .checks = {no_nonsense()},
       .variant_checks = {sags_agree(0.05)},
       .exceptions = {{"xpbd", no_nonsense().what, kPullIsSlow},
                      {"xpbd", sags_agree(0).what, kPullIsSlow}}},
      {.name = "sag_of_steps",
       .breaks = "The same cloth hangs down further the longer its steps are.",
       .seconds = {5, 20},
       .variants = {{"1/60 s", {}},
                    {"1/30 s", {{"/method/step_s", 1.0 / 30}}},
                    {"1/120 s", {{"/method/step_s", 1.0 / 120}}}},
       .checks = {no_nonsense()},
       .variant_checks = {sags_agree(0.05)}},
      {.name = "far_away_object",
       .breaks = "Something far away that is never met changes the motion all the same.",
       .seconds = {2, 4},
       .variants = {{"alone", {}},
                    {"with a ball 1 km away",
                     {{"/world/colliders",
                       parse_json(R"([{"sphere": {"centre_m": [1000, 0, 0]}}])")}}}},
       .checks = {no_nonsense()},
       .variant_checks = {variants_agree(0)}},
      {.name = "symmetric_swing",
       .breaks = "What is symmetric does not stay so where elements are taken in turn.",
       .seconds = {2, 4},
       .settings = solved_exactly(),
       .checks = {no_nonsense(), stays_symmetric(1e-6)},
       .exceptions = {{"xpbd", stays_symmetric(0).what,
                       "it takes springs one after another, and their order has no mirror image"}}},
      {.name = "symmetric_drape",
       .breaks = "The same with contact and friction.",
       .seconds = {1, 4},
       .settings = solved_exactly(),
       .checks = {no_nonsense(), stays_symmetric(1e-6)},
       .exceptions = {{"xpbd", stays_symmetric(0).what,
                       "it takes springs one after another, and their order has no mirror image"}}},
      {.name = "switched_while_moving",
       .breaks = "Another fabric or mesh during the motion makes the cloth jump.",
       .seconds = {2, 4},
       .events = {{0.5, SceneSwitch{{{"/fabric/name", "linen"}}}},
                  {0.9, SceneSwitch{{{"/refinement/level", 1}}}},
                  {1.3, SceneSwitch{{{"/refinement/level", 0}}}}},
       .checks = {no_nonsense(), velocity_jumps_at_most(0.5)}},
  };
}

}  // namespace pleat
