#include "core/contact/body_depth.h"

#include <algorithm>

namespace pleat {

BodyDepth::BodyDepth(std::span<const BodySurface> bodies) {
  for (const BodySurface& body : bodies)
    bodies_.push_back({SignedDistance(body.places, body.triangles),
                       {body.places.rowwise().minCoeff(), body.places.rowwise().maxCoeff()},
                       body.motion});
}

Penetration BodyDepth::at(const PositionsView& positions, double time) {
  Penetration found;
  std::vector<bool> is_inside(static_cast<std::size_t>(positions.cols()), false);
  for (Body& body : bodies_) {
    const Pose back = body.motion.pose(time).inverse();
    for (Eigen::Index i = 0; i < positions.cols(); ++i) {
      const Vec3 place = back * positions.col(i);
      if (!body.box.contains(place)) continue;
      const double depth = -body.distance.at(place);
      if (!(depth > 0)) continue;
      is_inside[static_cast<std::size_t>(i)] = true;
      if (depth <= found.depth) continue;
      found.depth = depth;
      found.deepest = VertexId(i);
    }
  }
  found.n_inside = static_cast<int>(std::count(is_inside.begin(), is_inside.end(), true));
  return found;
}

}  // namespace pleat
