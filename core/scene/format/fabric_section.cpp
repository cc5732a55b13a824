#include "core/scene/format/fabric_section.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr std::array<Word<BendSource>, 3> kBendSources{{{"at_rest", BendSource::at_rest},
                                                        {"moving", BendSource::moving},
                                                        {"friction", BendSource::friction}}};

constexpr const char* kHysteresisKey = "bend_hysteresis_2hb_n";

struct FabricNumber {
  const char* key;
  double FabricConstants::*field;
  NumberRange range;
};
constexpr std::array<FabricNumber, 11> kNumberFields{
    {{"areal_density_kg_per_m2", &FabricConstants::areal_density, kPositive},
     {"thickness_m", &FabricConstants::thickness, kNotNegative},
     {"stretch_warp_n_per_m", &FabricConstants::stretch_warp, kPositive},
     {"stretch_weft_n_per_m", &FabricConstants::stretch_weft, kPositive},
     {"shear_n_per_m", &FabricConstants::shear, kNotNegative},
     {"bend_warp_n_m", &FabricConstants::bend_warp, kNotNegative},
     {"bend_weft_n_m", &FabricConstants::bend_weft, kNotNegative},
     {"damping_ratio", &FabricConstants::damping_ratio, kNotNegative},
     {"friction_solid", &FabricConstants::friction_solid, kNotNegative},
     {"friction_fabric", &FabricConstants::friction_fabric, kNotNegative},
     {kHysteresisKey, &FabricConstants::bend_hysteresis, kNotNegative}}};

/// Reads the numbers that are there; the others stay as they are. Returns the keys read.
std::vector<std::string> read_numbers(const JsonReader& reader, FabricConstants& fabric) {
  std::vector<const char*> known;
  known.reserve(kNumberFields.size());
  for (const FabricNumber& number : kNumberFields) known.push_back(number.key);
  reader.allow_keys(known);
  std::vector<std::string> keys;
  for (const FabricNumber& number : kNumberFields) {
    const auto at = reader.find(number.key);
    if (!at) continue;
    fabric.*number.field = at->number(number.range);
    keys.emplace_back(number.key);
  }
  const double bound = shear_bound(fabric.stretch_warp, fabric.stretch_weft);
  if (fabric.shear >= bound)
    throw InputError(reader.pointer() + "/shear_n_per_m",
                     "expected less than the geometric mean of the stretch stiffnesses, " +
                         Json(bound).dump() + ", got " + Json(fabric.shear).dump());
  return keys;
}

/// False of numbers without which the scene moves as it does with them.
bool is_asked_for(const FabricNumber& number, const Scene& scene) {
  if (number.field == &FabricConstants::bend_hysteresis) return scene.fabric.bend_hysteresis > 0;
  if (number.field == &FabricConstants::friction_fabric) return scene.self_contact.has_value();
  return true;
}

}  // namespace

void read_fabric(const JsonReader& reader, const FabricLibrary& fabrics, Scene& scene) {
  scene.fabric_is_named = reader.find("name").has_value();
  if (!scene.fabric_is_named) {
    if (const auto at = reader.find("bending"))
      at->fail("only beside a fabric's name, as own numbers are taken as they are");
    read_numbers(reader, scene.fabric);
    return;
  }
  reader.allow_keys({"name", "bending", "overrides"});
  if (const auto at = reader.find("bending")) scene.bend_source = at->word(kBendSources);
  scene.fabric = constants(fabrics.find(reader.at("name").text()), scene.bend_source);
  const auto overrides = reader.find("overrides");
  if (!overrides) return;
  scene.fabric_overrides = read_numbers(*overrides, scene.fabric);
  if (const auto at = overrides->find(kHysteresisKey);
      at && scene.bend_source != BendSource::friction)
    at->fail(
        "only beside \"bending\": \"friction\", as other rigidities stand for friction or leave "
        "it out");
}

Json json_fabric(const Scene& scene) {
  Json numbers = Json::object();
  for (const FabricNumber& number : kNumberFields) {
    const auto& keys = scene.fabric_overrides;
    if ((!scene.fabric_is_named && is_asked_for(number, scene)) ||
        std::find(keys.begin(), keys.end(), number.key) != keys.end())
      numbers[number.key] = scene.fabric.*number.field;
  }
  if (!scene.fabric_is_named) return numbers;
  Json json;
  json["name"] = scene.fabric.name;
  json["bending"] = word_for(kBendSources, scene.bend_source);
  if (!numbers.empty()) json["overrides"] = numbers;
  return json;
}

}  // namespace pleat
