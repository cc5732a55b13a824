#include "core/files/plan_file.h"

#include <limits>

#include "core/base/check.h"
#include "core/base/formatted.h"

namespace pleat {
namespace {

constexpr const char* kFormat = "pleat plan 1";
constexpr const char* kBalance = "balance";
constexpr const char* kDetailDemand = "detail_demand";
constexpr const char* kLargestLoss = "largest_loss_m";
constexpr int kMaxCount = std::numeric_limits<int>::max();

std::string fingerprint_text(std::uint64_t fingerprint) {
  return formatted("%016llx", static_cast<unsigned long long>(fingerprint));
}

std::uint64_t read_fingerprint(const JsonReader& reader) {
  const std::string& text = reader.text();
  if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    reader.fail("16 hexadecimal digits");
  return std::stoull(text, nullptr, 16);
}

Json json_pair(const Eigen::Vector2d& pair) { return Json::array({pair[0], pair[1]}); }

Eigen::Vector2d read_pair(const JsonReader& reader) {
  const std::vector<JsonReader> numbers = reader.elements(2);
  return {numbers[0].number(kNotNegative), numbers[1].number(kNotNegative)};
}

Json json_example(const PlanExample& example) {
  Json centres = Json::array();
  for (const auto& centre : example.centres.colwise()) centres.push_back(json_pair(centre));
  return {{"name", example.name},
          {"centres_per_m", centres},
          {"low_per_m", json_pair(example.low)},
          {"high_per_m", json_pair(example.high)}};
}

PlanExample read_example(const JsonReader& reader, int n_patterns) {
  reader.allow_keys({"name", "centres_per_m", "low_per_m", "high_per_m"});
  PlanExample example;
  example.name = reader.at("name").text();
  example.centres.resize(2, n_patterns);
  const auto centres = reader.at("centres_per_m").elements(static_cast<std::size_t>(n_patterns));
  for (int c = 0; c < n_patterns; ++c)
    example.centres.col(c) = read_pair(centres[static_cast<std::size_t>(c)]);
  example.low = read_pair(reader.at("low_per_m"));
  example.high = read_pair(reader.at("high_per_m"));
  return example;
}

/// Runs of equal patterns: [pattern, how many].
Json json_runs(const std::vector<int>& patterns) {
  Json runs = Json::array();
  for (const int pattern : patterns) {
    if (!runs.empty() && runs.back()[0] == pattern)
      runs.back()[1] = runs.back()[1].get<int>() + 1;
    else
      runs.push_back({pattern, 1});
  }
  return runs;
}

std::vector<int> read_runs(const JsonReader& reader, int n_patterns, std::int64_t n_vertices) {
  std::vector<int> patterns;
  for (const JsonReader& run : reader.elements()) {
    const std::vector<JsonReader> numbers = run.elements(2);
    const auto pattern = static_cast<int>(numbers[0].integer(0, n_patterns - 1));
    const auto n_left = n_vertices - static_cast<std::int64_t>(patterns.size());
    if (n_left == 0) run.fail("no run beyond the base mesh's last vertex");
    const std::int64_t n = numbers[1].integer(1, n_left);
    patterns.insert(patterns.end(), static_cast<std::size_t>(n), pattern);
  }
  if (static_cast<std::int64_t>(patterns.size()) != n_vertices)
    reader.fail("runs of " + std::to_string(n_vertices) + " vertices together");
  return patterns;
}

Json json_splits(const std::vector<PlannedSplit>& splits) {
  Json lines = Json::array();
  for (const PlannedSplit& split : splits) {
    lines.push_back({split.face.value, split.demand});
    if (split.for_balance) lines.back().push_back(kBalance);
  }
  return lines;
}

PlannedSplit read_split(const JsonReader& reader) {
  const std::vector<JsonReader> parts = reader.elements();
  if (parts.size() < 2 || parts.size() > 3) reader.fail("a face, its demand and perhaps a reason");
  PlannedSplit split;
  split.face = FaceId(parts[0].integer(0, kMaxCount));
  split.demand = parts[1].number(kNotNegative);
  split.for_balance = parts.size() == 3;
  if (split.for_balance && parts[2].text() != kBalance) parts[2].fail("\"balance\"");
  return split;
}

void read_options(const JsonReader& root, RefinementPlan& plan) {
  const auto criterion = root.find("criterion");  // files from before there were two have none
  plan.options.criterion = criterion ? criterion->word(kPlanCriteria) : PlanCriterion::curvature;
  const bool is_shape = plan.options.criterion == PlanCriterion::shape;
  const char* const demand_key = is_shape ? kLargestLoss : kDetailDemand;
  plan.options.level_cap = static_cast<int>(root.at("level_cap").integer(0, kMaxLevel));
  if (root.only_one_of({demand_key, "vertex_budget"}) == 1) {
    plan.options.max_vertices = static_cast<int>(root.at("vertex_budget").integer(0, kMaxCount));
    return;
  }
  const JsonReader demand = root.at(demand_key);
  if (is_shape) {
    plan.options.largest_loss = demand.number({0, kLargestLossEnd, NumberRange::Ends::included});
    return;
  }
  plan.options.demand = demand.number(kNotNegative);
  const int end = 4 * (plan.n_patterns - 1);
  if (plan.options.demand >= end) demand.fail("a number below " + std::to_string(end));
}

}  // namespace

Json json_plan(const RefinementPlan& plan) {
  PLEAT_CHECK(plan.options.level_cap.has_value(), "a plan knows its level cap");
  Json examples = Json::array();
  for (const PlanExample& example : plan.examples) examples.push_back(json_example(example));
  Json json = {
      {"format", kFormat},
      {"base_mesh",
       {{"vertices", plan.patterns.size()}, {"fingerprint", fingerprint_text(plan.base_mesh)}}},
      {"examples", examples},
      {"patterns", plan.n_patterns},
      {"patterns_of_vertices", json_runs(plan.patterns)}};
  json["criterion"] = word_for(kPlanCriteria, plan.options.criterion);
  if (plan.options.max_vertices)
    json["vertex_budget"] = *plan.options.max_vertices;
  else if (plan.options.criterion == PlanCriterion::shape)
    json[kLargestLoss] = plan.options.largest_loss;
  else
    json[kDetailDemand] = plan.options.demand;
  json["level_cap"] = *plan.options.level_cap;
  json["vertices"] = plan.n_vertices;
  json["curvature_limits_per_m"] = plan.curvature_limits;
  json["splits"] = json_splits(plan.splits);
  return json;
}

std::string plan_text(const RefinementPlan& plan) { return format_json(json_plan(plan)); }

RefinementPlan read_plan(std::string_view json_text) {
  const Json document = parse_json(json_text);
  return read_plan(JsonReader(document));
}

RefinementPlan read_plan(const JsonReader& root) {
  root.allow_keys({"format", "base_mesh", "examples", "patterns", "patterns_of_vertices",
                   "criterion", "vertex_budget", kLargestLoss, kDetailDemand, "level_cap",
                   "vertices", "curvature_limits_per_m", "splits"});
  if (root.at("format").text() != kFormat) root.at("format").fail('"' + std::string(kFormat) + '"');
  RefinementPlan plan;
  plan.n_patterns = static_cast<int>(root.at("patterns").integer(1, kMaxPatterns));
  for (const JsonReader& example : root.at("examples").elements())
    plan.examples.push_back(read_example(example, plan.n_patterns));
  const JsonReader base = root.at("base_mesh");
  base.allow_keys({"vertices", "fingerprint"});
  plan.base_mesh = read_fingerprint(base.at("fingerprint"));
  plan.patterns = read_runs(root.at("patterns_of_vertices"), plan.n_patterns,
                            base.at("vertices").integer(1, kMaxVertices));
  read_options(root, plan);
  plan.n_vertices = static_cast<int>(root.at("vertices").integer(1, kMaxCount));
  const JsonReader limits = root.at("curvature_limits_per_m");
  for (const JsonReader& limit : limits.elements())
    plan.curvature_limits.push_back(limit.number(kNotNegative));
  for (const JsonReader& split : root.at("splits").elements())
    plan.splits.push_back(read_split(split));
  return plan;
}

}  // namespace pleat
