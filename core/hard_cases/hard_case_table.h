#pragma once

#include <vector>

#include "core/hard_cases/hard_case.h"

namespace pleat {

/// All of them, in the order in which they are told. docs/hard-cases.md explains what they share.
std::vector<HardCase> hard_cases();

// The parts of the table.

/// Stiffness, mass and the shapes that elements begin in.
std::vector<HardCase> element_cases();
/// Pins and hands that ask for too much.
std::vector<HardCase> holding_cases();
/// Solids that are met fast, or from inside.
std::vector<HardCase> contact_cases();
/// Motions that have to come to rest, to go on for ever, or to stay as they are.
std::vector<HardCase> lasting_cases();
/// Runs that have to agree.
std::vector<HardCase> likeness_cases();
/// Shapes, modes and kinds, which no stepper makes.
std::vector<HardCase> still_cases();

}  // namespace pleat
