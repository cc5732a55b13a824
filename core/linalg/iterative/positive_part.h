#pragma once

#include <array>

#include "core/linalg/block_matrix.h"

namespace pleat {

/// The symmetric part of a 3 x 3 block without its negative eigenvalues, packed.
/// block  row by row
std::array<double, kPackedSize> positive_part(const double* block);

}  // namespace pleat
