#pragma once

#include <array>

#include "core/linalg/block_matrix.h"

namespace pleat {

/// Of a 3 x 3 block's symmetric part: without its negative eigenvalues, packed.
/// block  row by row
std::array<double, kPackedSize> positive_part(const double* block);

}  // namespace pleat
