#include "core/run/scene_model.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/dynamics/stepper_table.h"
#include "core/model/elements.h"
#include "core/run/elastic_model.h"
#include "core/scene/tearing.h"

namespace pleat {
namespace {

/// The frames of the body's bones, by their numbers; empty without a body.
using BoneFrames = std::vector<std::shared_ptr<const MovingFrame>>;

Motion following(const BoneFrames& frames, Bone bone) {
  Motion motion;
  motion.kind = Motion::Kind::follow;
  motion.frame = frames[static_cast<std::size_t>(bone)];
  return motion;
}

/// A later rule does not pin again what an earlier one holds, and hanging vertices follow their
/// parents.
std::vector<Pin> scene_pins(const Scene& scene, const RestCloth& cloth, const ClothModel& model,
                            const BoneFrames& frames) {
  const Positions& positions = cloth.start;
  std::vector<Pin> pins;
  std::vector<bool> taken(static_cast<std::size_t>(positions.cols()), false);
  for (const PinRule& rule : scene.pins) {
    const Motion motion = rule.bone ? following(frames, *rule.bone) : rule.motion;
    for (const VertexId v : pinned_vertices(rule, cloth)) {
      if (taken[v] || model.hangs(v)) continue;
      taken[v] = true;
      pins.push_back({v, positions.col(v), motion});
    }
  }
  return pins;
}

/// The parts of the body that the scene's cloth meets: garments are of the lower body.
std::vector<BodyPart> body_parts(const Scene& scene) {
  std::vector<BodyPart> parts = scene.body->parts();
  return scene.cloth->is_worn() ? below_waist(std::move(parts)) : parts;
}

/// The scene's own solids, then the body's.
std::vector<Collider> scene_colliders(const Scene& scene, const BoneFrames& frames) {
  std::vector<Collider> colliders = scene.colliders;
  if (!scene.body) return colliders;
  const double friction = scene.body->friction.value_or(scene.fabric.friction_solid);
  for (const BodyPart& part : body_parts(scene))
    colliders.push_back(Collider{part.shape, following(frames, part.bone), friction});
  return colliders;
}

/// 0 without area [m].
double circumradius(const Positions& positions, const Triangle& t) {
  const Vec3 a = positions.col(t[1]) - positions.col(t[0]);
  const Vec3 b = positions.col(t[2]) - positions.col(t[0]);
  const double doubled_area = a.cross(b).norm();
  if (doubled_area == 0) return 0;
  return a.norm() * b.norm() * (a - b).norm() / (2 * doubled_area);
}

double longest_edge(const Positions& positions, const std::array<VertexId, 4>& corners) {
  double longest = 0;
  for (std::size_t k = 0; k < 4; ++k)
    longest =
        std::max(longest, (positions.col(corners[k]) - positions.col(corners[(k + 1) % 4])).norm());
  return longest;
}

/// The radius of the largest face around each vertex [m]: of a garment half of the longest edge of
/// quads, whose threads run along limbs and around them; of other cloth a triangle's circumradius.
/// A hanging vertex is in the middle of an edge twice as long.
Eigen::VectorXd face_radii(const Scene& scene, const RestCloth& cloth, const ClothModel& model) {
  const Positions& positions = cloth.mesh.rest_positions;
  Eigen::VectorXd radii = Eigen::VectorXd::Zero(positions.cols());
  constexpr double kStretched = 1.1;  // stretched more, its middle may be inside of a solid
  const auto add_face = [&](const auto& corners, double radius) {
    const bool has_hanging =
        std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return model.hangs(v); });
    for (const VertexId v : corners)
      radii[v] = std::max(radii[v], (has_hanging ? 2 * kStretched : 1) * radius);
  };
  if (scene.cloth->is_worn() && cloth.quads) {
    for (const QuadFace& face : cloth.quads->faces())
      if (face.active()) add_face(face.corners, longest_edge(positions, face.corners) / 2);
  } else {
    for (const Triangle& t : cloth.mesh.triangles) add_face(t, circumradius(positions, t));
  }
  // Where a mesh is uniform, so is this: its faces differ by rounding, far below kSame. On a rough
  // mesh that adds as little to the clearance.
  constexpr double kSame = 1e-9;  // relative
  const double largest = radii.maxCoeff();
  for (double& radius : radii)
    if (radius > (1 - kSame) * largest) radius = largest;
  return radii;
}

/// Bodies hold cloth off by half of its thickness, as other solids do; cloth that has none, or
/// hardly any, by as much as would be too little to see.
SelfContact surfaces_in_contact(const Scene& scene, const RestCloth& cloth,
                                const ClothModel& model) {
  const SelfContactOptions own = scene.self_contact.value_or(SelfContactOptions{});
  SelfContact contact{cloth.mesh.triangles, model.hanging, cloth.mesh.rest_positions,
                      own.thickness.value_or(scene.fabric.thickness),
                      own.friction.value_or(scene.fabric.friction_fabric)};
  for (const SurfaceSolid& solid : scene.surface_solids) contact.bodies.push_back(solid.surface());
  constexpr double kLeastGap = 5e-5;  // [m]; without a gap no side of a surface is to be told
  contact.body_gap = std::max(scene.fabric.thickness / 2, kLeastGap);
  contact.is_loose = !scene.self_contact;
  return contact;
}

}  // namespace

State scene_state(const RestCloth& cloth) { return {cloth.start, cloth.start_velocities}; }

ClothModel scene_model(const Scene& scene, const RestCloth& cloth) {
  ClothModel model;
  const BoneFrames frames = scene.body ? scene.body->bone_frames() : BoneFrames{};
  add_elasticity(model, scene, cloth);
  model.rest_coordinates = cloth.rest_coordinates;
  if (scene.method.stepper->needs_surface) model.surface = cloth.mesh;
  model.damping_direction = scene.model.damping_direction;
  model.gravity = scene.gravity;
  model.pins = scene_pins(scene, cloth, model, frames);
  // A sheet's quads are split both ways, so that drag is shared among corners as mass is.
  if (scene.air && cloth.quads)
    model.air.emplace(cloth.quads->crossed_triangles(), *scene.air, model.n_vertices(), 0.5);
  else if (scene.air && !cloth.mesh.triangles.empty())
    model.air.emplace(cloth.mesh.triangles, *scene.air, model.n_vertices());
  if (std::vector<Collider> colliders = scene_colliders(scene, frames); !colliders.empty()) {
    const ContactOptions options{scene.fabric.thickness / 2, face_radii(scene, cloth, model),
                                 scene.contact_response};
    model.contact.emplace(std::move(colliders), options);
  }
  if ((scene.self_contact || !scene.surface_solids.empty()) && !cloth.mesh.triangles.empty())
    model.self_contact = surfaces_in_contact(scene, cloth, model);
  if (scene.model.strain_limit)
    model.strain_limit = StrainLimit{*scene.model.strain_limit,
                                     in_lines(gauge_edges(cloth), cloth.mesh.rest_positions)};
  return model;
}

BuildReport build_report(const ClothModel& model, const ModelOptions& options) {
  BuildReport report;
  const auto note = [&report](bool is_built, std::string_view part, std::size_t bytes) {
    (is_built ? report.built : report.left_out).emplace_back(part);
    if (is_built) report.bytes.push_back(bytes);
  };
  // Several kinds of element may build the same part.
  struct ModelPart {
    std::string_view name;
    bool is_built;
    std::size_t bytes;
  };
  std::vector<ModelPart> parts;
  for_each_element_kind(model, [&parts](const auto& kind) {
    kind.for_each_part([&parts](bool is_built, std::string_view name, std::size_t bytes) {
      const auto known = std::find_if(parts.begin(), parts.end(),
                                      [&](const ModelPart& part) { return part.name == name; });
      if (known == parts.end()) {
        parts.push_back({name, is_built, bytes});
      } else {
        known->is_built = known->is_built || is_built;
        known->bytes += bytes;
      }
    });
  });
  for (const ModelPart& part : parts) note(part.is_built, part.name, part.bytes);
  note(!model.gravity.isZero(), "gravity", sizeof model.gravity);
  note(!model.pins.empty(), "pins", bytes_of(model.pins));
  note(model.air.has_value(), "air drag", model.air ? model.air->bytes() : 0);
  note(model.air && model.air->has_wind(), "wind", 0);
  note(model.contact.has_value(), "contact", model.contact ? model.contact->bytes() : 0);
  note(model.self_contact.has_value(), "cloth contact",
       model.self_contact ? bytes_of(model.self_contact->faces) : 0);
  note(model.strain_limit.has_value(), "strain limit",
       model.strain_limit ? bytes_of(model.strain_limit->edges) : 0);
  note(options.tearing != nullptr, "tearing", options.tearing ? sizeof *options.tearing : 0);
  return report;
}

}  // namespace pleat
