#include <cstdio>

#include "cli/command_table.h"
#include "cli/source.h"
#include "core/error/error_norms.h"
#include "core/error/run_measures.h"
#include "core/reference/reference.h"

namespace pleat {
namespace {

constexpr int kMostTurnFrames = 1'000'000;
constexpr double kFramesPerSecond = 60;

/// Numbers, of which what is not known is null in JSON, which has no NaN.
std::vector<double> read_numbers(const JsonReader& reader) {
  std::vector<double> numbers;
  for (const JsonReader& element : reader.elements())
    numbers.push_back(element.is_null() ? RunMeasures::kUnknown : element.number());
  return numbers;
}

/// Three numbers for each vertex.
Positions read_positions(const JsonReader& reader) {
  const std::vector<double> numbers = read_numbers(reader);
  if (numbers.empty() || numbers.size() % 3 != 0) reader.fail("three numbers for each vertex");
  return Eigen::Map<const Positions>(numbers.data(), 3,
                                     static_cast<Eigen::Index>(numbers.size() / 3));
}

std::vector<Positions> read_samples(const JsonReader& reader) {
  std::vector<Positions> samples;
  for (const JsonReader& sample : reader.elements())
    samples.push_back(read_positions(sample.at("positions_m")));
  return samples;
}

Eigen::VectorXd read_masses(const JsonReader& reader) {
  const std::vector<double> masses = read_numbers(reader);
  return Eigen::Map<const Eigen::VectorXd>(masses.data(), static_cast<Eigen::Index>(masses.size()));
}

/// Keys as bench run prints them.
RunRecord read_run(const JsonReader& reader) {
  return {read_numbers(reader.at("ms")), read_numbers(reader.at("processor_ms")),
          read_numbers(reader.at("rms_stretch")), read_numbers(reader.at("largest_stretch")),
          read_samples(reader.at("samples"))};
}

struct Runs {
  std::vector<RunRecord> records;
  Eigen::VectorXd masses;
};

/// All runs of one contestant; vertices are weighed by `masses`, or as its first run says.
Runs read_runs(const JsonReader& contestant, const std::vector<Positions>& right,
               const std::optional<JsonReader>& masses) {
  const std::vector<JsonReader> elements = contestant.at("runs").elements();
  if (elements.empty()) contestant.at("runs").fail("at least one run");
  Runs runs;
  for (const JsonReader& run : elements) runs.records.push_back(read_run(run));
  const std::vector<Positions>& samples = runs.records.front().samples;
  if (samples.empty() || right.empty()) return runs;
  const JsonReader weights = masses ? *masses : elements.front().at("masses_kg");
  runs.masses = read_masses(weights);
  const Eigen::Index n = std::min(samples.front().cols(), right.front().cols());
  if (runs.masses.size() != n) weights.fail(std::to_string(n) + " masses");
  return runs;
}

Json row_json(const Json& asked, const Json& contestant, const RunMeasures& measures) {
  const Json& first = contestant.at("runs").at(0);
  const double last =
      measures.position_errors.empty() ? RunMeasures::kUnknown : measures.position_errors.back();
  Json errors = Json::object();
  for (std::size_t t = 0; t < measures.position_errors.size(); ++t)
    errors[asked.at("times_s").at(t).dump() + " s"] = number_json(measures.position_errors[t]);
  Json row = Json::object();
  for (const char* key : {"scene", "label", "method", "n_vertices"}) row[key] = contestant.at(key);
  row["target"] = first.at("target");
  row["ms_per_frame"] = number_json(measures.ms_per_frame);
  row["ms_per_simulated_second"] = number_json(kFramesPerSecond * measures.ms_per_frame);
  row["spread_ms"] = number_json(measures.spread_ms);
  row["n_runs"] = contestant.at("runs").size();
  row["parts_ms"] = first.value("parts_ms", Json());
  row["rms_stretch"] = number_json(measures.rms_stretch);
  row["largest_stretch"] = number_json(measures.largest_stretch);
  row["rms_stretch_worst_frame"] = number_json(measures.rms_stretch_worst_frame);
  row["position_errors_m"] = errors;
  row["position_error_m"] = number_json(last);
  row["position_error_percent"] =
      number_json(100 * last / asked.at("rest_diagonal_m").get<double>());
  row["residual"] = first.value("residual", Json());
  row["reference"] = asked.at("reference");
  row["status"] = first.at("status");
  row["message"] = first.at("message");
  row["commit"] = asked.at("commit");
  row["process_peak_memory_bytes"] = first.value("process_peak_memory_bytes", Json());
  return row;
}

/// Refuses what row_json would not find; the rest is checked where it is read.
void check_texts(const JsonReader& contestant) {
  for (const char* key : {"scene", "label"}) contestant.at(key).text();
  contestant.at("method");
  contestant.at("n_vertices").integer(1, std::int64_t{1} << 31);
  for (const JsonReader& run : contestant.at("runs").elements())
    for (const char* key : {"target", "status", "message"}) run.at(key).text();
}

void print_rows(const Json& asked) {
  const JsonReader reader(asked);
  read_label(reader.at("reference"));
  reader.at("rest_diagonal_m").number(kPositive);
  reader.at("commit").text();
  const std::vector<Positions> right = read_samples(reader.at("samples"));
  reader.at("times_s").elements(right.size());
  const auto turn_frames =
      static_cast<std::size_t>(reader.at("turn_frames").integer(1, kMostTurnFrames));
  const Json& contestants = asked.at("contestants");
  std::vector<RunRecord> first;
  std::size_t i = 0;
  for (const JsonReader& contestant : reader.at("contestants").elements()) {
    check_texts(contestant);
    const Runs runs = read_runs(contestant, right, reader.find("masses_kg"));
    if (i == 0) first = runs.records;
    Json row = row_json(asked, contestants.at(i), run_measures(runs.records, right, runs.masses));
    row["times_as_long_as_first"] = number_json(time_ratio(runs.records, first, turn_frames));
    std::printf("%s\n", row.dump().c_str());
    ++i;
  }
}

void print_limit(const Json& asked) {
  const JsonReader reader(asked);
  const Eigen::VectorXd masses = read_masses(reader.at("masses_kg"));
  std::array<std::vector<Positions>, 3> runs;
  const std::vector<JsonReader> meshes = reader.at("meshes").elements(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k] = read_samples(meshes[k]);
    if (runs[k].size() != runs[0].size()) meshes[k].fail("samples at the times of the others");
    for (const Positions& positions : runs[k])
      if (positions.cols() < masses.size()) meshes[k].fail("at least as many vertices as masses");
  }
  Json samples = Json::array();
  for (std::size_t t = 0; t < runs[0].size(); ++t) {
    const MeshLimit limit = observed_limit({runs[0][t], runs[1][t], runs[2][t]}, masses);
    Json positions = Json::array();
    for (const double x : limit.positions.reshaped()) positions.push_back(number_json(x));
    samples.push_back({{"positions_m", positions},
                       {"rate", number_json(limit.rate)},
                       {"distances_m", limit.distances}});
  }
  std::printf("%s\n", Json{{"samples", samples}}.dump().c_str());
}

/// Prints what `print` makes of the file that is named; its mistakes name the file.
template <class Print>
Outcome from_file(Arguments arguments, const char* what, Print&& print) {
  const Source source{arguments.word(what)};
  arguments.finish();
  with_source_named(source, [&] { print(parse_json(read_file(source.file))); });
  return Outcome::ok;
}

Outcome bench_rows(Arguments arguments) {
  return from_file(std::move(arguments), "runs to make rows of, RUNS.json", print_rows);
}

Outcome bench_limit(Arguments arguments) {
  return from_file(std::move(arguments), "runs on three meshes, RUNS.json", print_limit);
}

}  // namespace

extern const Command kBenchRows("rows", "RUNS.json",
                                "rows with speed and error, of runs as bench run prints them",
                                bench_rows, {}, "");

extern const Command kBenchLimit("limit", "RUNS.json",
                                 "where runs on three meshes lead, each with edges half as long",
                                 bench_limit, {}, "");

}  // namespace pleat
