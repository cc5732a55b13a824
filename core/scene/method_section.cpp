#include "core/scene/method_section.h"

namespace pleat {
namespace {

constexpr std::int64_t kMaxIterations = 100000;
constexpr NumberRange kTolerance{0, 1, NumberRange::Ends::excluded};
// A looser newton is no newton: its equations would be as wrong as those of one linearisation.
constexpr NumberRange kNewtonTolerances{0, 1e-6, NumberRange::Ends::low_excluded};

constexpr std::array<Word<StepperKind>, 6> kSteppers{{{"explicit", StepperKind::explicit_euler},
                                                      {"rk4", StepperKind::rk4},
                                                      {"implicit", StepperKind::implicit_euler},
                                                      {"newton", StepperKind::newton},
                                                      {"projective", StepperKind::projective},
                                                      {"xpbd", StepperKind::xpbd}}};

constexpr std::array<Word<SolverKind>, 3> kSolvers{
    {{"cholmod", SolverKind::cholmod}, {"eigen", SolverKind::eigen}, {"cg", SolverKind::cg}}};

constexpr std::array<Word<Constraints>, 2> kConstraints{
    {{"compliant", Constraints::compliant}, {"rigid", Constraints::rigid}}};

constexpr std::array<Word<NewtonRule>, 3> kNewtonRules{
    {{"backward_euler", NewtonRule::backward_euler},
     {"midpoint", NewtonRule::midpoint},
     {"equilibrium", NewtonRule::equilibrium}}};

constexpr std::array<Word<FrameFormat>, 4> kFrameFormats{{{"obj", FrameFormat::obj},
                                                          {"ply", FrameFormat::ply},
                                                          {"binary", FrameFormat::binary},
                                                          {"none", FrameFormat::none}}};

constexpr const char* kStableSubsteps =
    "stable";  // as many as the explicit stability bound asks for

int read_substeps(const JsonReader& reader, const MethodOptions& method) {
  if (!reader.is_text()) return static_cast<int>(reader.integer(1, kMaxSubsteps));
  if (!method.is_explicit())
    reader.fail("a whole number, as only explicit and rk4 take \"stable\"");
  if (reader.text() != kStableSubsteps) reader.fail("a whole number or \"stable\"");
  return 0;
}

}  // namespace

void read_method(const JsonReader& reader, MethodOptions& method) {
  reader.allow_keys({"stepper", "step_s", "substeps", "iterations", "solver", "tolerance",
                     "constraints", "rule"});
  if (const auto at = reader.find("stepper")) method.stepper = at->word(kSteppers);
  if (const auto at = reader.find("step_s")) method.step = at->number(kPositive);
  if (const auto at = reader.find("substeps")) method.substeps = read_substeps(*at, method);
  if (const auto at = reader.find("iterations"))
    method.iterations = static_cast<int>(at->integer(1, kMaxIterations));
  // projective keeps a factor and newton is exact, which the general defaults do not serve.
  const bool is_newton = method.stepper == StepperKind::newton;
  if (method.stepper == StepperKind::projective || is_newton) method.solver = best_direct_solver();
  if (is_newton) method.tolerance = kNewtonTolerance;
  if (const auto at = reader.find("solver")) method.solver = at->word(kSolvers);
  if (const auto at = reader.find("tolerance"))
    method.tolerance = at->number(is_newton ? kNewtonTolerances : kTolerance);
  if (const auto at = reader.find("constraints")) method.constraints = at->word(kConstraints);
  if (const auto at = reader.find("rule")) method.rule = at->word(kNewtonRules);
}

Json json_method(const MethodOptions& method) {
  Json json;
  json["stepper"] = word_for(kSteppers, method.stepper);
  json["step_s"] = method.step;
  json["substeps"] = method.substeps == 0 ? Json(kStableSubsteps) : Json(method.substeps);
  json["iterations"] = method.iterations;
  json["solver"] = word_for(kSolvers, method.solver);
  json["tolerance"] = method.tolerance;
  json["constraints"] = word_for(kConstraints, method.constraints);
  json["rule"] = word_for(kNewtonRules, method.rule);
  return json;
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
