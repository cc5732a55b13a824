#pragma once

namespace pleat {

/// Of a 3 x 3 block's symmetric part: without its negative eigenvalues.
/// block     row by row
/// positive  packed, as in block_matrix.h
void positive_part(const double* block, double* positive);

}  // namespace pleat
