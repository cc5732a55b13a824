#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/reference/reference.h"
#include "core/sweep/sweep_plan.h"

namespace pleat {

/// Start of such a reference's id.
const char* id_prefix(ReferenceKind kind);

/// newton with the midpoint rule and a direct solver: how exact references are run, in steps of
/// [s].
MethodOptions exact_method(double step);

/// Source of one reference of a sweep.
struct ReferenceRecipe {
  std::string id;  ///< id of the reference
  ReferenceKind kind;
  Scene scene;  ///< whose run it is; the rigid chain stands for its cloth
  /// Index of the recipe of the same run on the next coarser mesh, where the mesh is to be checked.
  std::optional<std::size_t> coarser;
};

/// References of a setting, as indices into the recipes.
struct SettingReferences {
  std::size_t whole;               ///< reference that is taken for right
  std::optional<std::size_t> own;  ///< reference on the setting's own mesh, where that is another
};

/// References for the settings of a plan.
struct SweepReferences {
  std::vector<ReferenceRecipe> recipes;  ///< each once, a coarser one before its finer one
  std::vector<SettingReferences> of_setting;

  /// Indices of the recipes that settings are compared with, each once. The others are for what is
  /// still to be made.
  std::vector<std::size_t> compared() const;
};

/// Throws InputError at /duration_s when a reference has more than kMaxSteps steps.
SweepReferences sweep_references(const SweepPlan& plan);

/// Makes one reference in slices.
class ReferenceMaker {
 public:
  virtual ~ReferenceMaker() = default;
  /// Works for about `budget` [s].
  virtual void advance(double budget) = 0;
  virtual bool done() const = 0;
  virtual double progress() const = 0;  ///< share of the work done, in [0, 1]
  /// Call once done. It has fewer samples than times when the numbers ended its run, and says so.
  virtual Reference reference() const = 0;
};

/// times    [s], positive, ascending.
/// coarser  the reference of recipe.coarser at the same times, where it has one; else null
/// Throws InputError for a scene that the kind of reference is not for.
std::unique_ptr<ReferenceMaker> make_reference_maker(const ReferenceRecipe& recipe,
                                                     const std::vector<double>& times,
                                                     const Reference* coarser = nullptr);

/// Reference for a recipe with a coarser one, from the same run as it is kept for its own mesh: as
/// make_reference_maker makes it, without a run.
Reference checked_on_coarser(const ReferenceRecipe& recipe, Reference same_mesh,
                             const Reference& coarser);

}  // namespace pleat
