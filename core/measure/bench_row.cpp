#include "core/measure/bench_row.h"

#include <cmath>
#include <cstdio>

#include "core/base/check.h"
#include "core/measure/pareto.h"
#include "core/scene/method_section.h"

namespace pleat {
namespace {

/// The numbers of a row and their keys, for writing and reading alike.
struct NumberField {
  const char* key;
  double BenchRow::*value;
};
constexpr NumberField kNumberFields[] = {
    {"ms_per_frame", &BenchRow::ms_per_frame},
    {"spread_ms", &BenchRow::spread_ms},
    {"position_error_m", &BenchRow::position_error},
    {"position_error_percent", &BenchRow::position_error_percent},
    {"rms_stretch", &BenchRow::rms_stretch},
    {"largest_stretch", &BenchRow::largest_stretch},
    {"rms_stretch_error", &BenchRow::rms_stretch_error},
    {"largest_stretch_error", &BenchRow::largest_stretch_error},
    {"residual", &BenchRow::residual},
    {"iterations_per_step", &BenchRow::iterations_per_step},
    {"energy_drift", &BenchRow::energy_drift},
};

struct CountField {
  const char* key;
  int BenchRow::*value;
};
constexpr CountField kCountFields[] = {{"level", &BenchRow::level},
                                       {"n_vertices", &BenchRow::n_vertices},
                                       {"n_substeps", &BenchRow::n_substeps},
                                       {"n_runs", &BenchRow::n_runs},
                                       {"n_unresolved_contacts", &BenchRow::n_unresolved_contacts}};

struct TextField {
  const char* key;
  std::string BenchRow::*value;
};
constexpr TextField kTextFields[] = {{"scene", &BenchRow::scene},
                                     {"status", &BenchRow::status},
                                     {"message", &BenchRow::message},
                                     {"target", &BenchRow::target},
                                     {"commit", &BenchRow::commit}};

/// JSON has no NaN.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

ReferenceLabel read_label(const JsonReader& reader) {
  ReferenceLabel label{reader.at("id").text(), reader.at("description").text(),
                       reader.at("converged").boolean()};
  if (label.id.empty()) reader.at("id").fail("the id of what the errors are measured against");
  return label;
}

/// A number with three significant digits, or a dash.
std::string short_number(double value) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string method_phrase(const BenchRow& row) {
  const MethodOptions& method = row.method;
  std::string text = name(method.stepper);
  if (method.stepper == StepperKind::implicit_euler || method.stepper == StepperKind::projective)
    text += std::string(" ") + name(method.solver);
  text += ", " + step_phrase(method.step);
  if (row.n_substeps > 0) text += " x " + std::to_string(row.n_substeps);
  if (method.iterations > 1) text += " x " + std::to_string(method.iterations);
  return text;
}

}  // namespace

BenchRow::BenchRow(ReferenceLabel against) : reference(std::move(against)) {
  PLEAT_CHECK(!reference.id.empty(), "no error, no row: a row names what it is measured against");
}

std::string write_bench_row(const BenchRow& row) {
  Json json;
  for (const TextField& field : kTextFields) json[field.key] = row.*field.value;
  for (const CountField& field : kCountFields) json[field.key] = row.*field.value;
  json["method"] = json_method(row.method);
  for (const NumberField& field : kNumberFields) json[field.key] = number_json(row.*field.value);
  json["ms_per_simulated_second"] = number_json(row.ms_per_simulated_second());
  for (int s = 0; s < kStageCount; ++s)
    json["parts_ms"][name(static_cast<Stage>(s))] = row.parts_ms[static_cast<std::size_t>(s)];
  json["reference"] = {{"id", row.reference.id},
                       {"description", row.reference.description},
                       {"converged", row.reference.converged}};
  json["process_peak_memory_bytes"] =
      row.process_peak_memory ? Json(*row.process_peak_memory) : Json(nullptr);
  return json.dump();
}

BenchRow read_bench_row(std::string_view json_text) {
  constexpr std::int64_t kMostCounted = 1'000'000'000;
  const Json json = parse_json(json_text);
  const JsonReader reader(json);
  BenchRow row(read_label(reader.at("reference")));
  for (const TextField& field : kTextFields) row.*field.value = reader.at(field.key).text();
  for (const CountField& field : kCountFields)
    row.*field.value = static_cast<int>(reader.at(field.key).integer(0, kMostCounted));
  read_method(reader.at("method"), row.method);
  for (const NumberField& field : kNumberFields) {
    const JsonReader value = reader.at(field.key);
    row.*field.value = json.at(field.key).is_null() ? BenchRow::kUnknown : value.number();
  }
  const JsonReader parts = reader.at("parts_ms");
  for (int s = 0; s < kStageCount; ++s)
    row.parts_ms[static_cast<std::size_t>(s)] =
        parts.at(name(static_cast<Stage>(s))).number(kNotNegative);
  const JsonReader memory = reader.at("process_peak_memory_bytes");
  if (!json.at("process_peak_memory_bytes").is_null())
    row.process_peak_memory = memory.integer(0, std::int64_t{1} << 53);
  return row;
}

std::vector<std::size_t> front_of(std::span<const BenchRow> rows) {
  std::vector<CostAndError> points;
  for (const BenchRow& row : rows)
    points.push_back(row.finished() ? CostAndError{row.ms_per_frame, row.position_error}
                                    : CostAndError{BenchRow::kUnknown, BenchRow::kUnknown});
  return pareto_front(points);
}

std::string markdown_table(std::span<const BenchRow> rows) {
  std::vector<bool> on_front(rows.size(), false);
  for (const std::size_t i : front_of(rows)) on_front[i] = true;
  std::string table =
      "| front | method | level | vertices | ms per frame | spread | position error mm | % | rms "
      "stretch % | "
      "largest % | residual | status |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const BenchRow& row = rows[i];
    table += std::string("| ") + (on_front[i] ? "*" : "") + " | " + method_phrase(row) + " | " +
             std::to_string(row.level) + " | " + std::to_string(row.n_vertices);
    for (const double value :
         {row.ms_per_frame, row.spread_ms, 1e3 * row.position_error, row.position_error_percent,
          1e2 * row.rms_stretch, 1e2 * row.largest_stretch, row.residual})
      table += " | " + short_number(value);
    table += " | " + row.status + " |\n";
  }
  std::string remarks;
  for (const BenchRow& row : rows) {
    const std::string which = method_phrase(row) + ", level " + std::to_string(row.level) + ": ";
    if (!row.message.empty()) remarks += which + row.status + ", " + row.message + "\n";
    if (row.n_unresolved_contacts > 0)
      remarks += which + std::to_string(row.n_unresolved_contacts) +
                 " times solids left a vertex no place outside of them\n";
  }
  return remarks.empty() ? table : table + "\n" + remarks;
}

}  // namespace pleat
