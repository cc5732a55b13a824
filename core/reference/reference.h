#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json_reader.h"
#include "core/run/content_id.h"
#include "core/run/sampled_run.h"

namespace pleat {

/// Names what an error is measured against.
struct ReferenceLabel {
  std::string id;           ///< names the content; never empty
  std::string description;  ///< a phrase for people
  /// True when halving its step, or its mesh where that is part of the error, changes it by less
  /// than a quarter of the errors shown.
  bool converged = false;
  /// Change by that halving [m]; NaN: unknown.
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
};

/// {"id", "description", "converged", "uncertainty_m": a number or null}.
Json json_label(const ReferenceLabel& label);
/// Reads these keys of an object, which may have others. Throws InputError, for an empty id too.
ReferenceLabel read_label(const JsonReader& reader);

/// A step [s] for such phrases: "1/960 s" where it is a whole part of a second, else "0.35 s".
std::string step_phrase(double step);

/// Raised by hand when the same scene comes to move otherwise than before: references of another
/// number are stale. A test remakes samples of those that are shipped and says when it is due.
constexpr int kPhysicsVersion = 3;

/// Positions at given times that are taken for right.
struct Reference {
  ReferenceLabel label;
  std::vector<Sample> samples;    ///< samples of all vertices of the run, or of a coarser mesh's
  std::string content{};          ///< content_id of the scene, or empty
  int physics = kPhysicsVersion;  ///< version that made it
};

/// Keeps the first vertices alone: those of a coarser mesh.
void thin(Reference& reference, std::int64_t n_vertices);

/// Id of a run of this scene at these times [s] by the present physics: another scene, method or
/// number of its fabric has another one; another name, caption, duration or way to record frames
/// has not. `prefix` says what made it.
std::string reference_id(std::string_view prefix, const Scene& scene,
                         std::span<const double> times);

/// Keeps references by id.
class ReferenceStore {
 public:
  virtual ~ReferenceStore() = default;
  virtual std::optional<Reference> find(const std::string& id) = 0;
  virtual void keep(const Reference& reference) = 0;
};

/// Keeps them as long as it lives.
class MemoryReferenceStore : public ReferenceStore {
 public:
  std::optional<Reference> find(const std::string& id) override;
  void keep(const Reference& reference) override { references_[reference.label.id] = reference; }

 private:
  std::map<std::string, Reference> references_;
};

enum class Precision { float64, float32 };

/// One line of JSON with everything but positions, then those as little-endian floats of the given
/// precision, x y z of each vertex, sample after sample.
std::string write_reference(const Reference& reference, Precision precision = Precision::float64);

/// Throws InputError for bytes that write_reference did not write.
Reference read_reference(std::string_view bytes);

}  // namespace pleat
