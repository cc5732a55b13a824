#include "core/scene/deform/deform_scene.h"

#include <algorithm>
#include <map>

#include "core/base/check.h"
#include "core/deform/fabric_weights.h"
#include "core/deform/held_parts.h"
#include "core/mesh/sheet_pattern.h"
#include "core/scene/cloth/obj_cloth.h"
#include "core/scene/deform/target_section.h"
#include "core/scene/vertex_place.h"

namespace pleat {
namespace {

constexpr std::array<Word<SheetPattern>, 4> kPatterns{{{"one_way", SheetPattern::one_way},
                                                       {"alternating", SheetPattern::alternating},
                                                       {"crossed", SheetPattern::crossed},
                                                       {"equilateral", SheetPattern::equilateral}}};

constexpr std::array<Word<EnergyForm>, 2> kForms{
    {{name(EnergyForm::consistent), EnergyForm::consistent},
     {name(EnergyForm::published), EnergyForm::published}}};

constexpr std::array<Word<bool DeformTermChoice::*>, 3> kTerms{
    {{"recovery", &DeformTermChoice::recovery},
     {"stretch", &DeformTermChoice::stretch},
     {"bending", &DeformTermChoice::bending}}};

/// Coordinates of the corners along warp and weft [m].
CornerTexture sheet_texture(const SheetShape& shape, const TriangleMesh& mesh, const Triangle& t) {
  CornerTexture texture;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 from_corner = mesh.rest_positions.col(t[k]) - shape.origin;
    texture.col(static_cast<Eigen::Index>(k)) << from_corner.dot(shape.warp_direction),
        from_corner.dot(shape.weft_direction);
  }
  return texture;
}

/// Edges whole, corners as far as a hand grasps.
std::vector<VertexGroup> sheet_groups(const SheetShape& shape, const Positions& x) {
  const Vec3 u = shape.height * shape.warp_direction;
  const Vec3 v = shape.width * shape.weft_direction;
  const Vec3 corners[] = {shape.origin, shape.origin + v, shape.origin + u, shape.origin + u + v};
  std::vector<VertexGroup> groups;
  const auto add_edge = [&](const char* name, const Vec3& a, const Vec3& b) {
    constexpr double kRounding = 1e-9;  // share of the edge
    groups.push_back({name, {}});
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      if ((x.col(i) - a).cross(b - a).norm() <= kRounding * (b - a).squaredNorm())
        groups.back().vertices.emplace_back(i);
  };
  add_edge("upper_edge", corners[0], corners[1]);
  add_edge("lower_edge", corners[2], corners[3]);
  add_edge("left_edge", corners[0], corners[2]);
  add_edge("right_edge", corners[1], corners[3]);
  int corner = 0;
  for (const char* name : {"upper_left", "upper_right", "lower_left", "lower_right"})
    groups.push_back({name, vertices_near(x, corners[corner++], usual_grasp(x))});
  return groups;
}

/// Level, about the origin: right is along x, lower along z.
void read_sheet(const JsonReader& reader, DeformScene& scene) {
  reader.allow_keys({"width_m", "height_m", "vertices", "triangulation"});
  SheetShape shape;
  shape.width = reader.at("width_m").number(kPositive);
  shape.height = reader.at("height_m").number(kPositive);
  const std::vector<JsonReader> counts = reader.at("vertices").elements(2);
  shape.columns = static_cast<int>(counts[0].integer(2, kMaxVertices)) - 1;
  shape.rows = static_cast<int>(counts[1].integer(2, kMaxVertices)) - 1;
  shape.warp_direction = Vec3::UnitZ();
  shape.weft_direction = Vec3::UnitX();
  shape.origin = {-shape.width / 2, 0, -shape.height / 2};
  const SheetPattern pattern = reader.at("triangulation").word(kPatterns);
  const std::int64_t n_vertices = n_patterned_vertices(shape, pattern);
  if (n_vertices > kMaxVertices)
    throw InputError(reader.pointer(), "expected at most " + std::to_string(kMaxVertices) +
                                           " vertices, got " + std::to_string(n_vertices));
  scene.mesh = patterned_sheet(shape, pattern);
  for (const Triangle& t : scene.mesh.triangles)
    scene.textures.emplace_back(sheet_texture(shape, scene.mesh, t));
  scene.groups = sheet_groups(shape, scene.mesh.rest_positions);
}

void read_cloth(const JsonReader& reader, const FileSource& files, DeformScene& scene) {
  reader.allow_keys({"sheet", "mesh"});
  if (reader.only_one_of({"sheet", "mesh"}) == 0) return read_sheet(reader.at("sheet"), scene);
  const JsonReader at = reader.at("mesh");
  if (const auto velocity = at.find("initial_velocity_m_per_s"))
    velocity->fail("no velocity, as nothing moves by itself here");
  for (const char* key : {"rest", "pattern_m"})
    if (const auto rest = at.find(key))
      rest->fail("no such key, as shapes of least energy are measured from the mesh itself");
  // Threads make no difference to this energy, so that any direction will do.
  MeshCloth cloth = read_mesh_cloth(at, files, Vec3::UnitX());
  scene.mesh = std::move(cloth.mesh);
  scene.textures = std::move(cloth.textures);
  scene.groups = std::move(cloth.groups);
  scene.remark = std::move(cloth.skipped);
}

double sum(const DeformWeights& w) { return w.recovery + w.stretch + w.bending; }

/// One number for each term.
template <class Numbers>
Numbers read_numbers(const JsonReader& reader, const NumberRange& range) {
  constexpr std::array<const char*, 3> kKeys{"recovery", "stretch", "bending"};
  reader.allow_keys(kKeys);
  return read_three<Numbers>(reader, kKeys, range);
}

DeformWeights read_weights(const JsonReader& reader) {
  const auto weights = read_numbers<DeformWeights>(reader, kNotNegative);
  if (sum(weights) == 0)
    throw InputError(reader.pointer(), "expected a weight > 0, got three zeros");
  return weights;
}

FittedWeights read_measures(const JsonReader& reader, const FabricLibrary& fabrics) {
  const auto measures = read_numbers<GeometricMeasures>(reader, kPositive);
  try {
    return MeasureFit(fabrics.fabrics).fit(measures);
  } catch (const InputError& error) {
    throw InputError(reader.pointer() + error.where(), error.sentence());
  }
}

const Fabric& named_fabric(const JsonReader& reader, const FabricLibrary& fabrics) {
  const std::string& name = reader.text();
  try {
    return fabrics.find(name);
  } catch (const InputError& error) {
    throw InputError(reader.pointer(), error.sentence());
  }
}

void read_fabric(const JsonReader& root, const FabricLibrary& fabrics, DeformScene& scene) {
  switch (root.only_one_of({"fabric", "weights", "measures"})) {
    case 0:
      scene.fabric = root.at("fabric").text();
      scene.fabric_weights =
          recomputed_weights(named_fabric(root.at("fabric"), fabrics).normalised);
      break;
    case 1:
      scene.fabric_weights = read_weights(root.at("weights"));
      break;
    default:
      scene.fit = read_measures(root.at("measures"), fabrics);
      scene.fabric_weights = scene.fit->weights;
  }
}

DeformTermChoice read_terms(const JsonReader& reader) {
  DeformTermChoice terms{false, false, false};
  for (const JsonReader& term : reader.elements()) terms.*term.word(kTerms) = true;
  return terms;
}

std::vector<const char*> with_place_keys(std::initializer_list<const char*> keys) {
  std::vector<const char*> all(keys);
  all.insert(all.end(), std::begin(kPlaceKeys), std::end(kPlaceKeys));
  return all;
}

std::vector<VertexId> read_pins(const JsonReader& reader, const DeformScene& scene) {
  std::vector<VertexId> pins;
  for (const JsonReader& element : reader.elements()) {
    element.allow_keys(with_place_keys({}));
    const auto place = read_place(element, scene.mesh.rest_positions, scene.groups);
    pins.insert(pins.end(), place.begin(), place.end());
  }
  std::sort(pins.begin(), pins.end());
  pins.erase(std::unique(pins.begin(), pins.end()), pins.end());
  return pins;
}

std::vector<DeformHandle> read_handles(const JsonReader& reader, const Posing* posing,
                                       const DeformScene& scene) {
  std::vector<DeformHandle> handles;
  for (const JsonReader& element : reader.elements()) {
    element.allow_keys(with_place_keys({"name", "move_m", "onto_sphere", "turn", "bone"}));
    DeformHandle handle;
    handle.name = element.at("name").text();
    for (const DeformHandle& other : handles)
      if (other.name == handle.name) element.at("name").fail("a name that no other handle has");
    const Positions& rest = scene.mesh.rest_positions;
    handle.vertices = read_place(element, rest, scene.groups);
    Positions from(3, static_cast<Eigen::Index>(handle.vertices.size()));
    for (std::size_t k = 0; k < handle.vertices.size(); ++k)
      from.col(static_cast<Eigen::Index>(k)) = rest.col(handle.vertices[k]);
    handle.targets = read_targets(element, posing, from);
    handles.push_back(std::move(handle));
  }
  return handles;
}

/// A place and who holds a vertex there; a handle by its number, pins by -1.
struct Holder {
  int handle = -1;
  Vec3 target{0, 0, 0};
};

std::map<VertexId, Holder> holders(const DeformScene& scene) {
  constexpr double kRounding = 1e-9;  // share of the cloth's size; turns by nothing round that much
  const Positions& rest = scene.mesh.rest_positions;
  std::map<VertexId, Holder> holders;
  for (const VertexId v : scene.pins) holders[v] = {-1, rest.col(v)};
  for (std::size_t h = 0; h < scene.handles.size(); ++h) {
    const DeformHandle& handle = scene.handles[h];
    for (std::size_t k = 0; k < handle.vertices.size(); ++k) {
      const VertexId v = handle.vertices[k];
      const Vec3 target = handle.targets.col(static_cast<Eigen::Index>(k));
      const auto [known, is_new] = holders.try_emplace(v, Holder{static_cast<int>(h), target});
      const Holder& first = known->second;
      if (is_new || (first.target - target).norm() <= kRounding * box_diagonal(rest)) continue;
      throw InputError(
          "/handles/" + std::to_string(h),
          "expected one place for each vertex, got handle " + quotation(handle.name) +
              " with vertex " + std::to_string(v) + ", which " +
              (first.handle < 0
                   ? "is pinned where it rests"
                   : "handle " +
                         quotation(scene.handles[static_cast<std::size_t>(first.handle)].name) +
                         " takes elsewhere"));
    }
  }
  return holders;
}

const char* freedom(Hold hold) {
  switch (hold) {
    case Hold::none:
      return "that nothing holds";
    case Hold::point:
      return "that can turn about the one point where it is held";
    default:
      return "that can turn about the line on which it is held";
  }
}

}  // namespace

DeformWeights DeformTermChoice::chosen(const DeformWeights& weights) const {
  return {recovery ? weights.recovery : 0, stretch ? weights.stretch : 0,
          bending ? weights.bending : 0};
}

HeldVertices held_vertices(const DeformScene& scene) {
  const std::map<VertexId, Holder> all = holders(scene);
  HeldVertices held{{}, Positions(3, static_cast<Eigen::Index>(all.size()))};
  for (const auto& [vertex, holder] : all) {
    held.targets.col(static_cast<Eigen::Index>(held.vertices.size())) = holder.target;
    held.vertices.push_back(vertex);
  }
  return held;
}

void check_deform_scene(const DeformScene& scene) {
  const HeldVertices held = held_vertices(scene);
  const DeformWeights weights = scene.weights();
  if (sum(weights) == 0)
    throw InputError("/terms", "expected a term with a weight > 0, got none: every shape costs 0");
  if (weights.recovery > 0) return;
  const std::string expected =
      "expected pins and handles that leave one shape of least energy where no recovery weight "
      "counts, got ";
  if (held.vertices.empty())
    throw InputError("/pins", expected + "none: the equations are singular");
  for (const HeldPart& part : held_parts(scene.mesh, held.vertices, held.targets)) {
    if (part.hold == Hold::firm) continue;
    throw InputError("/pins", expected + "a part of " + std::to_string(part.n_vertices) +
                                  " vertices, of which " + std::to_string(part.first) +
                                  " is the first, " + freedom(part.hold) +
                                  ": the equations are singular");
  }
}

DeformScene read_deform_scene(std::string_view json_text, const FabricLibrary& fabrics,
                              const FileSource& files) {
  const Json document = parse_json(json_text);
  const JsonReader root(document);
  root.allow_keys({"name", "caption", "cloth", "figure", "pins", "handles", "fabric", "weights",
                   "measures", "form", "terms"});
  DeformScene scene;
  if (const auto at = root.find("name")) scene.name = at->text();
  if (const auto at = root.find("caption")) scene.caption = at->text();
  read_cloth(root.at("cloth"), files, scene);
  if (const auto at = root.find("pins")) scene.pins = read_pins(*at, scene);
  std::optional<Posing> posing;
  if (const auto at = root.find("figure")) posing = read_posing(*at, files);
  if (const auto at = root.find("handles"))
    scene.handles = read_handles(*at, posing ? &*posing : nullptr, scene);
  read_fabric(root, fabrics, scene);
  if (const auto at = root.find("form")) scene.form = at->word(kForms);
  if (const auto at = root.find("terms")) scene.terms = read_terms(*at);
  check_deform_scene(scene);
  return scene;
}

}  // namespace pleat
