#pragma once

#include <vector>

#include "core/files/json_reader.h"
#include "core/mesh/vertex_group.h"
#include "core/scene/scene.h"

namespace pleat {

/// The group that a text names.
const VertexGroup& read_group(const JsonReader& reader, const std::vector<VertexGroup>& groups);

/// The vertices of the group of this name; none when there is no such group.
std::vector<VertexId> vertices_of(const std::vector<VertexGroup>& groups, const std::string& name);

/// A box written as {"low_m", "high_m"}.
PinBox read_box(const JsonReader& reader);

/// The vertices in a box, ascending.
std::vector<VertexId> vertices_in(const PinBox& box, const Positions& positions);

/// How far a hand's grasp reaches unless it is said: in shares of the longest side of the box
/// around the cloth. A single vertex is a spike that no refinement converges to.
constexpr double kUsualGrasp = 0.05;

double usual_grasp(const Positions& positions);

/// The vertices no farther than `radius` [m] from a point [m], ascending; the nearest where there
/// is none.
std::vector<VertexId> vertices_near(const Positions& positions, const Vec3& point, double radius);

/// The keys of which a place on cloth has one.
constexpr const char* kPlaceKeys[] = {"vertices", "group", "box", "near"};

/// The vertices that one of kPlaceKeys of an object says, ascending, each once and at least one:
/// "vertices" lists them, "group" names them, "box" holds them, "near" is {"point_m", "radius_m"},
/// the latter by default the usual grasp. Throws InputError for a point from which the nearest
/// vertex is farther than the diagonal of the box around the cloth.
///
/// positions  of the cloth at rest [m]
std::vector<VertexId> read_place(const JsonReader& reader, const Positions& positions,
                                 const std::vector<VertexGroup>& groups);

}  // namespace pleat
