#include "core/files/fabric_file.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/check.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

using nlohmann::json;

json fabric_document() { return json::parse(repository_file("assets/fabrics/fabrics.json")); }

struct BadFabric {
  const char* pointer;  // place of the value that is replaced, or of the object that lacks a key
  const char* replacement;  // JSON text, or that key
  const char* where;
  const char* sentence;
};

const BadFabric kBadFabrics[] = {
    {"/fabrics/0/areal_density_kg_per_m2/value", "-0.1", "/fabrics/0/areal_density_kg_per_m2/value",
     "expected a number > 0.0, got -0.1"},
    {"/fabrics/0/areal_density_kg_per_m2/value", "114", "/fabrics/0/areal_density_kg_per_m2/value",
     "expected a number inside its own range, 0.06 to 0.15, got 114"},
    {"/fabrics/2/thickness_m/range", "[0.002, 0.001]", "/fabrics/2/thickness_m/range",
     "expected a range [low, high] with low <= high, got an array of 2 values"},
    {"/fabrics/2/thickness_m/range", "[0.001]", "/fabrics/2/thickness_m/range",
     "expected an array of 2 values, got an array of 1 value"},
    {"/fabrics/3/shear_n_per_m/source", "[\"HEARSAY\"]", "/fabrics/3/shear_n_per_m/source/0",
     "expected a key of /meta/sources, got \"HEARSAY\""},
    {"/fabrics/3/shear_n_per_m/source", "[]", "/fabrics/3/shear_n_per_m/source",
     "expected at least one key of /meta/sources, got an array of 0 values"},
    {"/fabrics/4/damping_ratio/confidence", "\"certain\"", "/fabrics/4/damping_ratio/confidence",
     R"(expected one of "measured", "typical", "estimated", got "certain")"},
    {"/fabrics/5/shear_n_per_m",
     R"({"value": 2000, "range": [1, 3000], "source": ["SEED"], "confidence": "measured"})",
     "/fabrics/5/shear_n_per_m/value",
     "expected less than the geometric mean of the stretch stiffnesses, 1177.0556486419832, got "
     "2000"},
    {"/fabrics/6/name_en", "\"silk\"", "/fabrics/6/name_en",
     "expected a name that no other fabric has, got \"silk\""},
    {"/fabrics/6/id", "5", "/fabrics/6/id", "expected an id that no other fabric has, got 5"},
    {"/fabrics/7/bend_wrap_n_m", "1", "/fabrics/7/bend_wrap_n_m",
     R"(expected the key "bend_warp_n_m", got "bend_wrap_n_m")"},
    {"/fabrics/8/use_en", "7", "/fabrics/8/use_en", "expected a text in quotes, got 7"},
    {"/fabrics/9/seed_table/v_stretch", "0", "/fabrics/9/seed_table/v_stretch",
     "expected a number between 0.0 and 10.0, both excluded, got 0"},
    {"/fabrics/9/seed_table/v_bend", "10.5", "/fabrics/9/seed_table/v_bend",
     "expected a number between 0.0 and 10.0, both excluded, got 10.5"},
    {"/fabrics/9/seed_table/vn_recovery", "1.01", "/fabrics/9/seed_table/vn_recovery",
     "expected a number between 0.0 and 1.0, got 1.01"},
    {"/fabrics/9/seed_table/weight_bend_percent", "100.5",
     "/fabrics/9/seed_table/weight_bend_percent",
     "expected a number between 0.0 and 100.0, got 100.5"},
    {"/fabrics/9/seed_table/v_strech", "1", "/fabrics/9/seed_table/v_strech",
     R"(expected the key "v_stretch", got "v_strech")"},
    {"/fabrics", "[]", "/fabrics", "expected at least one fabric, got an array of 0 values"},
};

void check_refused(const json& document, const BadFabric& bad) {
  try {
    read_fabrics(document.dump());
    FAIL_CHECK("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == bad.where);
    CHECK(error.sentence() == bad.sentence);
  }
}

}  // namespace

TEST_CASE("fabric file: a fabric is found by either of its names", "[files]") {
  const FabricLibrary& library = fabric_library();
  const Fabric& denim = library.find("coarse cotton (denim)");
  CHECK(&library.find("denim") == &denim);
  CHECK(&library.find("coarse cotton") == &denim);
  for (const char* name : {"cotton", "(denim)", "denim)", "coarse cotton (", ""})
    CHECK_THROWS_AS(library.find(name), InputError);
  FabricLibrary both = library;
  both.fabrics[5].name = "denim";
  CHECK(&both.find("denim") == &both.fabrics[5]);
}

TEST_CASE("fabric file: all fifteen fabrics are read with range, confidence and sources",
          "[files]") {
  const FabricLibrary& library = fabric_library();
  REQUIRE(library.fabrics.size() == 15);
  const Fabric& denim = library.fabrics[1];
  CHECK(denim.id == 1);
  CHECK(denim.name == "coarse cotton (denim)");
  CHECK(denim.colour == "blue");
  CHECK(denim.use == "jeans");
  CHECK(denim.construction.find("twill") != std::string::npos);
  CHECK(denim.areal_density.value == 0.324);
  CHECK(denim.areal_density.low == 0.24);
  CHECK(denim.areal_density.high == 0.48);
  CHECK(denim.areal_density.confidence == Confidence::measured);
  CHECK(denim.friction_solid.confidence == Confidence::estimated);
  CHECK(denim.stretch_warp.value == 6000);
  CHECK(denim.stretch_weft.value == 3200);
  CHECK(denim.bend_warp.value == 30e-6);
  CHECK(denim.bend_weft.value == 16e-6);
  CHECK(denim.bend_hysteresis.value == 1.5e-3);
  for (const std::string& source : denim.bend_warp.sources)
    CHECK(library.sources.at(source).size() > 20);
  CHECK(denim.measured.recovery == 0.9896);
  CHECK(denim.measured.stretch == 1.0814);
  CHECK(denim.measured.bending == 0.9968);
  CHECK(denim.normalised.recovery == 1);
  CHECK(denim.normalised.stretch == 0.7794);
  CHECK(denim.normalised.bending == 0.5903);
  CHECK(denim.published_weights.recovery == Approx(0.422));
  CHECK(denim.published_weights.stretch == Approx(0.3289));
  CHECK(denim.published_weights.bending == Approx(0.2491));
}

TEST_CASE("fabric file: bad numbers are refused with their place", "[files]") {
  for (const BadFabric& bad : kBadFabrics) {
    CAPTURE(bad.pointer, bad.replacement);
    json document = fabric_document();
    document[json::json_pointer(bad.pointer)] = json::parse(bad.replacement);
    check_refused(document, bad);
  }
}

TEST_CASE("fabric file: a missing number is refused by name", "[files]") {
  const BadFabric missing = GENERATE(
      BadFabric{"/fabrics/8", "bend_weft_n_m", "/fabrics/8",
                "expected the key \"bend_weft_n_m\", got an object"},
      BadFabric{"/fabrics/8", "use_en", "/fabrics/8", "expected the key \"use_en\", got an object"},
      BadFabric{"/fabrics/8", "seed_table", "/fabrics/8",
                "expected the key \"seed_table\", got an object"},
      BadFabric{"/fabrics/8/seed_table", "vn_bend", "/fabrics/8/seed_table",
                "expected the key \"vn_bend\", got an object"});
  CAPTURE(missing.replacement);
  json document = fabric_document();
  document[json::json_pointer(missing.pointer)].erase(missing.replacement);
  check_refused(document, missing);
}

TEST_CASE("fabric file: a fabric whose normalised measures or weights are all zero is refused",
          "[files]") {
  using Keys = std::array<const char*, 3>;
  const auto [keys, sentence] = GENERATE(table<Keys, const char*>(
      {{{"vn_recovery", "vn_stretch", "vn_bend"},
        "expected this, vn_stretch or vn_bend above 0, got 0"},
       {{"weight_recovery_percent", "weight_stretch_percent", "weight_bend_percent"},
        "expected this, weight_stretch_percent or weight_bend_percent above 0, got 0"}}));
  json document = fabric_document();
  for (const char* key : keys) document["fabrics"][3]["seed_table"][key] = 0;
  const std::string where = std::string("/fabrics/3/seed_table/") + keys[0];
  check_refused(document, {"", "", where.c_str(), sentence});
}

TEST_CASE("fabric file: the published weights sum to a whole but for leather's", "[files]") {
  for (const Fabric& fabric : fabric_library().fabrics) {
    CAPTURE(fabric.name);
    const DeformWeights& weights = fabric.published_weights;
    // The printed numbers: three rounded percentages, and a slip in leather's row.
    const double printed = fabric.name == "leather" ? 0.99936 : 1;
    CHECK(weights.recovery + weights.stretch + weights.bending == Approx(printed).margin(1.5e-4));
  }
}

TEST_CASE("fabric file: the derived columns follow from the numbers", "[files]") {
  const FabricLibrary& library = fabric_library();
  const json document = fabric_document();
  for (const Fabric& fabric : library.fabrics) {
    CAPTURE(fabric.name);
    const json& derived =
        document.at("fabrics").at(static_cast<std::size_t>(fabric.id)).at("derived");
    const FabricConstants at_rest = constants(fabric, BendSource::at_rest);
    // The columns are rounded to four digits.
    CHECK(at_rest.bend_warp ==
          Approx(derived.at("static_bend_warp_n_m").get<double>()).epsilon(5e-4));
    CHECK(at_rest.bend_weft ==
          Approx(derived.at("static_bend_weft_n_m").get<double>()).epsilon(5e-4));
  }
}

}  // namespace pleat
