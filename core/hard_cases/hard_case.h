#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/files/fabric_file.h"
#include "core/files/file_source.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_override.h"
#include "core/scene/format/scene_tables.h"

namespace pleat {

/// A number of one run that is to stay small.
class CaseMeasure {
 public:
  virtual ~CaseMeasure() = default;
  /// Looks at the start of the run, with an empty report, and after each step.
  virtual void update(const Simulation& simulation, const SolveReport& step) = 0;
  virtual double value() const = 0;
  /// Sentence for a reader on a value that is too large; mostly empty.
  virtual std::string detail() const { return {}; }
};

/// Bound that each run of a case has to keep.
struct CaseCheck {
  std::string what;  ///< the measure, with its unit, for people; no two of a case are called alike
  double bound;      ///< the largest value that passes
  /// Makes the measure from the run at its start and its length [s].
  std::function<std::unique_ptr<CaseMeasure>(const Simulation& start, double duration)> measure;
  /// True when it says nothing of a run that is cut short.
  bool needs_whole_run = false;
};

/// How far the ends of a case's variants are apart.
struct VariantCheck {
  std::string what;
  double bound;
  std::function<double(std::span<const std::unique_ptr<Simulation>> ends)> difference;
  bool needs_whole_run = false;
};

/// A scene of a case that runs beside the others, with the same steps.
struct CaseVariant {
  std::string label;
  std::vector<SceneOverride> changes;
};

/// A hand takes hold of the cloth.
struct HandGrabs {
  VertexId vertex;
};
/// It goes this far within the next step [m].
struct HandMoves {
  Vec3 offset;
};
struct HandLetsGo {};
/// Another scene takes the motion over (Simulation::carry_over).
struct SceneSwitch {
  std::vector<SceneOverride> changes;
};

struct CaseEvent {
  double time;  ///< start of the step in which it happens [s]
  std::variant<HandGrabs, HandMoves, HandLetsGo, SceneSwitch> what;
};

/// Setting for a stepper in this case, where its usual one is not made for it.
struct StepperSetting {
  std::string stepper;
  SceneOverride change;
};

/// A check that a stepper meets with another bound, or need not meet, by its nature.
struct CaseException {
  std::string stepper;
  std::string check;  ///< CaseCheck::what or VariantCheck::what
  std::string reason;
  std::optional<double> bound = std::nullopt;  ///< nothing: it is not asked
};

/// A stepper whose numbers may end the run.
struct AllowedStop {
  std::string stepper;
  std::string reason;
};

/// How well a case kept a check.
struct CaseFinding {
  std::string what;  ///< the check, with the variant's label
  double found;
  double bound;
  std::string detail = {};  ///< see CaseMeasure::detail

  bool is_kept() const { return found <= bound; }
};

/// Sources of the cases' scenes.
struct CaseFiles {
  const FabricLibrary& fabrics;
  FileSource files;  ///< files in the folder of the cases' scenes
  SceneTables tables = {};
};

/// A case has a short length, for tests, and a full one.
enum class CaseLength { brief, full };

/// Simulated time of a case at each length [s].
struct CaseSeconds {
  double brief = 0, full = 0;
};

/// A scene that breaks cloth systems, and what is asked of its run.
struct HardCase {
  std::string name;    ///< name of its scene's file too, without ".json"
  std::string breaks;  ///< fault of other systems, a sentence
  CaseSeconds seconds = {};
  std::vector<SceneOverride> brief_changes = {};  ///< changes to the scene where it is run short
  std::vector<StepperSetting> settings = {};
  std::vector<CaseVariant> variants = {{}};
  /// Makes the places where it starts instead of at rest [m].
  Positions (*start)(const Positions& rest) = nullptr;
  std::vector<CaseEvent> events = {};
  std::vector<CaseCheck> checks = {};
  std::vector<VariantCheck> variant_checks = {};
  std::vector<CaseException> exceptions = {};
  std::vector<AllowedStop> stops = {};
  bool is_bad_input = false;  ///< it has to be refused
  /// Does something else than run, in a case that no stepper has to do with; it may need nothing of
  /// the scene's file.
  std::function<std::vector<CaseFinding>(const CaseFiles& files)> still = nullptr;
};

}  // namespace pleat
