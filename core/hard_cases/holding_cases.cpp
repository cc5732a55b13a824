#include "core/hard_cases/case_checks.h"
#include "core/hard_cases/hard_case_table.h"

namespace pleat {
namespace {

constexpr const char* kDragGrows =
    "drag grows with the square of the speed, which no bound on its substeps covers";

}  // namespace

std::vector<HardCase> holding_cases() {
  constexpr int kLowerRight = 80;  // vertex of 9x9
  return {
      {.name = "contradicting_pins",
       .breaks = "Two pins pull a sheet to three times its length, which no fabric follows.",
       .seconds = {3, 10},
       .checks = {speeds_explained(), stays_within(5)}},
      {.name = "pin_named_twice",
       .breaks = "One vertex with two motions: whichever is read last wins in silence.",
       .seconds = {1, 1},
       .is_bad_input = true},
      {.name = "flung_pins",
       .breaks = "Pins flung a hundred cloth sizes away and back, at 160 m/s.",
       .seconds = {2.5, 8},
       .checks = {speeds_explained(), stays_within(110)}},
      {.name = "jerked_corner",
       .breaks = "A hand that jerks at a corner from two metres away, as a mouse does in a frame.",
       .seconds = {2, 10},
       .events = {{0.5, HandGrabs{VertexId(kLowerRight)}},
                  {0.5, HandMoves{{2, 0, 0}}},
                  {1, HandLetsGo{}}},
       .checks = {speeds_explained(), stays_within(10), end_strain_at_most(0.35)}},
      {.name = "limited_against_pins",
       .breaks =
           "A strain limit that pins do not let it keep is swept for ever, or throws the cloth.",
       .seconds = {1.5, 10},
       .checks = {speeds_explained(), stays_within(5)}},
      {.name = "gust_of_60_metres",
       .breaks = "A gale of 60 m/s pulls with two thousand times what a shirt's cloth weighs.",
       .seconds = {2, 10},
       .checks = {stays_within(5), end_strain_at_most(2)},
       .stops = {{"explicit", kDragGrows}, {"rk4", kDragGrows}}},
      {.name = "torn_corner",
       .breaks =
           "A hand tears a corner off: vertices without faces, mass that is lost, or a throw.",
       .seconds = {1.5, 1.5},  // a piece that is torn off falls freely from then on
       .events = {{0.2, HandGrabs{VertexId(kLowerRight)}},
                  {0.2, HandMoves{{0.3, -0.1, 0.4}}},
                  {0.6, HandMoves{{0.6, -0.2, 0.8}}},
                  {1, HandLetsGo{}}},
       .checks = {tears(), mass_kept(1e-12), stays_within(10)}},
      {.name = "torn_by_a_gale",
       .breaks = "A gale tears weak cloth in many places at a time, down to single faces.",
       .seconds = {2, 4},
       .checks = {tears(), mass_kept(1e-12), stays_within(200)},
       .stops = {{"explicit", kDragGrows}, {"rk4", kDragGrows}}},
      {.name = "one_pinned_corner",
       .breaks = "Cloth that hangs by one corner turns and swings and never comes to rest.",
       .seconds = {60, 300},
       .checks = {no_nonsense(), rests(1, 5e-3)}},
  };
}

}  // namespace pleat
