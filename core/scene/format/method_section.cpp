#include "core/scene/format/method_section.h"

namespace pleat {
namespace {

constexpr std::int64_t kMaxIterations = 100000;

constexpr std::array<Word<SolverKind>, 5> kSolvers{{{"cholmod", SolverKind::cholmod},
                                                    {"supernodal", SolverKind::supernodal},
                                                    {"eigen", SolverKind::eigen},
                                                    {"cg", SolverKind::cg},
                                                    {"sor", SolverKind::sor}}};

constexpr std::array<Word<Preconditioner>, 3> kPreconditioners{
    {{"automatic", Preconditioner::automatic},
     {"incomplete_factor", Preconditioner::incomplete_factor},
     {"multigrid", Preconditioner::multigrid}}};

constexpr std::array<Word<Constraints>, 2> kConstraints{
    {{"compliant", Constraints::compliant}, {"rigid", Constraints::rigid}}};

constexpr std::array<Word<ImplicitSplit>, 2> kSplits{
    {{"by_stability", ImplicitSplit::by_stability}, {"structural", ImplicitSplit::structural}}};

constexpr std::array<Word<NewtonRule>, 3> kNewtonRules{
    {{"backward_euler", NewtonRule::backward_euler},
     {"midpoint", NewtonRule::midpoint},
     {"equilibrium", NewtonRule::equilibrium}}};

constexpr std::array<Word<Acceleration>, 2> kAccelerations{
    {{"none", Acceleration::none}, {"anderson", Acceleration::anderson}}};

constexpr std::array<Word<EulerRule>, 2> kEulerRules{
    {{"symplectic", EulerRule::symplectic}, {"forward", EulerRule::forward}}};

constexpr std::array<Word<BeyondBound>, 2> kBeyondBound{
    {{"refuse", BeyondBound::refuse}, {"go_on", BeyondBound::go_on}}};

constexpr std::array<Word<Smoother>, 5> kSmoothers{{{"none", Smoother::none},
                                                    {"jacobi", Smoother::jacobi},
                                                    {"gauss_seidel", Smoother::gauss_seidel},
                                                    {"lines", Smoother::lines},
                                                    {"sor", Smoother::sor}}};

constexpr std::array<Word<LevelLengths>, 3> kLevelLengths{{{"surface", LevelLengths::surface},
                                                           {"chord", LevelLengths::chord},
                                                           {"error", LevelLengths::error}}};

constexpr std::array<Word<Attachments>, 2> kAttachments{
    {{"none", Attachments::none}, {"long_range", Attachments::long_range}}};

constexpr std::array<Word<FrameFormat>, 4> kFrameFormats{{{"obj", FrameFormat::obj},
                                                          {"ply", FrameFormat::ply},
                                                          {"binary", FrameFormat::binary},
                                                          {"none", FrameFormat::none}}};

constexpr const char* kStableSubsteps =
    "stable";  // as many as the explicit stability bound asks for

/// Of any mesh, a level of one vertex is reached before.
constexpr std::int64_t kMaxCoarserLevels = 30;

constexpr const char* kEstimatedOmega = "estimated";

int read_substeps(const JsonReader& reader, const StepperType& type) {
  if (!reader.is_text()) return static_cast<int>(reader.integer(1, kMaxSubsteps));
  if (!type.has_stability_bound)
    reader.fail("a whole number, as " + std::string(type.name) + " has no bound to be stable at");
  if (reader.text() != kStableSubsteps) reader.fail("a whole number or \"stable\"");
  return 0;
}

double read_omega(const JsonReader& reader) {
  if (!reader.is_text()) return reader.number({0, 2, NumberRange::Ends::excluded});
  if (reader.text() != kEstimatedOmega) reader.fail("a number or \"estimated\"");
  return 0;
}

NumberRange tolerances(const StepperType& type) {
  using Ends = NumberRange::Ends;
  return {0, type.largest_tolerance,
          type.largest_tolerance < 1 ? Ends::low_excluded : Ends::excluded};
}

const StepperType& read_stepper(const JsonReader& reader, StepperTable steppers) {
  const StepperType* type = reader.is_text() ? find_stepper(steppers, reader.text()) : nullptr;
  if (type != nullptr) return *type;
  std::string names;
  for (const StepperType* known : steppers)
    names += (names.empty() ? "\"" : ", \"") + std::string(known->name) + '"';
  reader.fail("one of " + names);
}

/// Refuses keys that are no setting, and settings that this stepper does not read.
void check_settings(const JsonReader& reader, const StepperType& type) {
  std::vector<const char*> known = {"stepper", "step_s"};
  for (const MethodSetting setting : kMethodSettings) known.push_back(key(setting));
  reader.allow_keys(known);
  for (const MethodSetting setting : kMethodSettings)
    if (const auto at = reader.find(key(setting)); at && !type.reads(setting))
      at->fail("no such key, as " + std::string(type.name) + " does not read it");
}

void read_setting(MethodSetting setting, const JsonReader& reader, MethodOptions& method) {
  switch (setting) {
    case MethodSetting::substeps:
      method.substeps = read_substeps(reader, *method.stepper);
      return;
    case MethodSetting::iterations:
      method.iterations = static_cast<int>(reader.integer(1, kMaxIterations));
      return;
    case MethodSetting::solver:
      method.solver = reader.word(kSolvers);
      return;
    case MethodSetting::tolerance:
      method.tolerance = reader.number(tolerances(*method.stepper));
      return;
    case MethodSetting::omega:
      method.omega = read_omega(reader);
      return;
    case MethodSetting::preconditioner:
      method.preconditioner = reader.word(kPreconditioners);
      return;
    case MethodSetting::split:
      method.split = reader.word(kSplits);
      return;
    case MethodSetting::constraints:
      method.constraints = reader.word(kConstraints);
      return;
    case MethodSetting::rule:
      method.rule = reader.word(kNewtonRules);
      return;
    case MethodSetting::acceleration:
      method.acceleration = reader.word(kAccelerations);
      return;
    case MethodSetting::explicit_share:
      method.explicit_share = reader.number({0, 1});
      return;
    case MethodSetting::euler:
      method.euler = reader.word(kEulerRules);
      return;
    case MethodSetting::beyond_bound:
      method.beyond_bound = reader.word(kBeyondBound);
      return;
    case MethodSetting::first_contact:
      method.first_contact = reader.number(kNotNegative);
      return;
    case MethodSetting::levels:
      method.levels = static_cast<int>(reader.integer(0, kMaxCoarserLevels));
      return;
    case MethodSetting::ratio:
      method.ratio = reader.number({0.1, 0.9, NumberRange::Ends::excluded});
      return;
    case MethodSetting::level_lengths:
      method.level_lengths = reader.word(kLevelLengths);
      return;
    case MethodSetting::smoother_before:
      method.smoother_before = reader.word(kSmoothers);
      return;
    case MethodSetting::smoother:
      method.smoother_after = reader.word(kSmoothers);
      return;
    case MethodSetting::attachments:
      method.attachments = reader.word(kAttachments);
      return;
    case MethodSetting::carried_acceleration:
      method.carried_acceleration = reader.number({0, kMostCarried});
      return;
  }
}

/// True where a smoother of the method reads omega.
bool relaxes(const MethodOptions& method) {
  for (const Smoother smoother : {method.smoother_before, method.smoother_after})
    if (smoother == Smoother::sor || smoother == Smoother::jacobi) return true;
  return false;
}

Json json_substeps(int substeps) { return substeps == 0 ? Json(kStableSubsteps) : Json(substeps); }

Json json_setting(MethodSetting setting, const MethodOptions& method) {
  switch (setting) {
    case MethodSetting::substeps:
      return json_substeps(method.substeps);
    case MethodSetting::iterations:
      return method.iterations;
    case MethodSetting::solver:
      return word_for(kSolvers, method.solver);
    case MethodSetting::tolerance:
      return method.tolerance;
    case MethodSetting::omega:
      return method.omega > 0 ? Json(method.omega) : Json(kEstimatedOmega);
    case MethodSetting::preconditioner:
      return word_for(kPreconditioners, method.preconditioner);
    case MethodSetting::split:
      return word_for(kSplits, method.split);
    case MethodSetting::constraints:
      return word_for(kConstraints, method.constraints);
    case MethodSetting::rule:
      return word_for(kNewtonRules, method.rule);
    case MethodSetting::acceleration:
      return word_for(kAccelerations, method.acceleration);
    case MethodSetting::explicit_share:
      return method.explicit_share;
    case MethodSetting::euler:
      return word_for(kEulerRules, method.euler);
    case MethodSetting::beyond_bound:
      return word_for(kBeyondBound, method.beyond_bound);
    case MethodSetting::first_contact:
      return method.first_contact;
    case MethodSetting::levels:
      return method.levels;
    case MethodSetting::ratio:
      return method.ratio;
    case MethodSetting::level_lengths:
      return word_for(kLevelLengths, method.level_lengths);
    case MethodSetting::smoother_before:
      return word_for(kSmoothers, method.smoother_before);
    case MethodSetting::smoother:
      return word_for(kSmoothers, method.smoother_after);
    case MethodSetting::attachments:
      return word_for(kAttachments, method.attachments);
    case MethodSetting::carried_acceleration:
      return method.carried_acceleration;
  }
  return nullptr;
}

/// Rough cost of a substep of one iteration, see StepperType::substep_cost.
double substep_work(const StepperType& type) {
  MethodOptions method = type.usual_method();
  method.iterations = 1;
  return type.substep_cost(method);
}

struct MethodDetail {
  MethodSetting setting;
  const char* title;
  const char* meaning;
};

constexpr std::array<MethodDetail, 9> kMethodDetails{{
    {MethodSetting::levels, "Coarser levels, number",
     "Meshes of fewer vertices that carry a pull far at once. 0: the cloth's own mesh alone."},
    {MethodSetting::ratio, "Kept by a level, share of vertices",
     "The less a level keeps of the finer one, the cheaper it is, and the rougher."},
    {MethodSetting::level_lengths, "Lengths of levels",
     "Along the surface they act only when exceeded; straight ones act both ways, and iron folds; "
     "by errors they ask for what is still wrong on the finer level."},
    {MethodSetting::smoother_before, "Smoother before",
     "How each level is swept on the way to coarser ones."},
    {MethodSetting::smoother, "Smoother",
     "How springs are gone over once; where there are levels, on the way back. Lines solve "
     "all springs of a thread at once."},
    {MethodSetting::omega, "Omega, factor of corrections",
     "Of SOR, usually 1.1, and Jacobi, usually 1. Above 1 it reaches farther and smooths less."},
    {MethodSetting::attachments, "Attachments",
     "Long range: no vertex further from a pin than unstretched cloth allows."},
    {MethodSetting::carried_acceleration, "Carried acceleration, share",
     "With 0.3 cloth that swings loses as little energy as in several times as many substeps."},
    {MethodSetting::constraints, "Constraints",
     "Rigid ones do not give; compliant ones give as the fabric does."},
}};

struct WordTitle {
  std::string_view word;
  const char* title;
};

constexpr std::array<WordTitle, 11> kWordTitles{{{"none", "None"},
                                                 {"jacobi", "Jacobi"},
                                                 {"gauss_seidel", "Gauss-Seidel"},
                                                 {"lines", "Lines: whole threads"},
                                                 {"sor", "SOR"},
                                                 {"surface", "Along the surface"},
                                                 {"chord", "Straight"},
                                                 {"error", "By errors of the finer level"},
                                                 {"long_range", "Long range"},
                                                 {"rigid", "Rigid"},
                                                 {"compliant", "Compliant"}}};

const char* title_of(const char* word) {
  for (const WordTitle& known : kWordTitles)
    if (known.word == word) return known.title;
  return word;
}

/// Omega is offered of smoothers alone: as a setting of imex it goes with its solver, which is not.
bool offers(const StepperType& type, MethodSetting setting) {
  return type.reads(setting) &&
         (setting != MethodSetting::omega || type.reads(MethodSetting::smoother));
}

template <class Words>
Json json_words(const Words& words) {
  Json list = Json::array();
  for (const auto& [word, value] : words)
    list.push_back({{"value", word}, {"title", title_of(word)}});
  return list;
}

/// "words", or the numbers between which a detail lies, and by which steps it is usually changed.
void put_values(MethodSetting setting, Json& json) {
  const auto put_numbers = [&](double least, double most, double step) {
    json["least"] = least;
    json["most"] = most;
    json["step"] = step;
  };
  switch (setting) {
    case MethodSetting::levels:
      return put_numbers(0, kMaxCoarserLevels, 1);
    case MethodSetting::ratio:
      return put_numbers(0.15, 0.85, 0.05);
    case MethodSetting::omega:
      return put_numbers(0.05, 1.95, 0.05);
    case MethodSetting::carried_acceleration:
      return put_numbers(0, kMostCarried, 0.05);
    case MethodSetting::level_lengths:
      json["words"] = json_words(kLevelLengths);
      return;
    case MethodSetting::attachments:
      json["words"] = json_words(kAttachments);
      return;
    case MethodSetting::constraints:
      json["words"] = json_words(kConstraints);
      return;
    default:
      json["words"] = json_words(kSmoothers);
  }
}

/// A count with what it starts from and what more of it does.
Json json_count(int start, int least, const char* meaning) {
  Json json;
  json["start"] = start;
  json["least"] = least;
  json["meaning"] = meaning;
  return json;
}

Json json_stepper(const StepperType& type) {
  const bool counts_rounds = type.reads(MethodSetting::iterations);
  Json json;
  json["name"] = type.name;
  json["title"] = type.title;
  json["meaning"] = type.meaning;
  json["needs_springs"] = type.needs_springs;
  json["solves"] = type.solves_equations;
  json["settings"]["substeps"] =
      json_count(type.start.substeps, type.has_stability_bound ? 0 : 1, type.substeps_meaning);
  if (counts_rounds)
    json["settings"]["iterations"] = json_count(type.start.iterations, 1, type.iterations_meaning);
  json["details"] = Json::object();
  for (const MethodDetail& detail : kMethodDetails)
    if (offers(type, detail.setting))
      json["details"][key(detail.setting)] = json_setting(detail.setting, type.usual_method());
  json["sweep"] = Json::array();
  for (const MethodCounts& counts : type.usual_counts) {
    Json usual;
    usual["substeps"] = json_substeps(counts.substeps);
    if (counts_rounds) usual["iterations"] = counts.iterations;
    json["sweep"].push_back(usual);
  }
  json["solves_whole_substeps"] = type.solves_whole_substeps;
  json["substep_work"] = substep_work(type);
  json["models"] = Json::array();
  if (type.is_usual_for_springs) json["models"].push_back("springs");
  if (type.is_usual_for_membranes) json["models"].push_back("membrane");
  json["finest_sweep_level"] = type.finest_usual_level;
  json["mark"] = type.mark.path;
  json["colour"] = type.mark.colour;
  json["dark_colour"] = type.mark.dark_colour;
  return json;
}

/// Refuses a choice for another solver.
void expect_solver(SolverKind solver, const JsonReader& reader, MethodSetting setting,
                   const MethodOptions& method) {
  if (method.solver == solver) return;
  reader.at(key(setting))
      .fail(std::string("no such key beside the solver ") + word_for(kSolvers, method.solver) +
            ", but beside " + word_for(kSolvers, solver));
}

}  // namespace

MethodOptions read_method(const JsonReader& reader, StepperTable steppers) {
  const auto named = reader.find("stepper");
  const StepperType& type = named ? read_stepper(*named, steppers) : *MethodOptions{}.stepper;
  check_settings(reader, type);
  MethodOptions method = type.usual_method();
  if (const auto at = reader.find("step_s")) method.step = at->number(kPositive);
  for (const MethodSetting setting : type.settings)
    if (const auto at = reader.find(key(setting))) read_setting(setting, *at, method);
  if (method.omega > 0 && type.reads(MethodSetting::smoother) && !relaxes(method))
    reader.at(key(MethodSetting::omega))
        .fail("no such key beside a smoother other than sor and jacobi");
  if (method.omega > 0 && type.reads(MethodSetting::solver))
    expect_solver(SolverKind::sor, reader, MethodSetting::omega, method);
  if (method.preconditioner != Preconditioner::automatic)
    expect_solver(SolverKind::cg, reader, MethodSetting::preconditioner, method);
  return method;
}

Json json_method(const MethodOptions& method) {
  Json json;
  json["stepper"] = method.stepper->name;
  json["step_s"] = method.step;
  for (const MethodSetting setting : method.stepper->settings)
    if (setting != MethodSetting::preconditioner || method.solver == SolverKind::cg)
      json[key(setting)] = json_setting(setting, method);
  return json;
}

Json json_steppers(StepperTable steppers) {
  Json rows = Json::array();
  for (const StepperType* type : steppers) rows.push_back(json_stepper(*type));
  return rows;
}

Json json_method_details() {
  Json details = Json::array();
  for (const MethodDetail& detail : kMethodDetails) {
    Json json;
    json["key"] = key(detail.setting);
    json["title"] = detail.title;
    json["meaning"] = detail.meaning;
    put_values(detail.setting, json);
    details.push_back(json);
  }
  return details;
}

void read_record(const JsonReader& reader, RecordOptions& record) {
  reader.allow_keys({"every_s", "format"});
  if (const auto at = reader.find("every_s")) record.every = at->number(kPositive);
  if (const auto at = reader.find("format")) record.format = at->word(kFrameFormats);
}

Json json_record(const RecordOptions& record) {
  Json json;
  json["every_s"] = record.every;
  json["format"] = word_for(kFrameFormats, record.format);
  return json;
}

}  // namespace pleat
