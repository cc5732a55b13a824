#pragma once

#include <filesystem>
#include <optional>

#include "cli/overwriting.h"
#include "core/reference/reference.h"
#include "core/sweep/sweep_plan.h"

namespace pleat {

/// Makes what the rows of a plan are compared with, and keeps it in a folder by id, with 32-bit
/// positions. Prints how well each is known. False when the numbers ended one, which is not kept.
///
/// store       of whole references: what it has is not made again
/// kept_level  of finer ones only the vertices of this level are kept
/// Throws FileError, before anything is made, where one stands that may not be written over.
bool ship_references(const SweepPlan& plan, ReferenceStore& store,
                     const std::filesystem::path& folder, std::optional<int> kept_level,
                     const Overwriting& overwriting);

}  // namespace pleat
