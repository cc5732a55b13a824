#include "core/scene/cloth/knit_cloth.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr SheetWords kKnitWords{"wale_direction", "course_direction", 1};

/// Offset of a particle's neighbour, and the spring that leads there.
struct SpringReach {
  int rows, columns;
  SpringKind kind;
};

constexpr std::array<SpringReach, 6> kReaches{{{1, 0, SpringKind::warp},
                                               {0, 1, SpringKind::weft},
                                               {1, 1, SpringKind::shear},
                                               {1, -1, SpringKind::shear},
                                               {2, 0, SpringKind::bend},
                                               {0, 2, SpringKind::bend}}};

const KnitSpring& spring_of(const KnitCloth& cloth, SpringKind kind) {
  if (kind == SpringKind::shear) return cloth.shear;
  return kind == SpringKind::bend ? cloth.bending : cloth.structural;
}

/// rest  [m], row by row
std::vector<Spring> knit_springs(const KnitCloth& cloth, const Positions& rest) {
  const int n_rows = cloth.shape.rows + 1;
  const int n_columns = cloth.shape.columns + 1;
  const auto stiffness_at = [&](int column) {
    return cloth.pattern.is_lace(column) ? cloth.pattern.lace_stiffness : 1;
  };
  std::vector<Spring> springs;
  for (const SpringReach& reach : kReaches) {
    const auto [stiffness, damping] = spring_of(cloth, reach.kind);
    for (int r = 0; r < n_rows - reach.rows; ++r)
      for (int c = std::max(0, -reach.columns); c < n_columns - std::max(0, reach.columns); ++c) {
        const VertexId a(std::int64_t{r} * n_columns + c);
        const VertexId b(a + reach.rows * n_columns + reach.columns);
        const double share = (stiffness_at(c) + stiffness_at(c + reach.columns)) / 2;
        const double length = (rest.col(a) - rest.col(b)).norm();
        springs.push_back({a, b, share * stiffness, length, damping, reach.kind});
      }
  }
  return springs;
}

void read_spring_of(const JsonReader& reader, const char* key, KnitSpring& spring) {
  const auto at = reader.find(key);
  if (!at) return;
  at->allow_keys({"stiffness_n_per_m", "damping_n_s_per_m"});
  if (const auto k = at->find("stiffness_n_per_m")) spring.stiffness = k->number(kPositive);
  if (const auto c = at->find("damping_n_s_per_m")) spring.damping = c->number(kNotNegative);
}

void read_knit_pattern(const JsonReader& reader, KnitPattern& pattern) {
  reader.allow_keys({"plain_columns", "lace_columns", "lace_stiffness"});
  const auto read_columns = [&](const char* key, int& columns) {
    if (const auto at = reader.find(key)) columns = static_cast<int>(at->integer(0, kMaxVertices));
  };
  read_columns("plain_columns", pattern.plain_columns);
  read_columns("lace_columns", pattern.lace_columns);
  if (const auto at = reader.find("lace_stiffness")) pattern.lace_stiffness = at->number(kPositive);
  if (pattern.plain_columns + pattern.lace_columns == 0)
    throw InputError(reader.pointer(), "expected at least one plain or lace column, got none");
}

Json json_knit_spring(const KnitSpring& spring) {
  Json json;
  json["stiffness_n_per_m"] = spring.stiffness;
  json["damping_n_s_per_m"] = spring.damping;
  return json;
}

}  // namespace

// Key by key, as write_scene does.
Json KnitCloth::json() const {
  Json json = json_sheet_shape(kKnitWords, shape);
  json["particle_mass_kg"] = particle_mass;
  json["structural"] = json_knit_spring(structural);
  json["shear"] = json_knit_spring(shear);
  json["bending"] = json_knit_spring(bending);
  Json& columns = json["pattern"];
  columns["plain_columns"] = pattern.plain_columns;
  columns["lace_columns"] = pattern.lace_columns;
  columns["lace_stiffness"] = pattern.lace_stiffness;
  json["initial_velocity_m_per_s"] = json_vec3(initial_velocity);
  return json;
}

RestCloth KnitCloth::at_rest(int) const {
  RestCloth cloth = flat_rest_cloth(QuadMesh::sheet(shape));
  cloth.quads.reset();
  cloth.start_velocities = initial_velocity.replicate(1, cloth.start.cols());
  cloth.groups = sheet_part_groups(shape, cloth.rest_coordinates);
  cloth.given_springs = GivenSprings{Eigen::VectorXd::Constant(cloth.start.cols(), particle_mass),
                                     knit_springs(*this, cloth.start),
                                     {}};
  return cloth;
}

KnitCloth read_knit(const JsonReader& reader) {
  reader.allow_keys({"width_m", "height_m", "columns", "rows", "origin_m", "wale_direction",
                     "course_direction", "particle_mass_kg", "structural", "shear", "bending",
                     "pattern", "initial_velocity_m_per_s"});
  KnitCloth cloth;
  read_sheet_shape(reader, kKnitWords, cloth.shape);
  if (const auto at = reader.find("particle_mass_kg")) cloth.particle_mass = at->number(kPositive);
  read_spring_of(reader, "structural", cloth.structural);
  read_spring_of(reader, "shear", cloth.shear);
  read_spring_of(reader, "bending", cloth.bending);
  if (const auto at = reader.find("pattern")) read_knit_pattern(*at, cloth.pattern);
  if (const auto at = reader.find("initial_velocity_m_per_s")) cloth.initial_velocity = at->vec3();
  return cloth;
}

}  // namespace pleat
