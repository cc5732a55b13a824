#include "core/scene/format/model_section.h"

#include <algorithm>

#include "core/scene/tearing.h"

namespace pleat {
namespace {

constexpr std::array<Word<Elasticity>, 2> kElasticities{
    {{"springs", Elasticity::springs}, {"membrane", Elasticity::membrane}}};

constexpr std::array<Word<BendingModel>, 5> kBendingModels{{{"quadratic", BendingModel::quadratic},
                                                            {"linear", BendingModel::linear},
                                                            {"fitted", BendingModel::fitted},
                                                            {"hinge", BendingModel::hinge},
                                                            {"none", BendingModel::none}}};

constexpr std::array<Word<DampingDirection>, 2> kDampingDirections{
    {{"along_spring", DampingDirection::along_spring}, {"isotropic", DampingDirection::isotropic}}};

constexpr std::array<Word<StrainLimitLaw>, 2> kStrainLimitLaws{
    {{"velocity", StrainLimitLaw::velocity}, {"provot", StrainLimitLaw::provot}}};
constexpr int kMostSweeps = 10000;

bool is_quads(const Scene& scene) { return scene.cloth->quads() != nullptr; }
bool is_mesh(const Scene& scene) { return scene.cloth->is_surface() && !is_quads(scene); }

BendingModel usual_bending(Elasticity elasticity) {
  return elasticity == Elasticity::springs ? BendingModel::quadratic : BendingModel::fitted;
}

/// The bending laws that go with an elasticity and a cloth.
std::vector<BendingModel> possible_bending(const Scene& scene) {
  if (scene.model.elasticity == Elasticity::membrane)
    return {BendingModel::fitted, BendingModel::hinge, BendingModel::none};
  if (!is_quads(scene)) return {BendingModel::quadratic, BendingModel::none};
  return {BendingModel::quadratic, BendingModel::linear, BendingModel::none};
}

void check_elasticity(const JsonReader& reader, const Scene& scene) {
  const bool wants_membrane = scene.model.elasticity == Elasticity::membrane;
  if (wants_membrane && !scene.cloth->is_surface())
    reader.fail("\"springs\" for particles, which have no area");
  if (!wants_membrane && is_mesh(scene))
    reader.fail("\"membrane\" for a mesh, as springs follow the threads of a sheet");
}

void check_bending(const JsonReader& reader, const Scene& scene) {
  const std::vector<BendingModel> possible = possible_bending(scene);
  if (std::find(possible.begin(), possible.end(), scene.model.bending) != possible.end()) return;
  std::string expected = "one of";
  for (const BendingModel law : possible)
    expected +=
        std::string(law == possible.front() ? " \"" : ", \"") + word_for(kBendingModels, law) + '"';
  reader.fail(expected + " with " + word_for(kElasticities, scene.model.elasticity) +
              (scene.cloth->is_surface() ? "" : " of particles"));
}

StrainLimitOptions read_strain_limit(const JsonReader& reader) {
  reader.allow_keys({"law", "stretch", "compression", "max_sweeps"});
  StrainLimitOptions limit;
  if (const auto at = reader.find("law")) limit.law = at->word(kStrainLimitLaws);
  if (const auto at = reader.find("stretch")) limit.stretch = at->number(kPositive);
  if (const auto at = reader.find("compression")) {
    limit.compression = at->number(kPositive);
    if (limit.compression > 1) at->fail("1 or less, as an edge has no negative length");
  }
  if (const auto at = reader.find("max_sweeps"))
    limit.max_sweeps = static_cast<int>(at->integer(1, kMostSweeps));
  return limit;
}

Json json_strain_limit(const StrainLimitOptions& limit) {
  Json json;
  json["law"] = word_for(kStrainLimitLaws, limit.law);
  json["stretch"] = limit.stretch;
  json["compression"] = limit.compression;
  json["max_sweeps"] = limit.max_sweeps;
  return json;
}

}  // namespace

ModelOptions usual_model(const Scene& scene) {
  ModelOptions model;
  model.elasticity = is_mesh(scene) ? Elasticity::membrane : Elasticity::springs;
  model.bending = usual_bending(model.elasticity);
  return model;
}

void read_model(const JsonReader& reader, Scene& scene) {
  reader.allow_keys({"elasticity", "bending", "shear", "damping", "stiffening_strain", "torsion",
                     "stiffness_exponent", "strain_limit", "tearing"});
  ModelOptions& model = scene.model;
  if (const auto at = reader.find("elasticity")) {
    model.elasticity = at->word(kElasticities);
    check_elasticity(*at, scene);
    model.bending = usual_bending(model.elasticity);
  }
  const bool has_springs = model.elasticity == Elasticity::springs;
  if (const auto at = reader.find("bending")) {
    model.bending = at->word(kBendingModels);
    check_bending(*at, scene);
  }
  if (const auto at = reader.find("shear")) {
    model.shear = at->boolean();
    if (!has_springs) at->fail("no such key, as only springs can lack their shear");
  }
  if (const auto at = reader.find("damping")) {
    model.damping_direction = at->word(kDampingDirections);
    if (!has_springs) at->fail("no such key, as a membrane is damped in its strains alone");
  }
  if (const auto at = reader.find("stiffening_strain")) {
    model.stiffening_strain = at->number(kNotNegative);
    if (!scene.cloth->is_surface()) at->fail("no such key, as particles have springs of their own");
  }
  if (const auto at = reader.find("stiffness_exponent")) {
    model.stiffness_exponent = at->number({0, 1});
    if (!has_springs || !is_quads(scene)) at->fail("no such key without the springs of quads");
  }
  if (const auto at = reader.find("torsion")) {
    model.torsion = at->number(kNotNegative);
    if (model.bending != BendingModel::fitted) at->fail("no such key without fitted bending");
  }
  if (const auto at = reader.find("strain_limit")) model.strain_limit = read_strain_limit(*at);
  if (const auto at = reader.find("tearing")) model.tearing = read_tearing(*at);
}

Json json_model(const ModelOptions& model) {
  Json json;
  json["elasticity"] = word_for(kElasticities, model.elasticity);
  json["bending"] = word_for(kBendingModels, model.bending);
  if (model.elasticity == Elasticity::springs) {
    json["shear"] = model.shear;
    json["damping"] = word_for(kDampingDirections, model.damping_direction);
  }
  if (model.stiffness_exponent > 0) json["stiffness_exponent"] = model.stiffness_exponent;
  if (model.stiffening_strain > 0) json["stiffening_strain"] = model.stiffening_strain;
  if (model.bending == BendingModel::fitted) json["torsion"] = model.torsion;
  if (model.strain_limit) json["strain_limit"] = json_strain_limit(*model.strain_limit);
  if (model.tearing) json["tearing"] = json_tearing(*model.tearing);
  return json;
}

}  // namespace pleat
