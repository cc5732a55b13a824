#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "core/refinement/mesh_match.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/solid_section.h"
#include "core/scene/format/surface_section.h"
#include "native-tests/scene/schema_walk.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/scene_schema.h"

namespace pleat {
namespace {

using nlohmann::json;

// Scenes of required keys alone, so that everything else in the written scene is a default.
const char* const kShortScenes[] = {
    R"({"cloth": {"sheet": {}}, "world": {"air": {},
        "colliders": [{"plane": {}}, {"sphere": {}}, {"capsule": {}}, {"box": {"size_m": [1, 1, 1]}}]},
        "pins": [{"part": "upper_left", "motion": {"kind": "ease", "offset_m": [1, 0, 0], "end_s": 1}},
                 {"part": "lower_left", "motion": {"kind": "move", "offset_m": [1, 0, 0], "end_s": 1}},
                 {"vertices": [1], "motion": {"kind": "oscillate", "offset_m": [1, 0, 0], "frequency_hz": 1}},
                 {"vertices": [3], "motion": {"kind": "turn", "axis": [0, 2, 0], "rad_per_s": -1, "end_s": 1}}]})",
    R"({"cloth": {"sheet": {}}, "fabric": {"name": "silk"}})",
    R"({"cloth": {"sheet": {}}, "model": {"strain_limit": {}},
        "world": {"air": {"wind": {"velocity_m_per_s": [5, 0, 1]}}}})",
    R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1, 1],
        "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1}]}}})",
    R"({"cloth": {"knit": {}}})",
    R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
        "triangles": [[0, 1, 2]], "warp_direction": [1, 0, 0]}}})",
    R"({"cloth": {"garment": {"skirt": {}}}, "figure": {"motion": "turn.json"}})",
    R"({"cloth": {"garment": {"trousers": {}}}, "figure": {"motion": "turn.json"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "imex"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "projective"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "xpbd"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "pbd"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "hpbd"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "multigrid"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "explicit"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "rk4"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "newton"}})",
};

// Scenes with keys that no short one has.
const char* const kFurtherScenes[] = {
    R"({"cloth": {"mesh": {"obj": "triangle.obj", "warp_direction": [1, 0, 0],
        "initial_velocity_m_per_s": [0, 1, 0]}}})",
    R"({"cloth": {"mesh": {"obj": "triangle.obj", "rest": "texture", "texture_scale_m": 0.5}}})",
    R"({"cloth": {"mesh": {"obj": "triangle.obj"}}, "start": "triangle.obj"})",
    R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "triangles": [[0, 1, 2]],
        "texture_coordinates": [[0, 0], [2, 0], [0, 1]], "rest": "texture", "texture_scale_m": 0.5}}})",
    R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "triangles": [[0, 1, 2]],
        "pattern_m": [[[0, 0], [1, 0], [0, 1]]]}}})",
    R"({"$schema": "scene_schema.json", "cloth": {"sheet": {}},
        "fabric": {"name": "silk", "overrides": {"shear_n_per_m": 3}}})",
    R"({"cloth": {"sheet": {}}, "fabric": {"bend_hysteresis_2hb_n": 0.001}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "explicit", "substeps": "stable"}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "multigrid", "smoother_before": "sor",
        "omega": 1.2, "level_lengths": "chord", "attachments": "none", "ratio": 0.5, "levels": 2,
        "carried_acceleration": 0.3}})",
    R"({"cloth": {"sheet": {}}, "method": {"stepper": "newton", "solver": "cg",
        "preconditioner": "multigrid"}})",
    R"({"cloth": {"sheet": {}}, "world": {"contact_response": "uniform"}})",
    R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"mesh": {"obj": "pyramid.obj"}},
        {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
         "triangles": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}}]}})",
    R"({"cloth": {"sheet": {}}, "world": {"self_contact": true}})",
    R"({"cloth": {"sheet": {}}, "world": {"self_contact": {"friction": 0.5, "thickness_m": 1e-3}}})",
    R"({"cloth": {"sheet": {}}, "model": {"elasticity": "membrane", "stiffening_strain": 0.06}})",
    R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "masses_kg": [1, 1, 1],
        "bends": [{"vertices": [0, 1, 2], "stiffness_n_m3": 1, "weights_per_m2": [1, -2, 1]}],
        "triangles": [[0, 1, 2]]}}})",
    R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "triangles": [[0, 1, 2]],
        "warp_direction": [1, 0, 0], "texture_coordinates": [[0, 0], [1, 0], [0, 1]],
        "groups": {"waist": [0, 1]}}},
        "pins": [{"part": "waist"}, {"box": {"low_m": [0, 0, 0], "high_m": [0, 0, 1]}}]})",
    R"({"cloth": {"garment": {"skirt": {}}}, "model": {"stiffness_exponent": 0.5},
        "figure": {"build": "slim", "motion": "turn.json", "friction": 0.2},
        "pins": [{"part": "waist", "bone": "pelvis"}]})",
    R"({"cloth": {"sheet": {}}, "refinement": {"plan": "plan.json"}})",
    R"({"cloth": {"sheet": {}}, "model": {"tearing": {"breaking_elongation": 0.3}}})",
};

/// One face that is split once.
std::string plan_of_unit_sheet() {
  RefinementPlan plan;
  plan.examples = {{"flutter", BendFeatures::Zero(2, 3)}};
  plan.patterns = {2, 2, 2, 2};
  plan.options.level_cap = 1;
  plan.splits = {{FaceId(0), 8}};
  plan.n_vertices = 9;
  plan.base_mesh = base_fingerprint(QuadMesh::sheet({}));
  plan.curvature_limits = {1, 2, 3};
  return plan_text(plan);
}

json schema() { return json::parse(repository_file("core/scene/scene_schema.json")); }

json written(const std::string& text) {
  const FileSource files = [](const std::string& name) -> std::string {
    if (name == "turn.json") return repository_file("assets/motions/turn.json");
    if (name == "plan.json") return plan_of_unit_sheet();
    if (name == "pyramid.obj")
      return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 0 2\nf 1/1 2/2 3/3\n";
  };
  return json::parse(write_scene(read_scene(text, fabric_library(), files)));
}

}  // namespace

TEST_CASE("scene schema: what the reader accepts and the writer writes is valid", "[scene]") {
  const json document = schema();
  SchemaWalk walk(document);
  std::vector<std::string> texts(std::begin(kShortScenes), std::end(kShortScenes));
  texts.insert(texts.end(), std::begin(kFurtherScenes), std::end(kFurtherScenes));
  for (const char* name : kSceneFiles) texts.push_back(scene_text(name));
  CHECK_THAT(walk.violation(json::parse(scene_text("skirt"))), Catch::Equals(""));
  for (const std::string& text : texts) {
    CAPTURE(text);
    CHECK_THAT(walk.violation(json::parse(text)), Catch::Equals(""));
    CHECK_THAT(walk.violation(written(text)), Catch::Equals(""));
  }
}

TEST_CASE("scene schema: every property of the schema is read", "[scene]") {
  const json document = schema();
  SchemaWalk walk(document);
  for (const char* text : kShortScenes)
    CHECK_THAT(walk.violation(written(text)), Catch::Equals(""));
  for (const char* text : kFurtherScenes) {
    CHECK_THAT(walk.violation(json::parse(text)), Catch::Equals(""));
    CHECK_THAT(walk.violation(written(text)), Catch::Equals(""));
  }
  CHECK(walk.all_properties().size() > 70);
  std::vector<std::string> unread;
  std::set_difference(walk.all_properties().begin(), walk.all_properties().end(),
                      walk.seen_properties().begin(), walk.seen_properties().end(),
                      std::back_inserter(unread));
  CHECK_THAT(unread, Catch::Equals(std::vector<std::string>{}));
}

TEST_CASE("scene schema: its defaults are those of the structs", "[scene]") {
  const json document = schema();
  int n_defaults = 0;
  for (const char* text : kShortScenes) {
    const json given = json::parse(text);
    SchemaWalk walk(document);
    walk.visit = [&](const json& property, const json& value, const std::string& pointer) {
      if (!property.contains("default") || given.contains(json::json_pointer(pointer))) return;
      CAPTURE(pointer);
      ++n_defaults;
      CHECK(value == property["default"]);
    };
    CHECK_THAT(walk.violation(written(text)), Catch::Equals(""));
  }
  CHECK(n_defaults > 60);
}

TEST_CASE("scene schema: unknown keys, wrong types and values out of range are not valid",
          "[scene]") {
  const json document = schema();
  SchemaWalk walk(document);
  const auto violation = [&](const char* text) { return walk.violation(json::parse(text)); };
  CHECK(violation(R"({})") == " required cloth");
  CHECK(violation(R"({"cloth": {}})") == "/cloth minProperties");
  CHECK(violation(R"({"cloth": {"sheet": {"colums": 8}}})") ==
        "/cloth/sheet/colums additionalProperties");
  CHECK(violation(R"({"cloth": {"sheet": {"columns": 2.5}}})") == "/cloth/sheet/columns type");
  CHECK(violation(R"({"cloth": {"sheet": {"width_m": 0}}})") ==
        "/cloth/sheet/width_m exclusiveMinimum");
  CHECK(violation(R"({"cloth": {"mesh": {"obj": "a.obj", "groups": {}}}})") ==
        "/cloth/mesh 0 choices");
  CHECK(violation(R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0]], "triangles": [[0, 1, 2]],
                                         "groups": {"waist": []}}}})") == "/cloth/mesh 0 choices");
  CHECK(violation(R"({"cloth": {"sheet": {}}, "method": {"stepper": "euler"}})") ==
        "/method 0 choices");
  CHECK(violation(R"({"cloth": {"sheet": {}}, "method": {"substeps": 0}})") ==
        "/method/substeps 0 choices");
  CHECK(violation(R"({"cloth": {"sheet": {}}, "method": {"iterations": 2}})") ==
        "/method 0 choices");
}

TEST_CASE("scene schema: every solid that a scene can name is in it", "[scene]") {
  std::vector<const char*> words = solid_words();
  for (const char* word : surface_words()) words.push_back(word);
  for (const char* word : words) {
    CAPTURE(word);
    CHECK(schema()["$defs"]["collider"]["properties"].contains(word));
  }
}

TEST_CASE("scene schema: the file has the table's steppers and their settings", "[scene]") {
  CHECK(json::parse(scene_schema(standard_steppers()).dump()) == schema());
}

}  // namespace pleat
