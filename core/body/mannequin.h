#pragma once

#include <string>
#include <vector>

#include "core/base/shapes.h"
#include "core/body/moving_body.h"

namespace pleat {

/// Two builds of a woman of 1.635 m.
enum class BodyBuild {
  average,  ///< the mean of women of that height, 67 kg
  slim,     ///< woman of 58 kg, nearer to a shop's mannequin
};

/// A solid that moves with a bone.
struct BodyPart {
  std::string name;
  RoundedCone shape;  ///< while the body stands, at time 0
  Bone bone;
};

/// The solids of a body, from the pelvis upward, then legs and arms. Neighbours overlap, so that
/// there are no dents between them. Hands and toes are left out.
/// Source: girths and breadths as docs/methods/body.md gives them.
std::vector<BodyPart> mannequin(BodyBuild build);

/// The hips and legs among `parts`, which garments of the lower body meet. The trunk above turns
/// and tilts against the pelvis, to which a waistband is fixed, and hanging arms cut into the hips.
std::vector<BodyPart> below_waist(std::vector<BodyPart> parts);

}  // namespace pleat
