#pragma once

#include <string>

#include "core/linalg/sparse.h"

namespace pleat {

/// The lower triangle of a symmetric real coordinate matrix. Throws InputError with the line for
/// anything else.
SparseMatrix read_matrix_market(const std::string& text);

}  // namespace pleat
