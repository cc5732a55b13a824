#include "core/run/convergence_json.h"

#include <array>
#include <utility>

#include "core/dynamics/stepper_table.h"
#include "core/scene/format/method_section.h"

namespace pleat {
namespace {

constexpr std::int64_t kMostRounds = 100000, kMostRepeats = 1000;

constexpr std::array<Word<Constraints>, 2> kConstraints{
    {{"rigid", Constraints::rigid}, {"compliant", Constraints::compliant}}};

Json json_point(const ConvergencePoint& point) {
  return {{"rounds", point.rounds},
          {"sweeps", number_json(point.sweeps)},
          {"ms", point.ms},
          {"relative_error", number_json(point.relative_error)},
          {"relative_distance", number_json(point.relative_distance)}};
}

}  // namespace

ConvergenceOptions read_convergence_options(const JsonReader& reader) {
  ConvergenceOptions options;
  options.time = reader.at("time_s").number(kNotNegative);
  options.constraints = reader.at("constraints").word(kConstraints);
  options.most_rounds = static_cast<int>(reader.at("most_rounds").integer(1, kMostRounds));
  options.longest_solve = reader.at("longest_solve_s").number(kPositive);
  options.repeat = static_cast<int>(reader.at("repeat").integer(1, kMostRepeats));
  for (const JsonReader& method : reader.at("methods").elements())
    options.methods.push_back(read_method(method, standard_steppers()));
  return options;
}

Json json_convergence(const ConvergenceStudy& study) {
  Json all = Json::array();
  for (const ConvergenceSeries& series : study.series) {
    Json points = Json::array();
    for (const ConvergencePoint& point : series.points) points.push_back(json_point(point));
    all.push_back({{"method", json_method(series.method)},
                   {"distance_begin_m", number_json(series.distance_begin)},
                   {"distance_unknown_m", number_json(series.distance_unknown)},
                   {"points", std::move(points)}});
  }
  return {{"time_s", study.time},           {"step_s", study.step},
          {"n_vertices", study.n_vertices}, {"n_springs", study.n_springs},
          {"n_bends", study.n_bends},       {"series", std::move(all)}};
}

}  // namespace pleat
