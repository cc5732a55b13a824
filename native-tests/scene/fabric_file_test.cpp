#include "core/scene/fabric_file.h"

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
  const char* pointer;      // of the value that is replaced
  const char* replacement;  // JSON text
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
    {"/fabrics", "[]", "/fabrics", "expected at least one fabric, got an array of 0 values"},
};

}  // namespace

TEST_CASE("fabric file: all fifteen fabrics are read with range, confidence and sources",
          "[scene]") {
  const FabricLibrary& library = fabric_library();
  REQUIRE(library.fabrics.size() == 15);
  const Fabric& denim = library.fabrics[1];
  CHECK(denim.id == 1);
  CHECK(denim.name == "coarse cotton (denim)");
  CHECK(denim.colour == "blue");
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
}

TEST_CASE("fabric file: bad numbers are refused with their place", "[scene]") {
  for (const BadFabric& bad : kBadFabrics) {
    CAPTURE(bad.pointer, bad.replacement);
    json document = fabric_document();
    document[json::json_pointer(bad.pointer)] = json::parse(bad.replacement);
    try {
      read_fabrics(document.dump());
      FAIL_CHECK("was accepted");
    } catch (const InputError& error) {
      CHECK(error.where() == bad.where);
      CHECK(std::string(error.what()) == bad.sentence);
    }
  }
}

TEST_CASE("fabric file: a missing number is refused by name", "[scene]") {
  json document = fabric_document();
  document["fabrics"][8].erase("bend_weft_n_m");
  try {
    read_fabrics(document.dump());
    FAIL_CHECK("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == "/fabrics/8");
    CHECK(std::string(error.what()) == "expected the key \"bend_weft_n_m\", got an object");
  }
}

TEST_CASE(
    "fabric file: the published weights of recovery, stretch and bend are there and sum to a whole",
    "[scene]") {
  const json document = fabric_document();
  for (const json& fabric : document.at("fabrics")) {
    CAPTURE(fabric.at("name_en").get<std::string>());
    const json& table = fabric.at("seed_table");
    const double sum = table.at("weight_recovery_percent").get<double>() +
                       table.at("weight_stretch_percent").get<double>() +
                       table.at("weight_bend_percent").get<double>();
    // As printed: three rounded percentages, and a slip in leather's row.
    const double printed = fabric.at("name_en") == "leather" ? 99.936 : 100;
    CHECK(sum == Approx(printed).margin(0.05));
  }
}

TEST_CASE("fabric file: the derived columns follow from the numbers", "[scene]") {
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
