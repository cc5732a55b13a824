#include "core/scene/cloth/garment_cloth.h"

#include "core/base/check.h"
#include "core/mesh/smooth_surface.h"

namespace pleat {
namespace {

template <class Measures>
struct LengthField {
  const char* key;
  double Measures::*field;
};
constexpr std::array<LengthField<SkirtMeasures>, 3> kSkirtLengths{
    {{"waist_ease_m", &SkirtMeasures::waist_ease},
     {"hem_girth_m", &SkirtMeasures::hem_girth},
     {"length_m", &SkirtMeasures::length}}};
constexpr std::array<LengthField<TrouserMeasures>, 4> kTrouserLengths{
    {{"waist_ease_m", &TrouserMeasures::waist_ease},
     {"hip_ease_m", &TrouserMeasures::hip_ease},
     {"inseam_m", &TrouserMeasures::inseam},
     {"ankle_opening_m", &TrouserMeasures::ankle_opening}}};

constexpr NumberRange kLength{-10, 10};  // [m]; the garment itself says which it takes
constexpr int kMostColumns = 400;        // makes 1e5 vertices with the rows

template <class Measures, std::size_t n>
Measures read_measures(const JsonReader& reader,
                       const std::array<LengthField<Measures>, n>& lengths) {
  std::vector<const char*> known{"columns"};
  for (const auto& length : lengths) known.push_back(length.key);
  reader.allow_keys(known);
  Measures measures;
  for (const auto& length : lengths)
    if (const auto at = reader.find(length.key)) measures.*length.field = at->number(kLength);
  if (const auto at = reader.find("columns"))
    measures.columns = static_cast<int>(at->integer(8, kMostColumns));
  return measures;
}

template <class Measures, std::size_t n>
Json json_measures(const Measures& measures, const std::array<LengthField<Measures>, n>& lengths) {
  Json json{{"columns", measures.columns}};
  for (const auto& length : lengths) json[length.key] = measures.*length.field;
  return json;
}

/// Makes a garment; an error about a measure names the measure's place in the scene.
template <class Make>
Garment made(const JsonReader& reader, Make&& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(reader.pointer() + error.where(), error.sentence());
  }
}

/// The group with the middles of edges whose ends are both in it.
VertexGroup refined(const VertexGroup& base, const QuadMesh& quads) {
  VertexGroup group{base.name, {}};
  std::vector<bool> inside(static_cast<std::size_t>(quads.n_vertices()), false);
  for (const VertexId v : base.vertices) inside[v] = true;
  for (int i = 0; i < quads.n_vertices(); ++i) {
    const VertexParents& parents = quads.parents()[static_cast<std::size_t>(i)];
    if (parents.count == 2) inside[i] = inside[parents.vertices[0]] && inside[parents.vertices[1]];
    if (inside[i]) group.vertices.emplace_back(i);
  }
  return group;
}

}  // namespace

Json GarmentCloth::json() const {
  if (const auto* skirt = std::get_if<SkirtMeasures>(&measures))
    return {{"skirt", json_measures(*skirt, kSkirtLengths)}};
  return {{"trousers", json_measures(std::get<TrouserMeasures>(measures), kTrouserLengths)}};
}

RestCloth GarmentCloth::at_rest(QuadMesh quads) const {
  RestCloth cloth = flat_rest_cloth(std::move(quads));
  cloth.start = on_smooth_surface(base_quads(), *cloth.quads);
  for (const VertexGroup& group : garment.groups)
    cloth.groups.push_back(refined(group, *cloth.quads));
  return cloth;
}

GarmentCloth read_garment(const JsonReader& reader, const SceneBody* body) {
  if (body == nullptr) reader.fail("no garment, as the scene has no figure to wear it");
  const BodyBuild build = body->build;
  GarmentCloth cloth;
  reader.allow_keys({"skirt", "trousers"});
  if (reader.only_one_of({"skirt", "trousers"}) == 0) {
    const JsonReader at = reader.at("skirt");
    const auto measures = read_measures(at, kSkirtLengths);
    cloth.measures = measures;
    cloth.garment = made(at, [&] { return skirt(measures, build); });
  } else {
    const JsonReader at = reader.at("trousers");
    const auto measures = read_measures(at, kTrouserLengths);
    cloth.measures = measures;
    cloth.garment = made(at, [&] { return trousers(measures, build); });
  }
  return cloth;
}

}  // namespace pleat
