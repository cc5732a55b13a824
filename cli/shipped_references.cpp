#include "cli/shipped_references.h"

#include <cstdio>
#include <memory>
#include <vector>

#include "cli/progress.h"
#include "cli/reference_folder.h"
#include "core/sweep/sweep_reference.h"

namespace pleat {
namespace {

/// The references of recipes, each made when it is first asked for.
class MadeReferences {
 public:
  MadeReferences(const SweepPlan& plan, const SweepReferences& references, ReferenceStore& store)
      : times_(sweep_sample_times(plan.duration)),
        recipes_(references.recipes),
        store_(store),
        made_(references.recipes.size()) {}

  const Reference& operator[](std::size_t index) {
    std::optional<Reference>& reference = made_[index];
    if (!reference) reference = store_.find(recipes_[index].id);
    if (!reference) reference = make(recipes_[index]);
    return *reference;
  }

 private:
  Reference make(const ReferenceRecipe& recipe) {
    const Reference* coarser = recipe.coarser ? &(*this)[*recipe.coarser] : nullptr;
    const auto same_mesh = of_own_mesh(recipe);
    if (coarser != nullptr && same_mesh &&
        (*this)[*same_mesh].samples.size() == coarser->samples.size())
      return checked_on_coarser(recipe, (*this)[*same_mesh], *coarser);
    const std::unique_ptr<ReferenceMaker> maker = make_reference_maker(recipe, times_, coarser);
    finish(*maker, recipe.scene.name + ", level " + std::to_string(recipe.scene.level));
    Reference reference = maker->reference();
    if (!reference.samples.empty()) store_.keep(reference);
    return reference;
  }

  /// The recipe of the same run that is compared with on its own mesh, where there is one.
  std::optional<std::size_t> of_own_mesh(const ReferenceRecipe& recipe) const {
    const std::string id = reference_id(id_prefix(ReferenceKind::same_mesh), recipe.scene, times_);
    for (std::size_t r = 0; r < recipes_.size(); ++r)
      if (recipes_[r].id == id) return r;
    return std::nullopt;
  }

  std::vector<double> times_;
  const std::vector<ReferenceRecipe>& recipes_;
  ReferenceStore& store_;
  std::vector<std::optional<Reference>> made_;
};

}  // namespace

bool ship_references(const SweepPlan& plan, ReferenceStore& store,
                     const std::filesystem::path& folder, std::optional<int> kept_level,
                     const Overwriting& overwriting) {
  const SweepReferences references = sweep_references(plan);
  ReferenceFolder shipped(folder, Precision::float32);
  for (const std::size_t index : references.compared())
    overwriting.check(shipped.path(references.recipes[index].id));
  MadeReferences made(plan, references, store);
  bool all_made = true;
  for (const std::size_t index : references.compared()) {
    Reference reference = made[index];
    std::printf("%s: %s\n", reference.label.id.c_str(), reference.label.description.c_str());
    all_made = all_made && !reference.samples.empty();
    if (reference.samples.empty()) continue;
    const Scene& scene = references.recipes[index].scene;
    if (kept_level) thin(reference, scene.cloth->n_vertices(*kept_level));
    shipped.keep(reference);
  }
  return all_made;
}

}  // namespace pleat
