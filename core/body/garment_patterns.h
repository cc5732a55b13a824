#pragma once

#include <vector>

#include "core/body/mannequin.h"
#include "core/mesh/quad_patch.h"
#include "core/mesh/vertex_group.h"

namespace pleat {

/// Quads around the standing body of a mannequin, with the names of their rings.
struct Garment {
  QuadPatch patch;
  std::vector<VertexGroup> groups;
};

/// A cone that flares from the waist.
struct SkirtMeasures {
  double waist_ease = 0.035;  ///< girth beyond the body's [m]
  double hem_girth = 2.6;     ///< [m]
  double length = 0.6;        ///< length along the cloth [m]
  int columns = 42;           ///< quads round, even, at least 8; rows follow from their shape
};

/// A tube from the waist to the fork and one for each leg.
struct TrouserMeasures {
  double waist_ease = 0.035;    ///< girth beyond the body's [m]
  double hip_ease = 0.08;       ///< girth beyond the body's from the hips to the fork [m]
  double inseam = 0.66;         ///< length from the crotch straight down [m]
  double ankle_opening = 0.46;  ///< girth of a leg's hem [m]
  int columns = 20;             ///< quads round the hips, as of a skirt
};

/// Groups: waist, hem. A skirt's two ends are its border; every other vertex has four edges.
///
/// From the second row of vertices on, its second refinement keeps 5 mm, and what contact adds for
/// flat faces, from the solids below the waist.
/// Throws InputError naming the measure for a waist that does not hold above the hips, a hem the
/// body does not pass or the length does not reach, a length that is not positive or ends on the
/// floor; ContractError for an odd number of columns or fewer than 8.
Garment skirt(const SkirtMeasures& measures, BodyBuild build);

/// Groups: waist, hem_left, hem_right. The two ends of the line between the legs have six edges,
/// every other vertex inside has four. Clearance and errors as of a skirt.
Garment trousers(const TrouserMeasures& measures, BodyBuild build);

}  // namespace pleat
