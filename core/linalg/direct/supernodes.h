#pragma once

#include <vector>

#include "core/linalg/sparse.h"

namespace pleat {

/// An order of elimination of little fill, and the columns of the factor in groups whose rows below
/// the group are the same.
///
/// Such a group is a dense trapezium, worked on by dense products. Groups are joined with the next
/// one while that adds few zeros. Sources: Amestoy, Davis & Duff, An approximate minimum degree
/// ordering algorithm, SIAM J. Matrix Anal. Appl. 17, 1996; Liu, The role of elimination trees in
/// sparse factorization, SIAM J. Matrix Anal. Appl. 11, 1990; Ashcraft & Grimes, The influence of
/// relaxed supernode partitions on the multifrontal method, ACM TOMS 15, 1989.
struct Supernodes {
  struct Node {
    int first;       ///< column of the factor
    int n_columns;   ///< at least 1
    int rows_begin;  ///< first of its rows in `rows`
    int n_rows;      ///< its own columns are the first of them
    int n_children;  ///< number of children; what is below them is among this node's rows
  };

  std::vector<int> order;   ///< row of the matrix for each row of the factor
  std::vector<Node> nodes;  ///< children before their parent, whose last one is right before it
  std::vector<int> rows;    ///< rows of the factor, ascending in each node
};

/// lower  lower triangle with its diagonal, compressed; only its pattern is read
Supernodes find_supernodes(const SparseMatrix& lower);

}  // namespace pleat
