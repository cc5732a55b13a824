#include "core/scene/garment_cloth.h"

#include "core/base/check.h"

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
constexpr int kMostColumns = 400;        // with their rows 1e5 vertices

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

/// What the garment says of a measure is said at its place in the scene.
template <class Make>
Garment made(const JsonReader& reader, Make&& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(reader.pointer() + error.where(), error.what());
  }
}

}  // namespace

GarmentCloth read_garment(const JsonReader& reader, const Scene& scene) {
  if (!scene.figure) reader.fail("no garment, as the scene has no figure to wear it");
  const BodyBuild build = scene.figure->build;
  reader.allow_keys({"skirt", "trousers"});
  if (reader.only_one_of({"skirt", "trousers"}) == 0) {
    const JsonReader at = reader.at("skirt");
    const auto measures = read_measures(at, kSkirtLengths);
    return {measures, made(at, [&] { return skirt(measures, build); })};
  }
  const JsonReader at = reader.at("trousers");
  const auto measures = read_measures(at, kTrouserLengths);
  return {measures, made(at, [&] { return trousers(measures, build); })};
}

Json json_garment(const GarmentCloth& cloth) {
  if (const auto* skirt = std::get_if<SkirtMeasures>(&cloth.measures))
    return {{"skirt", json_measures(*skirt, kSkirtLengths)}};
  return {{"trousers", json_measures(std::get<TrouserMeasures>(cloth.measures), kTrouserLengths)}};
}

}  // namespace pleat
