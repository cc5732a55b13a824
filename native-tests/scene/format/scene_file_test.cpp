#include "core/scene/format/scene_file.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/scene/cloth/knit_cloth.h"
#include "core/scene/cloth/particle_cloth.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

struct BadScene {
  std::string text;
  std::string where;
  std::string sentence;
};

constexpr const char* kTexture = R"(, "texture_coordinates": [[0, 0], [1, 0], [0, 1], [1, 1]])";

/// A scene whose cloth is two triangles; `threads` and `rest` end its text.
std::string mesh_with(const std::string& threads, const std::string& rest) {
  return R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]],
             "triangles": [[0, 1, 2], [1, 3, 2]])" +
         threads + rest;
}

// One entry for each way in which a section can be wrong.
const BadScene kBadScenes[] = {
    // The text itself.
    {"", "line 1, column 1",
     "expected JSON, got an error while parsing value - unexpected end of input; expected '[', "
     "'{', or a literal"},
    {R"({"cloth": {"sheet": {}})", "line 1, column 24",
     "expected JSON, got an error while parsing object - unexpected end of input; expected '}'"},
    {"{\"cloth\":\n{\"sheet\": {\"width_m\": nan}}}", "line 2, column 24",
     "expected JSON, got \"nan\" while parsing value - invalid literal"},
    {"{\"cloth\":\n{\"sheet\": {\"width_m\": 1e999}}}", "line 2, column 23",
     "expected a number of at most 1.8e308 in size, got 1e999"},
    {R"({"cloth": {"sheet": {"rows": 1, "rows": 2}}})", "/cloth/sheet/rows",
     "expected each key once, got this one twice"},
    {"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[0]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
     "/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0",
     "expected at most 32 levels of nesting, got more"},
    // The whole.
    {"[]", "", "expected an object, got an array of 0 values"},
    {"{}", "", "expected the key \"cloth\", got an empty object"},
    {R"({"cloth": {"sheet": {}}, "gravity": 1})", "/gravity",
     R"(expected one of the keys "$schema", "name", "caption", "cloth", "fabric", "model", "figure", "refinement", )"
     R"("pins", "world", "method", "duration_s", "record", "start", got "gravity")"},
    {R"({"cloth": {"sheet": {}}, "duration": 1})", "/duration",
     R"(expected the key "duration_s", got "duration")"},
    {R"({"cloth": {"sheet": {}}, "name": 7})", "/name", "expected a text in quotes, got 7"},
    {R"({"cloth": {"sheet": {}}, "duration_s": 0})", "/duration_s",
     "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "duration_s": 1e13})", "/duration_s",
     "expected a number of at most 1e12 in size, got 10000000000000.0"},
    {R"({"cloth": {"sheet": {}}, "duration_s": 1000, "method": {"step_s": 1e-7}})", "/duration_s",
     "expected at most 1e9 steps of 1e-07 s, got 10000000000.0 steps"},
    {"{\"cloth\": {\"sheet\": {}}, \"duration_s\": 1" + std::string(400, '0') + "}",
     "line 1, column 40",
     "expected a number of at most 1.8e308 in size, got 1" + std::string(59, '0') + "..."},
    {"{\"cloth\": {\"sheet\": {}}, \"" + std::string(5000, 'k') + "\": 1}",
     "/" + std::string(60, 'k') + "...",
     "expected one of the keys \"$schema\", \"name\", \"caption\", \"cloth\", \"fabric\", "
     "\"model\", \"figure\", "
     "\"refinement\", \"pins\", \"world\", \"method\", \"duration_s\", \"record\", \"start\", got "
     "\"" +
         std::string(59, 'k') + "..."},
    // Cloth: sheet.
    {R"({"cloth": {}})", "/cloth",
     R"(expected one of the keys "sheet", "particles", "knit", "mesh", "garment", got an empty object)"},
    {R"({"cloth": {"sheet": {}, "particles": {}}})", "/cloth",
     R"(expected only one of the keys "sheet", "particles", "knit", "mesh", "garment", got several)"},
    {R"({"cloth": {"curtain": {}}})", "/cloth/curtain",
     R"(expected one of the keys "sheet", "particles", "knit", "mesh", "garment", got "curtain")"},
    {R"({"cloth": {"sheet": {"a/b~": 1}}})", "/cloth/sheet/a~1b~0",
     R"(expected one of the keys "width_m", "height_m", "columns", "rows", "origin_m", "warp_direction", )"
     R"("weft_direction", "initial_velocity_m_per_s", got "a/b~")"},
    {R"({"cloth": {"sheet": {"colums": 8}}})", "/cloth/sheet/colums",
     R"(expected the key "columns", got "colums")"},
    {R"({"cloth": {"sheet": {"initial_velocity": [0, 0, 0]}}})", "/cloth/sheet/initial_velocity",
     R"(expected the key "initial_velocity_m_per_s", got "initial_velocity")"},
    {R"({"cloth": {"sheet": {"width_m": "1 m"}}})", "/cloth/sheet/width_m",
     R"(expected a number > 0.0, got "1 m")"},
    {R"({"cloth": {"sheet": {"width_m": -1}}})", "/cloth/sheet/width_m",
     "expected a number > 0.0, got -1"},
    {R"({"cloth": {"sheet": {"columns": 2.5}}})", "/cloth/sheet/columns",
     "expected a whole number from 1 to 1000000, got 2.5"},
    {R"({"cloth": {"sheet": {"columns": 1e300}}})", "/cloth/sheet/columns",
     "expected a whole number from 1 to 1000000, got 1e+300"},
    {R"({"cloth": {"sheet": {"columns": 1000, "rows": 1000}}})", "/cloth/sheet",
     "expected at most 1000000 vertices, got 1002001"},
    {R"({"cloth": {"sheet": {"origin_m": [0, 0]}}})", "/cloth/sheet/origin_m",
     "expected an array of 3 numbers, got an array of 2 values"},
    {R"({"cloth": {"sheet": {"origin_m": [0, null, 0]}}})", "/cloth/sheet/origin_m/1",
     "expected a number, got null"},
    {R"({"cloth": {"sheet": {"warp_direction": [0, 0, 0]}}})", "/cloth/sheet/warp_direction",
     "expected a direction, got three zeros"},
    {R"({"cloth": {"sheet": {"warp_direction": [1, -1, 0]}}})", "/cloth/sheet/weft_direction",
     "expected a direction perpendicular to warp_direction, got one at 45.00000000000001 degrees"},
    // Cloth: particles.
    {R"({"cloth": {"particles": {"masses_kg": [1]}}})", "/cloth/particles",
     R"(expected the key "positions_m", got an object)"},
    {R"({"cloth": {"particles": {"positions_m": [], "masses_kg": []}}})",
     "/cloth/particles/positions_m", "expected 1 to 1000000 positions, got an array of 0 values"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1, 1]}}})",
     "/cloth/particles/masses_kg", "expected an array of 1 values, got an array of 2 values"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [0]}}})",
     "/cloth/particles/masses_kg/0", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1],
         "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1}]}}})",
     "/cloth/particles/springs/0/b", "expected a whole number from 0 to 0, got 1"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1],
         "springs": [{"a": 0, "b": 0, "stiffness_n_per_m": 1}]}}})",
     "/cloth/particles/springs/0/b", "expected a particle other than a, got 0"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1, 1],
         "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 0}]}}})",
     "/cloth/particles/springs/0/stiffness_n_per_m", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1, 1],
         "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1, "rest_length_m": -1}]}}})",
     "/cloth/particles/springs/0/rest_length_m", "expected a number >= 0.0, got -1"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "masses_kg": [1, 1, 1],
         "bends": [{"vertices": [0, 1, 1], "stiffness_n_m3": 1, "weights_per_m2": [1, -2, 1]}]}}})",
     "/cloth/particles/bends/0/vertices",
     "expected 3 different vertices, got an array of 3 values"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "masses_kg": [1, 1, 1],
         "bends": [{"vertices": [0, 1, 2], "stiffness_n_m3": 1, "weights_per_m2": [1, -1, 1]}]}}})",
     "/cloth/particles/bends/0/weights_per_m2",
     "expected weights that sum to zero, got a sum of 1.0"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1], "triangles": [[0, 1, 2]]}}})",
     "/cloth/particles/triangles/0/1", "expected a whole number from 0 to 0, got 1"},
    // Cloth: knit.
    {R"({"cloth": {"knit": {"columns": 1}}})", "/cloth/knit/columns",
     "expected a whole number from 2 to 1000000, got 1"},
    {R"({"cloth": {"knit": {"rows": 1000, "columns": 1001}}})", "/cloth/knit",
     "expected at most 1000000 vertices, got 1001000"},
    {R"({"cloth": {"knit": {"height_m": 0}}})", "/cloth/knit/height_m",
     "expected a number > 0.0, got 0"},
    {R"({"cloth": {"knit": {"warp_direction": [1, 0, 0]}}})", "/cloth/knit/warp_direction",
     R"(expected the key "wale_direction", got "warp_direction")"},
    {R"({"cloth": {"knit": {"wale_direction": [1, -1, 0]}}})", "/cloth/knit/course_direction",
     "expected a direction perpendicular to wale_direction, got one at 45.00000000000001 degrees"},
    {R"({"cloth": {"knit": {"particle_mass_kg": 0}}})", "/cloth/knit/particle_mass_kg",
     "expected a number > 0.0, got 0"},
    {R"({"cloth": {"knit": {"structural": {"stiffness_n_per_m": -1}}}})",
     "/cloth/knit/structural/stiffness_n_per_m", "expected a number > 0.0, got -1"},
    {R"({"cloth": {"knit": {"shear": {"damping_n_s_per_m": -0.1}}}})",
     "/cloth/knit/shear/damping_n_s_per_m", "expected a number >= 0.0, got -0.1"},
    {R"({"cloth": {"knit": {"bending": {"stiffness": 1}}}})", "/cloth/knit/bending/stiffness",
     R"(expected the key "stiffness_n_per_m", got "stiffness")"},
    {R"({"cloth": {"knit": {"pattern": {"plain_columns": 0, "lace_columns": 0}}}})",
     "/cloth/knit/pattern", "expected at least one plain or lace column, got none"},
    {R"({"cloth": {"knit": {"pattern": {"lace_columns": -1}}}})",
     "/cloth/knit/pattern/lace_columns", "expected a whole number from 0 to 1000000, got -1"},
    {R"({"cloth": {"knit": {"pattern": {"lace_stiffness": 0}}}})",
     "/cloth/knit/pattern/lace_stiffness", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"knit": {}}, "refinement": {"level": 1}})", "/refinement/level",
     "expected 0, as particles cannot be refined, got 1"},
    {R"({"cloth": {"knit": {}}, "model": {"elasticity": "membrane"}})", "/model/elasticity",
     R"(expected "springs" for particles, which have no area, got "membrane")"},
    {R"({"cloth": {"knit": {}}, "pins": [{"part": "hem"}]})", "/pins/0/part",
     R"(expected one of "upper_edge", "lower_edge", "left_edge", "right_edge", "upper_left", "upper_right", )"
     R"("lower_left", "lower_right", got "hem")"},
    // Cloth: mesh.
    {R"({"cloth": {"mesh": {}}})", "/cloth/mesh",
     R"(expected one of the keys "obj", "positions_m", got an empty object)"},
    {R"({"cloth": {"mesh": {"obj": "skirt.obj"}}})", "/cloth/mesh/obj",
     "expected a mesh written out in the scene, as no files can be read here, got \"skirt.obj\""},
    {R"({"cloth": {"mesh": {"obj": 7}}})", "/cloth/mesh/obj", "expected a text in quotes, got 7"},
    {R"({"cloth": {"mesh": {"obj": "skirt.obj", "groups": {}}}})", "/cloth/mesh/groups",
     R"(expected one of the keys "obj", "rest", "texture_scale_m", "warp_direction", "initial_velocity_m_per_s", got "groups")"},
    {R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0]]}}})", "/cloth/mesh",
     "expected the key \"triangles\", got an object"},
    {R"({"cloth": {"mesh": {"positions_m": [], "triangles": []}}})", "/cloth/mesh/positions_m",
     "expected 1 to 1000000 positions, got an array of 0 values"},
    {R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0]], "triangles": []}}})",
     "/cloth/mesh/positions_m/0", "expected every vertex in a triangle, got vertex 0 in none"},
    {R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0]], "triangles": [[0, 0, 0]]}}})",
     "/cloth/mesh/triangles/0", "expected 3 different vertices, got an array of 3 values"},
    {R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "triangles": [[0, 1, 2]]}}})",
     "/cloth/mesh/triangles/0",
     "expected a triangle with an area, got the vertices 0, 1 and 2 on a line"},
    {mesh_with("", "}}}"), "/cloth/mesh/triangles/0",
     "expected texture coordinates with an area, or \"warp_direction\" in the scene, to tell how "
     "the threads run, got neither"},
    {mesh_with(R"(, "texture_coordinates": [[0, 0], [1, 0], [2, 0], [0, 1]])", "}}}"),
     "/cloth/mesh/triangles/0",
     "expected texture coordinates with an area, or \"warp_direction\" in the scene, to tell how "
     "the threads run, got neither"},
    {mesh_with(R"(, "texture_coordinates": [[0, 0]])", "}}}"), "/cloth/mesh/texture_coordinates",
     "expected an array of 4 values, got an array of 1 value"},
    {mesh_with(R"(, "texture_coordinates": [[0, 0], [1, 0, 0], [0, 1], [1, 1]])", "}}}"),
     "/cloth/mesh/texture_coordinates/1",
     "expected an array of 2 values, got an array of 3 values"},
    {mesh_with(R"(, "warp_direction": [0, 0, 0])", "}}}"), "/cloth/mesh/warp_direction",
     "expected a direction, got three zeros"},
    {mesh_with(R"(, "warp_directions": [[1, 0, 0]])", "}}}"), "/cloth/mesh/warp_directions",
     "expected an array of 2 values, got an array of 1 value"},
    {mesh_with(R"(, "warp_directions": [[1, 0, 0], [0, 0, 1]])", "}}}"),
     "/cloth/mesh/warp_directions/1",
     "expected a direction that is not perpendicular to the triangle, got an array of 3 values"},
    {mesh_with(R"(, "warp_directions": [[1, 0, 0], [1, 0, 0]], "warp_direction": [1, 0, 0])",
               "}}}"),
     "/cloth/mesh/warp_directions",
     "expected either this or warp_direction, got an array of 2 values"},
    {mesh_with(kTexture, R"(, "groups": {"waist": []}}}})"), "/cloth/mesh/groups/waist",
     "expected at least one vertex, got an array of 0 values"},
    {mesh_with(kTexture, R"(, "groups": {"waist": [4]}}}})"), "/cloth/mesh/groups/waist/0",
     "expected a whole number from 0 to 3, got 4"},
    {mesh_with(kTexture, R"(}}, "refinement": {"level": 10}})"), "/refinement/level",
     "expected a whole number from 0 to 8, got 10"},
    // Fabric.
    {R"({"cloth": {"sheet": {}}, "fabric": {"name": "tweed"}})", "/fabric/name",
     "expected one of fine cotton, coarse cotton (denim), canvas, linen, ramie, silk, poplin, "
     "chiffon, spandex, "
     "polyester, nylon, gabardine, leather, wool, velvet, got \"tweed\""},
    {R"({"cloth": {"sheet": {}}, "fabric": {"name": "silk", "bending": "stiff"}})",
     "/fabric/bending", R"(expected one of "at_rest", "moving", "friction", got "stiff")"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"name": "silk", "shear_n_per_m": 1}})",
     "/fabric/shear_n_per_m",
     R"(expected one of the keys "name", "bending", "overrides", got "shear_n_per_m")"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"name": "silk", "overrides": {"damping_ratio": -1}}})",
     "/fabric/overrides/damping_ratio", "expected a number >= 0.0, got -1"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"bend_hysteresis_2hb_n": -1e-3}})",
     "/fabric/bend_hysteresis_2hb_n", "expected a number >= 0.0, got -0.001"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"name": "silk", "bending": "friction",
         "overrides": {"bend_hysteresis_2hb_n": -1}}})",
     "/fabric/overrides/bend_hysteresis_2hb_n", "expected a number >= 0.0, got -1"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"name": "silk",
         "overrides": {"bend_hysteresis_2hb_n": 1e-3}}})",
     "/fabric/overrides/bend_hysteresis_2hb_n",
     "expected only beside \"bending\": \"friction\", as other rigidities stand for friction or "
     "leave it out, got 0.001"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"bending": "moving"}})", "/fabric/bending",
     "expected only beside a fabric's name, as own numbers are taken as they are, got \"moving\""},
    {R"({"cloth": {"sheet": {}}, "fabric": {"areal_density_kg_per_m2": 0}})",
     "/fabric/areal_density_kg_per_m2", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "fabric": {"shear_n_per_m": 1000}})", "/fabric/shear_n_per_m",
     "expected less than the geometric mean of the stretch stiffnesses, 1000.0, got 1000.0"},
    // Model and refinement.
    {R"({"cloth": {"sheet": {}}, "model": {"shear": 1}})", "/model/shear",
     "expected true or false, got 1"},
    {R"({"cloth": {"sheet": {}}, "model": {"bending": "hinge"}})", "/model/bending",
     R"(expected one of "quadratic", "linear", "none" with springs, got "hinge")"},
    {R"({"cloth": {"sheet": {}}, "model": {"bending": "arc"}})", "/model/bending",
     R"(expected one of "quadratic", "linear", "fitted", "hinge", "none", got "arc")"},
    {R"({"cloth": {"sheet": {}}, "model": {"elasticity": "membrane", "bending": "linear"}})",
     "/model/bending", R"(expected one of "fitted", "hinge", "none" with membrane, got "linear")"},
    {R"({"cloth": {"sheet": {}}, "model": {"elasticity": "shell"}})", "/model/elasticity",
     R"(expected one of "springs", "membrane", got "shell")"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}},
         "model": {"elasticity": "membrane"}})",
     "/model/elasticity",
     R"(expected "springs" for particles, which have no area, got "membrane")"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}},
         "model": {"bending": "linear"}})",
     "/model/bending",
     R"(expected one of "quadratic", "none" with springs of particles, got "linear")"},
    {R"({"cloth": {"mesh": {"positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
         "triangles": [[0, 1, 2]], "warp_direction": [1, 0, 0]}},
         "model": {"elasticity": "springs"}})",
     "/model/elasticity",
     R"(expected "membrane" for a mesh, as springs follow the threads of a sheet, got "springs")"},
    {R"({"cloth": {"sheet": {}}, "model": {"elasticity": "membrane", "shear": true}})",
     "/model/shear", "expected no such key, as only springs can lack their shear, got true"},
    {R"({"cloth": {"sheet": {}}, "model": {"elasticity": "membrane", "damping": "isotropic"}})",
     "/model/damping",
     R"(expected no such key, as a membrane is damped in its strains alone, got "isotropic")"},
    {R"({"cloth": {"sheet": {}}, "model": {"stiffening_strain": -0.1}})",
     "/model/stiffening_strain", "expected a number >= 0.0, got -0.1"},
    {R"({"cloth": {"sheet": {}}, "model": {"hardness": 0.1}})", "/model/hardness",
     R"(expected one of the keys "elasticity", "bending", "shear", "damping", "stiffening_strain", )"
     R"("torsion", "stiffness_exponent", "strain_limit", "tearing", got "hardness")"},
    {R"({"cloth": {"sheet": {}}, "model": {"strain_limit": {"stretch": 0}}})",
     "/model/strain_limit/stretch", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "model": {"strain_limit": {"compression": 1.5}}})",
     "/model/strain_limit/compression",
     "expected 1 or less, as an edge has no negative length, got 1.5"},
    {R"({"cloth": {"sheet": {}}, "model": {"strain_limit": {"max_sweeps": 0}}})",
     "/model/strain_limit/max_sweeps", "expected a whole number from 1 to 10000, got 0"},
    {R"({"cloth": {"sheet": {}},
         "model": {"strain_limit": {}, "tearing": {"breaking_elongation": 0.1}}})",
     "/model/tearing/breaking_elongation",
     "expected a number below the strain limit's stretch, which no edge exceeds, got 0.1"},
    {R"({"cloth": {"sheet": {}}, "world": {"air": {"wind": {}}}})", "/world/air/wind",
     "expected the key \"velocity_m_per_s\", got an empty object"},
    {R"({"cloth": {"sheet": {}}, "world": {"air": {"wind": {"velocity_m_per_s": [2000, 0, 0]}}}})",
     "/world/air/wind/velocity_m_per_s",
     "expected a wind of at most 1000 m/s, got an array of 3 values"},
    {R"({"cloth": {"sheet": {}},
         "world": {"air": {"wind": {"velocity_m_per_s": [1, 0, 0], "gust_intensity": 2}}}})",
     "/world/air/wind/gust_intensity",
     "expected 1 or less, as gusts are a part of the wind, got 2"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}},
         "model": {"stiffening_strain": 0.1}})",
     "/model/stiffening_strain",
     "expected no such key, as particles have springs of their own, got 0.1"},
    {R"({"cloth": {"sheet": {}}, "model": {"torsion": 1}})", "/model/torsion",
     "expected no such key without fitted bending, got 1"},
    {R"({"cloth": {"sheet": {}}, "refinement": {"level": 9}})", "/refinement/level",
     "expected a whole number from 0 to 8, got 9"},
    {R"({"cloth": {"sheet": {"columns": 8, "rows": 8}}, "refinement": {"level": 7}})",
     "/refinement/level", "expected a level with at most 1000000 vertices, got 7 with 1050625"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}}, "refinement": {"level": 1}})",
     "/refinement/level", "expected 0, as particles cannot be refined, got 1"},
    // Pins.
    {R"({"cloth": {"sheet": {}}, "pins": {}})", "/pins", "expected an array, got an empty object"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "top"}]})", "/pins/0/part",
     R"(expected one of "upper_edge", "lower_edge", "left_edge", "right_edge", "upper_left", "upper_right", )"
     R"("lower_left", "lower_right", got "top")"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"vertices": [4]}]})", "/pins/0/vertices/0",
     "expected a whole number from 0 to 3, got 4"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"vertices": []}]})", "/pins/0/vertices",
     "expected at least one vertex, got an array of 0 values"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}}, "pins": [{"part": "upper_left"}]})",
     "/pins/0/part",
     "expected listed vertices or a box, as particles have no parts, got \"upper_left\""},
    {R"({"cloth": {"sheet": {}}, "pins": [{"box": {"low_m": [0, 0, 0]}}]})", "/pins/0/box",
     "expected the key \"high_m\", got an object"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"box": {"low_m": [0, 0, 1], "high_m": [1, 1, 0]}}]})",
     "/pins/0/box/low_m",
     "expected a corner that is nowhere above high_m, got an array of 3 values"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"box": {"low_m": [0, 0, 0.1], "high_m": [1, 1, 1]}}]})",
     "/pins/0/box", "expected a box with a vertex of the unrefined cloth in it, got an object"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"box": {"low_m": [0, -1, 0], "high_m": [1, 1, 0]}},
         {"vertices": [3], "motion": {"kind": "move", "offset_m": [1, 0, 0], "end_s": 1}}]})",
     "/pins/1",
     "expected one motion for each vertex, got a second one for vertex 3, which /pins/0 moves too"},
    {mesh_with(kTexture,
               R"(, "groups": {"hem": [0], "waist": [1]}}}, "pins": [{"part": "wiast"}]})"),
     "/pins/0/part", R"(expected the group "waist", got "wiast")"},
    {mesh_with(kTexture,
               R"(, "groups": {"hem": [0], "waist": [1]}}}, "pins": [{"part": "upper_edge"}]})"),
     "/pins/0/part", R"(expected one of the groups "hem", "waist", got "upper_edge")"},
    {mesh_with(kTexture, R"(}}, "pins": [{"part": "waist"}]})"), "/pins/0/part",
     "expected listed vertices or a box, as the mesh has no named group, got \"waist\""},
    {mesh_with(kTexture, R"(}}, "pins": [{"part": 7}]})"), "/pins/0/part",
     "expected a text in quotes, got 7"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge"},
         {"part": "left_edge", "motion": {"kind": "move", "offset_m": [1, 0, 0], "end_s": 1}}]})",
     "/pins/1",
     "expected one motion for each vertex, got a second one for vertex 0, which /pins/0 moves too"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge", "motion": {"kind": "hold", "end_s": 1}}]})",
     "/pins/0/motion/end_s", R"(expected only the key "kind", got "end_s")"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge",
         "motion": {"kind": "ease", "offset_m": [1, 0, 0], "begin_s": 2, "end_s": 1}}]})",
     "/pins/0/motion/end_s", "expected a time that is not before begin_s, got 1"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge",
         "motion": {"kind": "oscillate", "offset_m": [1, 0, 0], "frequency_hz": 0}}]})",
     "/pins/0/motion/frequency_hz", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge",
         "motion": {"kind": "turn", "axis": [0, 0, 0], "rad_per_s": 1, "end_s": 1}}]})",
     "/pins/0/motion/axis", "expected a direction, got three zeros"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge",
         "motion": {"kind": "turn", "axis": [1, 0, 0], "rad_per_s": 1, "begin_s": 2, "end_s": 1}}]})",
     "/pins/0/motion/end_s", "expected a time that is not before begin_s, got 1"},
    {R"({"cloth": {"sheet": {}}, "pins": [{"part": "upper_edge",
         "motion": {"kind": "turn", "axis": [1, 0, 0], "offset_m": [1, 0, 0], "end_s": 1}}]})",
     "/pins/0/motion/offset_m",
     R"(expected one of the keys "kind", "point_m", "axis", "rad_per_s", "begin_s", "end_s", got "offset_m")"},
    {R"({"cloth": {"sheet": {}}, "pins": [
         {"part": "upper_edge", "motion": {"kind": "turn", "axis": [1, 0, 0], "rad_per_s": 1, "end_s": 1}},
         {"part": "left_edge", "motion": {"kind": "turn", "axis": [1, 0, 0], "rad_per_s": 2, "end_s": 1}}]})",
     "/pins/1",
     "expected one motion for each vertex, got a second one for vertex 0, which /pins/0 moves too"},
    // World.
    {R"({"cloth": {"sheet": {}}, "world": {"gravity_m_per_s2": -9.81}})", "/world/gravity_m_per_s2",
     "expected an array of 3 numbers, got -9.81"},
    {R"({"cloth": {"sheet": {}}, "world": {"air": {"density_kg_per_m3": 0}}})",
     "/world/air/density_kg_per_m3", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"friction": 1}]}})", "/world/colliders/0",
     R"(expected one of the keys "plane", "sphere", "capsule", "box", "mesh", got an object)"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"sphere": {"radius_m": 0}}]}})",
     "/world/colliders/0/sphere/radius_m", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"box": {}}]}})", "/world/colliders/0/box",
     R"(expected the key "size_m", got an empty object)"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"box": {"size_m": [1, 0, 1]}}]}})",
     "/world/colliders/0/box/size_m/1", "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"box": {"size_m": [1, 1, 1],
         "y_direction": [1, 0, 0]}}]}})",
     "/world/colliders/0/box/y_direction",
     "expected a direction perpendicular to x_direction, got one at 0.0 degrees"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"mesh": {"obj": "a.obj"}}]}})",
     "/world/colliders/0/mesh/obj",
     R"(expected a mesh written out in the scene, as no files can be read here, got "a.obj")"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"mesh": {
         "positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "triangles": []}}]}})",
     "/world/colliders/0/mesh/triangles",
     "expected at least one triangle, got an array of 0 values"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"mesh": {
         "positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
         "triangles": [[0, 2, 1], [0, 1, 3], [1, 2, 3]]}}]}})",
     "/world/colliders/0/mesh",
     "expected a closed surface, got one triangle alone at the edge from vertex 0 to 2, at (0, "
     "0.5, "
     "0) m"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"mesh": {
         "positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
         "triangles": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 2, 3]]}}]}})",
     "/world/colliders/0/mesh",
     "expected neighbours wound alike, got two triangles that both go from vertex 0 to 2"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"mesh": {
         "positions_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1],
                         [0.2, 0.2, -1], [1.2, 0.2, -1], [0.2, 1.2, -1], [0.2, 0.2, 2]],
         "triangles": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2],
                       [4, 6, 5], [4, 5, 7], [5, 6, 7], [4, 7, 6]]}}]}})",
     "/world/colliders/0/mesh",
     "expected a surface that does not pass through itself, got 4 crossings, the first of the edge "
     "from vertex 1 to 2 at (0.8, 0.2, 0) m"},
    {R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]], "masses_kg": [1, 1],
         "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1}]}},
         "world": {"colliders": [{"box": {"size_m": [1, 1, 1]}}]}})",
     "/world/colliders/0/box",
     R"(expected a plane, a sphere or a capsule, as particles have no faces, got an object)"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"capsule": {"radius_m": -1}}]}})",
     "/world/colliders/0/capsule/radius_m", "expected a number > 0.0, got -1"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"plane": {"normal": [0, 0, 0]}}]}})",
     "/world/colliders/0/plane/normal", "expected a direction, got three zeros"},
    {R"({"cloth": {"sheet": {}}, "world": {"colliders": [{"plane": {}, "friction": -0.1}]}})",
     "/world/colliders/0/friction", "expected a number >= 0.0, got -0.1"},
    // Method and record.
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "euler"}})", "/method/stepper",
     R"(expected one of "implicit", "imex", "projective", "xpbd", "pbd", "hpbd", "multigrid", "explicit", "rk4", "newton", got "euler")"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "newton", "rule": "static"}})",
     "/method/rule",
     R"(expected one of "backward_euler", "midpoint", "equilibrium", got "static")"},
    {R"({"cloth": {"sheet": {}}, "method": {"step_s": 0}})", "/method/step_s",
     "expected a number > 0.0, got 0"},
    {R"({"cloth": {"sheet": {}}, "method": {"substeps": 0}})", "/method/substeps",
     "expected a whole number from 1 to 1000000, got 0"},
    {R"({"cloth": {"sheet": {}}, "method": {"substeps": "stable"}})", "/method/substeps",
     "expected a whole number, as implicit has no bound to be stable at, got \"stable\""},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "xpbd", "iterations": 0}})",
     "/method/iterations", "expected a whole number from 1 to 100000, got 0"},
    {R"({"cloth": {"sheet": {}}, "method": {"tolerance": 1}})", "/method/tolerance",
     "expected a number between 0.0 and 1.0, both excluded, got 1"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "imex", "omega": 2}})", "/method/omega",
     "expected a number between 0.0 and 2.0, both excluded, got 2"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "imex", "omega": "best"}})", "/method/omega",
     R"(expected a number or "estimated", got "best")"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "imex", "omega": 1.5}})", "/method/omega",
     "expected no such key beside the solver cg, but beside sor, got 1.5"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "implicit", "omega": 1.5}})",
     "/method/omega", "expected no such key, as implicit does not read it, got 1.5"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "multigrid", "ratio": 0.1}})",
     "/method/ratio", "expected a number between 0.1 and 0.9, both excluded, got 0.1"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "multigrid", "levels": -1}})",
     "/method/levels", "expected a whole number from 0 to 30, got -1"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "pbd", "smoother": "sor", "omega": 2}})",
     "/method/omega", "expected a number between 0.0 and 2.0, both excluded, got 2"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "pbd", "omega": 1.1}})", "/method/omega",
     "expected no such key beside a smoother other than sor and jacobi, got 1.1"},
    {R"({"cloth": {"sheet": {}}, "method": {"preconditioner": "geometric"}})",
     "/method/preconditioner",
     R"(expected one of "automatic", "incomplete_factor", "multigrid", got "geometric")"},
    {R"({"cloth": {"sheet": {}}, "method": {"solver": "sor", "preconditioner": "multigrid"}})",
     "/method/preconditioner",
     "expected no such key beside the solver sor, but beside cg, got \"multigrid\""},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "newton", "preconditioner": "multigrid",
         "solver": "eigen"}})",
     "/method/preconditioner",
     "expected no such key beside the solver eigen, but beside cg, got \"multigrid\""},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "xpbd", "preconditioner": "multigrid"}})",
     "/method/preconditioner", "expected no such key, as xpbd does not read it, got \"multigrid\""},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "xpbd", "constraints": true}})",
     "/method/constraints", R"(expected one of "compliant", "rigid", got true)"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "projective", "acceleration": 5}})",
     "/method/acceleration", R"(expected one of "none", "anderson", got 5)"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "imex", "explicit_share": 1.5}})",
     "/method/explicit_share", "expected a number between 0.0 and 1.0, got 1.5"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "explicit", "euler": "backward"}})",
     "/method/euler", R"(expected one of "symplectic", "forward", got "backward")"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "rk4", "beyond_bound": true}})",
     "/method/beyond_bound", R"(expected one of "refuse", "go_on", got true)"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "rk4", "euler": "forward"}})",
     "/method/euler", R"(expected no such key, as rk4 does not read it, got "forward")"},
    {R"({"cloth": {"sheet": {}}, "method": {"first_contact_m": -1}})", "/method/first_contact_m",
     "expected a number >= 0.0, got -1"},
    {R"({"cloth": {"sheet": {}}, "method": {"stepper": "xpbd", "first_contact_m": 1}})",
     "/method/first_contact_m", "expected no such key, as xpbd does not read it, got 1"},
    {R"({"cloth": {"sheet": {}}, "world": {"contact_response": "bouncing"}})",
     "/world/contact_response", R"(expected one of "resting", "uniform", got "bouncing")"},
    {R"({"cloth": {"sheet": {}}, "record": {"every_s": -1}})", "/record/every_s",
     "expected a number > 0.0, got -1"},
    {R"({"cloth": {"sheet": {}}, "record": {"format": "stl"}})", "/record/format",
     R"(expected one of "obj", "ply", "binary", "none", got "stl")"},
};

const char* const kRichScene = R"({
  "name": "rich", "caption": "Every option once, with numbers that do not end in binary.",
  "cloth": {"sheet": {"width_m": 0.3, "height_m": 0.7, "columns": 3, "rows": 5, "origin_m": [0.1, 2.3, -0.7],
            "warp_direction": [0, -2, 0.1], "weft_direction": [3, 0, 0], "initial_velocity_m_per_s": [0.1, 0, 0.3]}},
  "fabric": {"name": "silk", "bending": "friction",
             "overrides": {"damping_ratio": 0.013, "thickness_m": 0.0011, "bend_hysteresis_2hb_n": 0.0017}},
  "model": {"bending": "none", "shear": false, "damping": "isotropic",
            "strain_limit": {"law": "provot", "stretch": 0.07, "compression": 0.3, "max_sweeps": 12}},
  "refinement": {"level": 3},
  "pins": [{"part": "upper_edge", "motion": {"kind": "oscillate", "offset_m": [0, 0, 0.1], "frequency_hz": 0.7}},
           {"vertices": [9, 10], "motion": {"kind": "ease", "offset_m": [0.1, 0, 0], "begin_s": 0.1, "end_s": 0.3}},
           {"vertices": [11], "motion": {"kind": "move", "offset_m": [0.1, 0, 0], "end_s": 0.3}},
           {"part": "lower_left"}],
  "world": {"gravity_m_per_s2": [0, -1.62, 0],
            "air": {"density_kg_per_m3": 1.1, "normal_coefficient": 1.3, "tangent_coefficient": 0.03,
                    "wind": {"velocity_m_per_s": [3, 0, 1], "gust_intensity": 0.3, "seed": 7}},
            "colliders": [{"plane": {"point_m": [0, 0.1, 0], "normal": [0, 1, 1]}, "friction": 0.7},
                          {"sphere": {"centre_m": [0, 0.3, 0], "radius_m": 0.1},
                           "motion": {"kind": "oscillate", "offset_m": [0, 0, 0.1], "begin_s": 1, "frequency_hz": 2}},
                          {"plane": {"point_m": [0, -9, 0]},
                           "motion": {"kind": "turn", "point_m": [0, -9.1, 0.1], "axis": [1, 0, 2],
                                      "rad_per_s": -0.3, "begin_s": 0.2, "end_s": 1.3}},
                          {"capsule": {"a_m": [0, 0.2, 0], "b_m": [0.3, 0.2, 0.1], "radius_m": 0.07}},
                          {"box": {"centre_m": [3, 0, 0], "size_m": [0.1, 0.2, 0.3], "x_direction": [0, 2, 0],
                                   "y_direction": [-3, 0, 0]}, "friction": 0.9},
                          {"mesh": {"positions_m": [[0, 0, 7], [1, 0, 7], [0, 1, 7], [0, 0, 8]],
                                    "triangles": [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]},
                           "motion": {"kind": "move", "offset_m": [0, 0, 0.3], "end_s": 1}}]},
  "method": {"stepper": "explicit", "step_s": 0.003, "substeps": "stable"},
  "duration_s": 1.7, "record": {"every_s": 0.06, "format": "binary"}})";

const char* const kKnitScene = R"({
  "cloth": {"knit": {"width_m": 0.3, "height_m": 0.7, "columns": 5, "rows": 7, "origin_m": [0.1, 2.3, -0.7],
            "wale_direction": [0, -2, 0.1], "course_direction": [3, 0, 0], "particle_mass_kg": 0.003,
            "structural": {"stiffness_n_per_m": 1300, "damping_n_s_per_m": 0.1},
            "shear": {"stiffness_n_per_m": 170, "damping_n_s_per_m": 0.3},
            "bending": {"stiffness_n_per_m": 19, "damping_n_s_per_m": 0.7},
            "pattern": {"plain_columns": 2, "lace_columns": 1, "lace_stiffness": 0.7},
            "initial_velocity_m_per_s": [0.1, 0, 0.3]}},
  "pins": [{"part": "lower_right"}]})";

Scene read_text(const std::string& text) { return read_scene(text, fabric_library()); }

}  // namespace

TEST_CASE("scene file: bad input is refused with its place, what was expected and what was found",
          "[scene]") {
  CHECK(std::size(kBadScenes) >= 40);
  for (const BadScene& bad : kBadScenes) {
    CAPTURE(bad.text);
    try {
      read_text(bad.text);
      FAIL_CHECK("was accepted");
    } catch (const InputError& error) {
      CHECK(error.where() == bad.where);
      CHECK(error.sentence() == bad.sentence);
    }
  }
}

TEST_CASE("scene file: every number of a rich scene arrives in SI units", "[scene]") {
  const Scene scene = read_text(kRichScene);
  const SheetShape& sheet = scene.cloth.as<SheetCloth>()->shape;
  CHECK(scene.name == "rich");
  CHECK(sheet.width == 0.3);
  CHECK(sheet.height == 0.7);
  CHECK(sheet.columns == 3);
  CHECK(sheet.rows == 5);
  CHECK(sheet.origin == Vec3(0.1, 2.3, -0.7));
  CHECK(sheet.warp_direction.isApprox(Vec3(0, -2, 0.1).normalized(), 1e-15));
  CHECK(sheet.weft_direction == Vec3(1, 0, 0));
  CHECK(scene.cloth.as<SheetCloth>()->initial_velocity == Vec3(0.1, 0, 0.3));
  CHECK(scene.fabric_is_named);
  CHECK(scene.fabric.name == "silk");
  CHECK(scene.fabric.bend_warp == 2e-6);
  CHECK(scene.fabric.damping_ratio == 0.013);
  CHECK(scene.fabric.thickness == 0.0011);
  CHECK(scene.model.bending == BendingModel::none);
  CHECK_FALSE(scene.model.shear);
  CHECK(scene.model.damping_direction == DampingDirection::isotropic);
  REQUIRE(scene.model.strain_limit);
  CHECK(scene.model.strain_limit->law == StrainLimitLaw::provot);
  CHECK(scene.model.strain_limit->stretch == 0.07);
  CHECK(scene.model.strain_limit->compression == 0.3);
  CHECK(scene.model.strain_limit->max_sweeps == 12);
  CHECK(scene.level == 3);
  REQUIRE(scene.pins.size() == 4);
  CHECK(std::get<std::string>(scene.pins[0].where) == "upper_edge");
  CHECK(scene.pins[0].motion.frequency == 0.7);
  CHECK(std::get<std::vector<VertexId>>(scene.pins[1].where)[1] == VertexId(10));
  CHECK(scene.pins[1].motion.time_begin == 0.1);
  CHECK(scene.pins[1].motion.time_end == 0.3);
  CHECK(scene.pins[2].motion.kind == Motion::Kind::move);
  CHECK(scene.pins[3].motion.kind == Motion::Kind::hold);
  CHECK(scene.gravity == Vec3(0, -1.62, 0));
  REQUIRE(scene.air);
  CHECK(scene.air->density == 1.1);
  CHECK(scene.air->normal_coefficient == 1.3);
  CHECK(scene.air->tangent_coefficient == 0.03);
  CHECK(scene.air->wind.velocity == Vec3(3, 0, 1));
  CHECK(scene.air->wind.gust_intensity == 0.3);
  CHECK(scene.air->wind.seed == 7);
  REQUIRE(scene.colliders.size() == 4);
  CHECK(
      std::get<Plane>(scene.colliders[0].shape).normal.isApprox(Vec3(0, 1, 1).normalized(), 1e-15));
  CHECK(scene.colliders[0].friction == 0.7);
  CHECK(std::get<Sphere>(scene.colliders[1].shape).radius == 0.1);
  CHECK(scene.colliders[1].motion.frequency == 2);
  const Motion& turn = scene.colliders[2].motion;
  CHECK(turn.kind == Motion::Kind::turn);
  CHECK(turn.centre == Vec3(0, -9.1, 0.1));
  CHECK(turn.axis.isApprox(Vec3(1, 0, 2).normalized(), 1e-15));
  CHECK(turn.rate == -0.3);
  CHECK(turn.time_begin == 0.2);
  CHECK(turn.time_end == 1.3);
  const auto& capsule = std::get<RoundedCone>(scene.colliders[3].shape);
  CHECK(capsule.centre_a == Vec3(0, 0.2, 0));
  CHECK(capsule.centre_b == Vec3(0.3, 0.2, 0.1));
  CHECK(capsule.radius_a == 0.07);
  CHECK(capsule.radius_b == 0.07);
  REQUIRE(scene.surface_solids.size() == 2);
  const auto& box = std::get<BoxSolid>(scene.surface_solids[0].shape);
  CHECK(box.centre == Vec3(3, 0, 0));
  CHECK(box.size == Vec3(0.1, 0.2, 0.3));
  CHECK(box.x_direction == Vec3(0, 1, 0));
  CHECK(box.y_direction == Vec3(-1, 0, 0));
  CHECK(scene.surface_solids[0].friction == 0.9);
  const auto& mesh = std::get<MeshSolid>(scene.surface_solids[1].shape);
  CHECK(mesh.places.col(3) == Vec3(0, 0, 8));
  CHECK(scene.surface_solids[1].motion.offset == Vec3(0, 0, 0.3));
  CHECK(enclosed_volume(mesh.places, mesh.triangles) == Approx(1.0 / 6));
  CHECK(scene.method.stepper == &steppers::kExplicitEuler);
  CHECK(scene.method.step == 0.003);
  CHECK(scene.method.substeps == 0);
  CHECK(scene.duration == 1.7);
  CHECK(scene.record.every == 0.06);
  CHECK(scene.record.format == FrameFormat::binary);
}

TEST_CASE("scene file: every number of a knit arrives", "[scene]") {
  const Scene scene = read_text(kKnitScene);
  const auto& knit = *scene.cloth.as<KnitCloth>();
  CHECK(knit.shape.width == 0.3);
  CHECK(knit.shape.height == 0.7);
  CHECK(knit.n_vertices(0) == 35);
  CHECK(knit.shape.columns == 4);
  CHECK(knit.shape.origin == Vec3(0.1, 2.3, -0.7));
  CHECK(knit.shape.warp_direction.isApprox(Vec3(0, -2, 0.1).normalized(), 1e-15));
  CHECK(knit.shape.weft_direction == Vec3(1, 0, 0));
  CHECK(knit.particle_mass == 0.003);
  CHECK(knit.structural.stiffness == 1300);
  CHECK(knit.structural.damping == 0.1);
  CHECK(knit.shear.stiffness == 170);
  CHECK(knit.shear.damping == 0.3);
  CHECK(knit.bending.stiffness == 19);
  CHECK(knit.bending.damping == 0.7);
  CHECK(knit.pattern.plain_columns == 2);
  CHECK(knit.pattern.lace_columns == 1);
  CHECK(knit.pattern.lace_stiffness == 0.7);
  CHECK(knit.initial_velocity == Vec3(0.1, 0, 0.3));
  CHECK(knit.base_part("lower_right") == std::vector<VertexId>{VertexId(34)});
}

TEST_CASE("scene file: every setting of a method is read", "[scene]") {
  const auto method = [](const std::string& text) {
    return read_text(R"({"cloth": {"sheet": {}}, "method": )" + text + "}").method;
  };
  const MethodOptions xpbd =
      method(R"({"stepper": "xpbd", "substeps": 9, "iterations": 7, "constraints": "rigid"})");
  CHECK(xpbd.substeps == 9);
  CHECK(xpbd.iterations == 7);
  CHECK(xpbd.constraints == Constraints::rigid);
  const MethodOptions implicit = method(R"({"solver": "eigen", "tolerance": 1e-7})");
  CHECK(implicit.solver == SolverKind::eigen);
  CHECK(implicit.tolerance == 1e-7);
  CHECK(method(R"({"stepper": "newton", "rule": "midpoint"})").rule == NewtonRule::midpoint);
  const MethodOptions accelerated =
      method(R"({"stepper": "projective", "acceleration": "anderson"})");
  CHECK(accelerated.acceleration == Acceleration::anderson);
  const MethodOptions imex =
      method(R"({"stepper": "imex", "explicit_share": 0.5, "first_contact_m": 1e-6})");
  CHECK(imex.explicit_share == 0.5);
  CHECK(imex.first_contact == 1e-6);
  const MethodOptions forward =
      method(R"({"stepper": "explicit", "euler": "forward", "beyond_bound": "go_on"})");
  CHECK(forward.euler == EulerRule::forward);
  CHECK(forward.beyond_bound == BeyondBound::go_on);
}

TEST_CASE("scene file: what contact does is read, and written where it is not the usual",
          "[scene]") {
  const Scene scene =
      read_text(R"({"cloth": {"sheet": {}}, "world": {"contact_response": "uniform"}})");
  CHECK(scene.contact_response == ContactResponse::uniform);
  CHECK(read_text(write_scene(scene)).contact_response == ContactResponse::uniform);
  CHECK(write_scene(read_text(R"({"cloth": {"sheet": {}}})")).find("contact_response") ==
        std::string::npos);
}

TEST_CASE("scene file: a positive number may be as large as any, but not zero", "[scene]") {
  const auto stiffness = [](const char* number) {
    const std::string begin = R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [1, 0, 0]],
        "masses_kg": [1, 1], "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": )";
    const Scene scene = read_text(begin + number + "}]}}}");
    return scene.cloth.as<ParticleCloth>()->springs.at(0).stiffness;
  };
  CHECK(stiffness("1e12") == 1e12);
  CHECK_THROWS_AS(stiffness("1.0000001e12"), InputError);
  CHECK_THROWS_AS(stiffness("0"), InputError);
}

TEST_CASE("scene file: times are rounded to whole steps, at least one, and stay countable",
          "[scene]") {
  CHECK(whole_steps(0.05, 0.02) == 3);
  CHECK(whole_steps(0.001, 0.02) == 1);
  CHECK(whole_steps(1, 0.02) == 50);
  CHECK(whole_steps(1e12, 1e-300) == kMaxSteps);
}

TEST_CASE("scene file: a collider without friction takes the fabric's", "[scene]") {
  const Scene scene = read_text(kRichScene);
  CHECK(scene.colliders[1].friction == fabric_library().find("silk").friction_solid.value);
}

TEST_CASE("scene file: a spring without rest length is unstretched at time 0", "[scene]") {
  const Scene scene = read_text(
      R"({"cloth": {"particles": {"positions_m": [[0, 0, 0], [3, 4, 0]], "masses_kg": [1, 2],
                               "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 10}]}}})");
  const auto& cloth = *scene.cloth.as<ParticleCloth>();
  CHECK(cloth.springs.at(0).rest_length == 5);
  CHECK(cloth.masses[1] == 2);
  CHECK(cloth.velocities.isZero(0));
}

TEST_CASE("scene file: almost perpendicular directions become perpendicular", "[scene]") {
  const Scene scene =
      read_text(R"({"cloth": {"sheet": {"warp_direction": [0.7071068, 0.7071068, 1e-7],
                               "weft_direction": [0, 1e-7, 1]}}})");
  const SheetShape& sheet = scene.cloth.as<SheetCloth>()->shape;
  CHECK(std::abs(sheet.warp_direction.dot(sheet.weft_direction)) < 1e-15);
  CHECK(std::abs(sheet.weft_direction.norm() - 1) < 1e-15);
}

TEST_CASE("scene file: what was written is read back to the bit", "[scene]") {
  std::vector<std::string> texts{kRichScene, R"({"cloth": {"sheet": {}}})", kKnitScene};
  for (const char* name : kSceneFiles) texts.push_back(scene_text(name));
  for (const std::string& text : texts) {
    CAPTURE(text);
    const std::string written = write_scene(read_text(text));
    CHECK(write_scene(read_text(written)) == written);
  }
}

TEST_CASE("scene file: parts that one turn holds may share a vertex", "[scene]") {
  const Scene scene = read_text(R"({"cloth": {"sheet": {}}, "pins": [
      {"part": "upper_edge", "motion": {"kind": "turn", "axis": [3, 0, 0], "rad_per_s": 1, "end_s": 1}},
      {"part": "left_edge", "motion": {"kind": "turn", "axis": [1, 0, 0], "rad_per_s": 1, "end_s": 1}}]})");
  CHECK(scene.pins.size() == 2);
}

TEST_CASE("scene file: a number keeps every bit through the file", "[scene]") {
  Scene scene;
  const double seventh = 1.0 / 7;
  scene.gravity = {seventh, -seventh * 1e-300, 5e-324};
  scene.method.step = seventh;
  const Scene again = read_text(write_scene(scene));
  CHECK(again.gravity == scene.gravity);
  CHECK(again.method.step == scene.method.step);
}

TEST_CASE("scene file: every default is the one of the structs", "[scene]") {
  CHECK(write_scene(read_text(R"({"cloth": {"sheet": {}}})")) == write_scene(Scene{}));
}

TEST_CASE("scene file: the scenes that come with the program have a name and a caption",
          "[scene]") {
  for (const char* name : kSceneFiles) {
    CAPTURE(name);
    const Scene scene = read_text(scene_text(name));
    CHECK(scene.name != "unnamed");
    CHECK(scene.caption.size() > 40);
    CHECK(scene.caption.back() == '.');
  }
}

TEST_CASE("scene file: the example of the documentation is a scene", "[scene]") {
  const std::string page = repository_file("docs/methods/scene_format.md");
  const std::string fence = "```json\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const Scene scene = read_text(page.substr(begin, page.find("```", begin) - begin));
  CHECK(write_scene(scene).find("\"swinging sheet\"") != std::string::npos);
  CHECK(scene.pins.size() == 1);
}

TEST_CASE("scene file: each number of a scene's own fabric arrives in its place", "[scene]") {
  const Scene scene =
      read_text(R"({"cloth": {"sheet": {}}, "fabric": {"areal_density_kg_per_m2": 0.2,
      "thickness_m": 0.001, "stretch_warp_n_per_m": 3000, "stretch_weft_n_per_m": 2000,
      "shear_n_per_m": 40, "bend_warp_n_m": 5e-6, "bend_weft_n_m": 6e-6, "damping_ratio": 0.07,
      "friction_solid": 0.8}})");
  CHECK_FALSE(scene.fabric_is_named);
  CHECK(scene.fabric.areal_density == 0.2);
  CHECK(scene.fabric.thickness == 0.001);
  CHECK(scene.fabric.stretch_warp == 3000);
  CHECK(scene.fabric.stretch_weft == 2000);
  CHECK(scene.fabric.shear == 40);
  CHECK(scene.fabric.bend_warp == 5e-6);
  CHECK(scene.fabric.bend_weft == 6e-6);
  CHECK(scene.fabric.damping_ratio == 0.07);
  CHECK(scene.fabric.friction_solid == 0.8);
}

}  // namespace pleat
