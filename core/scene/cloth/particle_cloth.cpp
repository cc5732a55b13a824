#include "core/scene/cloth/particle_cloth.h"

#include "core/scene/vertex_arrays.h"

namespace pleat {
namespace {

Spring read_spring(const JsonReader& reader, const Positions& positions) {
  reader.allow_keys({"a", "b", "stiffness_n_per_m", "rest_length_m", "damping_n_s_per_m"});
  Spring spring;
  spring.a = read_vertex(reader.at("a"), positions.cols());
  spring.b = read_vertex(reader.at("b"), positions.cols());
  if (spring.a == spring.b) reader.at("b").fail("a particle other than a");
  spring.stiffness = reader.at("stiffness_n_per_m").number(kPositive);
  spring.rest_length = (positions.col(spring.a) - positions.col(spring.b)).norm();
  if (const auto at = reader.find("rest_length_m")) spring.rest_length = at->number(kNotNegative);
  if (const auto at = reader.find("damping_n_s_per_m")) spring.damping = at->number(kNotNegative);
  return spring;
}

BendElement read_bend(const JsonReader& reader, std::int64_t n_vertices) {
  constexpr double kRounding = 1e-9;  // share of the largest weight; a file may round its weights
  reader.allow_keys({"vertices", "stiffness_n_m3", "weights_per_m2"});
  BendElement bend;
  bend.vertices = read_vertices<3>(reader.at("vertices"), n_vertices);
  bend.stiffness = reader.at("stiffness_n_m3").number(kPositive);
  const JsonReader weights = reader.at("weights_per_m2");
  const Vec3 read = weights.vec3();
  if (std::abs(read.sum()) > kRounding * read.cwiseAbs().maxCoeff())
    throw InputError(weights.pointer(),
                     "expected weights that sum to zero, got a sum of " + Json(read.sum()).dump());
  bend.weights = {read[0], read[1], read[2]};
  return bend;
}

Json json_spring(const Spring& spring) {
  Json json;
  json["a"] = spring.a.value;
  json["b"] = spring.b.value;
  json["stiffness_n_per_m"] = spring.stiffness;
  json["rest_length_m"] = spring.rest_length;
  json["damping_n_s_per_m"] = spring.damping;
  return json;
}

Json json_bend(const BendElement& bend) {
  Json json;
  json["vertices"] = json_vertices(bend.vertices);
  json["stiffness_n_m3"] = bend.stiffness;
  json["weights_per_m2"] = bend.weights;
  return json;
}

}  // namespace

// Key by key, as write_scene does.
Json ParticleCloth::json() const {
  Json json;
  json["positions_m"] = json_columns(positions);
  json["velocities_m_per_s"] = json_columns(velocities);
  json["masses_kg"] = Json::array();
  for (const double mass : masses) json["masses_kg"].push_back(mass);
  json["springs"] = Json::array();
  for (const Spring& spring : springs) json["springs"].push_back(json_spring(spring));
  json["bends"] = Json::array();
  for (const BendElement& bend : bends) json["bends"].push_back(json_bend(bend));
  json["triangles"] = Json::array();
  for (const Triangle& triangle : triangles) json["triangles"].push_back(json_vertices(triangle));
  return json;
}

RestCloth ParticleCloth::at_rest(int) const {
  RestCloth cloth;
  cloth.mesh = {positions, triangles, {}};
  cloth.start = positions;
  cloth.start_velocities = velocities;
  cloth.given_springs = GivenSprings{masses, springs, bends};
  return cloth;
}

ParticleCloth read_particles(const JsonReader& reader) {
  reader.allow_keys(
      {"positions_m", "velocities_m_per_s", "masses_kg", "springs", "bends", "triangles"});
  ParticleCloth cloth;
  cloth.positions = read_positions(reader.at("positions_m"));
  const std::int64_t n = cloth.positions.cols();
  const auto n_elements = static_cast<std::size_t>(n);
  cloth.velocities = Positions::Zero(3, n);
  if (const auto at = reader.find("velocities_m_per_s"))
    cloth.velocities = read_columns(at->elements(n_elements));
  cloth.masses.resize(n);
  Eigen::Index particle = 0;
  for (const JsonReader& mass : reader.at("masses_kg").elements(n_elements))
    cloth.masses[particle++] = mass.number(kPositive);
  if (const auto at = reader.find("springs"))
    for (const JsonReader& spring : at->elements())
      cloth.springs.push_back(read_spring(spring, cloth.positions));
  if (const auto at = reader.find("bends"))
    for (const JsonReader& bend : at->elements()) cloth.bends.push_back(read_bend(bend, n));
  if (const auto at = reader.find("triangles"))
    for (const JsonReader& triangle : at->elements())
      cloth.triangles.push_back(read_vertices<3>(triangle, n));
  return cloth;
}

}  // namespace pleat
