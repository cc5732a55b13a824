#pragma once

#include "core/dynamics/method_options.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// The springs and bending elements of a model in two: those that symplectic Euler takes stably in
/// substeps of h, and the others.
struct StabilitySplit {
  ClothModel stiff;  ///< the others; masses and pins as in the whole
  ClothModel soft;
  std::vector<char> is_stiff;  ///< one for each spring of the whole
};

/// Goes through the elements from soft to stiff, by (h^2 k + 2 h c)(1/m_i + 1/m_j): one is soft as
/// long as at each of its vertices, pins aside,
///
///     (2/m) (h^2 sum k + 2 h sum c) < 4 s,  s = 0.8
///
/// still holds over the soft ones so far and itself (Gershgorin). A bending element has at each
/// vertex half of its row's sum in place of k: 2 B w/L^3 at its ends and 4 B w/L^3 in its middle.
/// What a hanging vertex is part of is stiff.
///
/// h  [s], positive
StabilitySplit split_by_stability(const ClothModel& model, double h);

/// Share of the springs that split_by_stability takes for soft; 1 without springs. It grows, as
/// good as always, as h falls.
double explicit_share(const ClothModel& model, double h);

/// Structural springs are stiff, shear and bending soft, whatever h.
StabilitySplit split_structural(const ClothModel& model);

}  // namespace pleat
