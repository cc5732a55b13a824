#include "core/scene/format/world_section.h"

#include <map>

#include "core/base/check.h"
#include "core/scene/format/bone_word.h"
#include "core/scene/format/solid_section.h"
#include "core/scene/format/surface_section.h"
#include "core/scene/rest_cloth.h"
#include "core/scene/vertex_arrays.h"
#include "core/scene/vertex_place.h"

namespace pleat {
namespace {

constexpr std::array<Word<Motion::Kind>, 5> kMotionKinds{{{"hold", Motion::Kind::hold},
                                                          {"move", Motion::Kind::move},
                                                          {"ease", Motion::Kind::ease},
                                                          {"oscillate", Motion::Kind::oscillate},
                                                          {"turn", Motion::Kind::turn}}};

constexpr std::array<Word<ContactResponse>, 2> kContactResponses{
    {{"resting", ContactResponse::resting}, {"uniform", ContactResponse::uniform}}};

constexpr double kFastestWind = 1000;  // [m/s]: that of a blast
constexpr std::int64_t kLargestSeed = std::int64_t{1} << 53;

void read_interval(const JsonReader& reader, Motion& motion) {
  if (const auto at = reader.find("begin_s")) motion.time_begin = at->number(kNotNegative);
  motion.time_end = reader.at("end_s").number(kNotNegative);
  if (motion.time_end < motion.time_begin)
    reader.at("end_s").fail("a time that is not before begin_s");
}

Motion read_motion(const JsonReader& reader) {
  Motion motion;
  motion.kind = reader.at("kind").word(kMotionKinds);
  switch (motion.kind) {
    case Motion::Kind::hold:
      reader.allow_keys({"kind"});
      break;
    case Motion::Kind::move:
    case Motion::Kind::ease:
      reader.allow_keys({"kind", "offset_m", "begin_s", "end_s"});
      motion.offset = reader.at("offset_m").vec3();
      read_interval(reader, motion);
      break;
    case Motion::Kind::oscillate:
      reader.allow_keys({"kind", "offset_m", "begin_s", "frequency_hz"});
      motion.offset = reader.at("offset_m").vec3();
      if (const auto at = reader.find("begin_s")) motion.time_begin = at->number(kNotNegative);
      motion.frequency = reader.at("frequency_hz").number(kPositive);
      break;
    case Motion::Kind::turn:
      reader.allow_keys({"kind", "point_m", "axis", "rad_per_s", "begin_s", "end_s"});
      if (const auto at = reader.find("point_m")) motion.centre = at->vec3();
      motion.axis = reader.at("axis").direction();
      motion.rate = reader.at("rad_per_s").number();
      read_interval(reader, motion);
      break;
    case Motion::Kind::follow:
      break;  // has no word of its own here
  }
  return motion;
}

Json json_motion(const Motion& motion) {
  Json json;
  json["kind"] = word_for(kMotionKinds, motion.kind);
  if (motion.kind == Motion::Kind::hold) return json;
  if (motion.kind == Motion::Kind::turn) {
    json["point_m"] = json_vec3(motion.centre);
    json["axis"] = json_vec3(motion.axis);
    json["rad_per_s"] = motion.rate;
  } else {
    json["offset_m"] = json_vec3(motion.offset);
  }
  json["begin_s"] = motion.time_begin;
  if (motion.kind == Motion::Kind::oscillate) {
    json["frequency_hz"] = motion.frequency;
  } else {
    json["end_s"] = motion.time_end;
  }
  return json;
}

bool same_motion(const PinRule& one, const PinRule& other) {
  const Motion& a = one.motion;
  const Motion& b = other.motion;
  return one.bone == other.bone && a.kind == b.kind && a.offset == b.offset &&
         a.time_begin == b.time_begin && a.time_end == b.time_end && a.frequency == b.frequency &&
         a.centre == b.centre && a.axis == b.axis && a.rate == b.rate;
}

/// The unrefined vertices that pins hold. The mesh, which may be large, is made at most once and
/// for boxes alone.
class BaseVertices {
 public:
  explicit BaseVertices(const ClothSource& cloth) : cloth_(cloth) {}

  std::vector<VertexId> of(const PinRule& pin) {
    if (const auto* listed = std::get_if<std::vector<VertexId>>(&pin.where)) return *listed;
    if (const auto* name = std::get_if<std::string>(&pin.where)) return cloth_.base_part(*name);
    if (!at_rest_) at_rest_ = cloth_.at_rest(0);
    return pinned_vertices(pin, *at_rest_);
  }

 private:
  const ClothSource& cloth_;
  std::optional<RestCloth> at_rest_;
};

PinRule read_pin(const JsonReader& reader, const Scene& scene) {
  reader.allow_keys({"part", "vertices", "box", "motion", "bone"});
  PinRule pin;
  switch (reader.only_one_of({"part", "vertices", "box"})) {
    case 0:
      pin.where = scene.cloth->read_part(reader.at("part"));
      break;
    case 1:
      pin.where = read_vertex_list(reader.at("vertices"), scene.cloth->n_vertices(0));
      break;
    default:
      pin.where = read_box(reader.at("box"));
  }
  if (const auto at = reader.find("motion")) pin.motion = read_motion(*at);
  if (const auto at = reader.find("bone")) {
    if (!scene.body) at->fail("no such key, as the scene has no figure");
    if (reader.find("motion")) at->fail("no such key beside a motion");
    pin.bone = read_bone(*at);
  }
  return pin;
}

/// Reads keys that solids of all kinds have.
template <class Solid>
Solid with_surroundings(const JsonReader& reader, const Scene& scene, Solid solid) {
  if (const auto at = reader.find("motion")) solid.motion = read_motion(*at);
  solid.friction = scene.fabric.friction_solid;
  if (const auto at = reader.find("friction")) solid.friction = at->number(kNotNegative);
  return solid;
}

void read_collider(const JsonReader& reader, const FileSource& files, Scene& scene) {
  std::vector<const char*> keys = solid_words();
  const std::size_t n_solids = keys.size();
  for (const char* word : surface_words()) keys.push_back(word);
  const std::vector<const char*> words = keys;
  keys.insert(keys.end(), {"motion", "friction"});
  reader.allow_keys(keys);
  const std::size_t found = reader.only_one_of(words);
  if (found < n_solids) {
    scene.colliders.push_back(with_surroundings(reader, scene, Collider{read_solid(reader), {}}));
    return;
  }
  if (!scene.cloth->is_surface())
    reader.at(words[found]).fail("a plane, a sphere or a capsule, as particles have no faces");
  scene.surface_solids.push_back(
      with_surroundings(reader, scene, read_surface(reader, words[found], files)));
}

template <class Solid>
Json json_collider(const char* word, Json shape, const Solid& solid) {
  Json json;
  json[word] = std::move(shape);
  json["motion"] = json_motion(solid.motion);
  json["friction"] = solid.friction;
  return json;
}

WindOptions read_wind(const JsonReader& reader) {
  reader.allow_keys({"velocity_m_per_s", "gust_intensity", "seed"});
  WindOptions wind;
  wind.velocity = reader.at("velocity_m_per_s").vec3();
  if (wind.velocity.norm() > kFastestWind)
    reader.at("velocity_m_per_s").fail("a wind of at most 1000 m/s");
  if (const auto at = reader.find("gust_intensity")) {
    wind.gust_intensity = at->number(kNotNegative);
    if (wind.gust_intensity > 1) at->fail("1 or less, as gusts are a part of the wind");
  }
  if (const auto at = reader.find("seed"))
    wind.seed = static_cast<std::uint64_t>(at->integer(0, kLargestSeed));
  return wind;
}

/// true, false, or an object that says what is not the fabric's.
std::optional<SelfContactOptions> read_self_contact(const JsonReader& reader) {
  SelfContactOptions options;
  if (!reader.is_object()) {
    if (!reader.boolean()) return std::nullopt;
    return options;
  }
  reader.allow_keys({"friction", "thickness_m"});
  if (const auto at = reader.find("friction")) options.friction = at->number(kNotNegative);
  if (const auto at = reader.find("thickness_m")) options.thickness = at->number(kPositive);
  return options;
}

AirOptions read_air(const JsonReader& reader) {
  reader.allow_keys({"density_kg_per_m3", "normal_coefficient", "tangent_coefficient", "wind"});
  AirOptions air;
  if (const auto at = reader.find("density_kg_per_m3")) air.density = at->number(kPositive);
  if (const auto at = reader.find("normal_coefficient"))
    air.normal_coefficient = at->number(kNotNegative);
  if (const auto at = reader.find("tangent_coefficient"))
    air.tangent_coefficient = at->number(kNotNegative);
  if (const auto at = reader.find("wind")) air.wind = read_wind(*at);
  return air;
}

Json json_wind(const WindOptions& wind) {
  Json json;
  json["velocity_m_per_s"] = json_vec3(wind.velocity);
  json["gust_intensity"] = wind.gust_intensity;
  json["seed"] = wind.seed;
  return json;
}

}  // namespace

void read_pins(const JsonReader& reader, Scene& scene) {
  BaseVertices base_vertices(*scene.cloth);
  std::map<std::int32_t, std::size_t> owner;  // the pin that a vertex belongs to
  for (const JsonReader& element : reader.elements()) {
    const PinRule pin = read_pin(element, scene);
    const std::vector<VertexId> vertices = base_vertices.of(pin);
    if (vertices.empty())
      element.at("box").fail("a box with a vertex of the unrefined cloth in it");
    for (const VertexId vertex : vertices) {
      const std::size_t first = owner.emplace(vertex.value, scene.pins.size()).first->second;
      if (first == scene.pins.size() || same_motion(scene.pins[first], pin)) continue;
      throw InputError(element.pointer(),
                       "expected one motion for each vertex, got a second one for vertex " +
                           std::to_string(vertex.value) + ", which " + reader.pointer() + "/" +
                           std::to_string(first) + " moves too");
    }
    scene.pins.push_back(pin);
  }
}

Json json_pins(const Scene& scene) {
  Json json = Json::array();
  for (const PinRule& pin : scene.pins) {
    Json element;
    if (const auto* name = std::get_if<std::string>(&pin.where)) {
      element["part"] = *name;
    } else if (const auto* box = std::get_if<PinBox>(&pin.where)) {
      element["box"]["low_m"] = json_vec3(box->low);
      element["box"]["high_m"] = json_vec3(box->high);
    } else {
      element["vertices"] = json_vertices(std::get<std::vector<VertexId>>(pin.where));
    }
    if (pin.bone)
      element["bone"] = bone_name(*pin.bone);
    else
      element["motion"] = json_motion(pin.motion);
    json.push_back(element);
  }
  return json;
}

void read_world(const JsonReader& reader, const FileSource& files, Scene& scene) {
  reader.allow_keys({"gravity_m_per_s2", "air", "colliders", "contact_response", "self_contact"});
  if (const auto at = reader.find("gravity_m_per_s2")) scene.gravity = at->vec3();
  if (const auto at = reader.find("air")) scene.air = read_air(*at);
  if (const auto at = reader.find("colliders"))
    for (const JsonReader& collider : at->elements()) read_collider(collider, files, scene);
  if (const auto at = reader.find("contact_response"))
    scene.contact_response = at->word(kContactResponses);
  if (const auto at = reader.find("self_contact")) {
    scene.self_contact = read_self_contact(*at);
    if (scene.self_contact && !scene.cloth->is_surface())
      at->fail("false, as particles have no faces");
  }
}

Json json_world(const Scene& scene) {
  Json json;
  json["gravity_m_per_s2"] = json_vec3(scene.gravity);
  if (scene.air) {
    json["air"]["density_kg_per_m3"] = scene.air->density;
    json["air"]["normal_coefficient"] = scene.air->normal_coefficient;
    json["air"]["tangent_coefficient"] = scene.air->tangent_coefficient;
    if (!scene.air->wind.is_still()) json["air"]["wind"] = json_wind(scene.air->wind);
  }
  json["colliders"] = Json::array();
  for (const Collider& collider : scene.colliders)
    json["colliders"].push_back(
        json_collider(word_for(collider.shape), json_solid(collider.shape), collider));
  for (const SurfaceSolid& solid : scene.surface_solids)
    json["colliders"].push_back(json_collider(word_for(solid), json_shape(solid), solid));
  if (scene.contact_response != ContactResponse::resting)
    json["contact_response"] = word_for(kContactResponses, scene.contact_response);
  if (scene.self_contact) {
    const auto& [friction, thickness] = *scene.self_contact;
    json["self_contact"] = true;
    if (friction || thickness) json["self_contact"] = Json::object();
    if (friction) json["self_contact"]["friction"] = *friction;
    if (thickness) json["self_contact"]["thickness_m"] = *thickness;
  }
  return json;
}

}  // namespace pleat
