#include "core/files/fabric_file.h"

#include <array>
#include <cmath>
#include <set>

#include "core/base/check.h"
#include "core/files/json_reader.h"

namespace pleat {
namespace {

constexpr std::array<Word<Confidence>, 3> kConfidences{{{"measured", Confidence::measured},
                                                        {"typical", Confidence::typical},
                                                        {"estimated", Confidence::estimated}}};
constexpr NumberRange kPercent{0, 100, NumberRange::Ends::included};
constexpr NumberRange kMeasure{0, 10, NumberRange::Ends::low_excluded};
constexpr NumberRange kShare{0, 1, NumberRange::Ends::included};

using Sources = std::map<std::string, std::string>;

/// The numbers of a fabric: where they stand in the file and in the struct, and which of them are
/// physical.
struct NumberField {
  const char* key;
  SourcedValue Fabric::*field;
  NumberRange range;
};
constexpr std::array<NumberField, 12> kNumberFields{
    {{"areal_density_kg_per_m2", &Fabric::areal_density, kPositive},
     {"thickness_m", &Fabric::thickness, kPositive},
     {"stretch_warp_n_per_m", &Fabric::stretch_warp, kPositive},
     {"stretch_weft_n_per_m", &Fabric::stretch_weft, kPositive},
     {"shear_n_per_m", &Fabric::shear, kPositive},
     {"bend_warp_n_m", &Fabric::bend_warp, kPositive},
     {"bend_weft_n_m", &Fabric::bend_weft, kPositive},
     {"bend_hysteresis_2hb_n", &Fabric::bend_hysteresis, kNotNegative},
     {"damping_ratio", &Fabric::damping_ratio, kNotNegative},
     {"friction_fabric_fabric", &Fabric::friction_fabric, kNotNegative},
     {"friction_fabric_solid", &Fabric::friction_solid, kNotNegative},
     {"drape_coefficient_percent", &Fabric::drape_coefficient, kPercent}}};

Sources read_sources(const JsonReader& reader) {
  Sources sources;
  for (const auto& [key, citation] : reader.members()) sources[key] = citation.text();
  return sources;
}

SourcedValue read_value(const JsonReader& reader, const NumberRange& range,
                        const Sources& sources) {
  reader.allow_keys({"value", "range", "source", "confidence"});
  SourcedValue value;
  value.value = reader.at("value").number(range);
  const std::vector<JsonReader> ends = reader.at("range").elements(2);
  value.low = ends[0].number(range);
  value.high = ends[1].number(range);
  if (value.low > value.high) reader.at("range").fail("a range [low, high] with low <= high");
  if (value.value < value.low || value.value > value.high)
    reader.at("value").fail("a number inside its own range, " + Json(value.low).dump() + " to " +
                            Json(value.high).dump());
  value.confidence = reader.at("confidence").word(kConfidences);
  for (const JsonReader& source : reader.at("source").elements()) {
    if (sources.count(source.text()) == 0) source.fail("a key of /meta/sources");
    value.sources.push_back(source.text());
  }
  if (value.sources.empty()) reader.at("source").fail("at least one key of /meta/sources");
  return value;
}

/// Numbers for recovery, stretch and bending; refused when all are zero.
template <class Three>
Three read_nonzero(const JsonReader& table, const std::array<const char*, 3>& keys,
                   const NumberRange& range) {
  const auto three = read_three<Three>(table, keys, range);
  if (three.recovery + three.stretch + three.bending == 0)
    table.at(keys[0]).fail(std::string("this, ") + keys[1] + " or " + keys[2] + " above 0");
  return three;
}

void read_table(const JsonReader& table, Fabric& fabric) {
  table.allow_keys({"source", "confidence", "v_recovery", "v_stretch", "v_bend", "vn_recovery",
                    "vn_stretch", "vn_bend", "weight_recovery_percent", "weight_stretch_percent",
                    "weight_bend_percent"});
  fabric.measured =
      read_nonzero<GeometricMeasures>(table, {"v_recovery", "v_stretch", "v_bend"}, kMeasure);
  fabric.normalised =
      read_nonzero<GeometricMeasures>(table, {"vn_recovery", "vn_stretch", "vn_bend"}, kShare);
  const auto percent = read_nonzero<DeformWeights>(
      table, {"weight_recovery_percent", "weight_stretch_percent", "weight_bend_percent"},
      kPercent);
  fabric.published_weights = {percent.recovery / 100, percent.stretch / 100, percent.bending / 100};
}

Fabric read_fabric(const JsonReader& reader, const Sources& sources) {
  std::vector<const char*> keys{
      "id",      "name_en",   "name_zh", "use_en", "use_zh", "colour_en", "assumed_construction",
      "derived", "seed_table"};
  for (const NumberField& number : kNumberFields) keys.push_back(number.key);
  reader.allow_keys(keys);
  Fabric fabric;
  fabric.id = static_cast<int>(reader.at("id").integer(0, 1000000));
  fabric.name = reader.at("name_en").text();
  fabric.colour = reader.at("colour_en").text();
  fabric.use = reader.at("use_en").text();
  fabric.construction = reader.at("assumed_construction").text();
  for (const NumberField& number : kNumberFields)
    fabric.*number.field = read_value(reader.at(number.key), number.range, sources);
  const double bound = shear_bound(fabric.stretch_warp.value, fabric.stretch_weft.value);
  if (fabric.shear.value >= bound)
    reader.at("shear_n_per_m")
        .at("value")
        .fail("less than the geometric mean of the stretch stiffnesses, " + Json(bound).dump());
  read_table(reader.at("seed_table"), fabric);
  return fabric;
}

/// True for "coarse cotton" and "denim" of "coarse cotton (denim)".
bool is_half_of(std::string_view whole, std::string_view name) {
  const std::size_t bracket = whole.find(" (");
  if (bracket == std::string_view::npos || whole.back() != ')') return false;
  return whole.substr(0, bracket) == name ||
         whole.substr(bracket + 2, whole.size() - bracket - 3) == name;
}

}  // namespace

const Fabric& FabricLibrary::find(std::string_view name) const {
  std::string known;
  for (const Fabric& fabric : fabrics) {
    if (fabric.name == name) return fabric;
    known += (known.empty() ? "" : ", ") + fabric.name;
  }
  for (const Fabric& fabric : fabrics)
    if (is_half_of(fabric.name, name)) return fabric;
  throw InputError("/fabric/name", "expected one of " + known + ", got " + abbreviated(Json(name)));
}

double shear_bound(double stretch_warp, double stretch_weft) {
  return std::sqrt(stretch_warp) * std::sqrt(stretch_weft);
}

FabricLibrary read_fabrics(std::string_view json_text) {
  const Json document = parse_json(json_text);
  const JsonReader root(document);
  root.allow_keys({"meta", "fabrics", "reference_materials"});
  FabricLibrary library;
  library.sources = read_sources(root.at("meta").at("sources"));
  std::set<std::string> names;
  std::set<int> ids;
  for (const JsonReader& reader : root.at("fabrics").elements()) {
    const Fabric fabric = read_fabric(reader, library.sources);
    if (!names.insert(fabric.name).second)
      reader.at("name_en").fail("a name that no other fabric has");
    if (!ids.insert(fabric.id).second) reader.at("id").fail("an id that no other fabric has");
    library.fabrics.push_back(fabric);
  }
  if (library.fabrics.empty()) root.at("fabrics").fail("at least one fabric");
  return library;
}

}  // namespace pleat
