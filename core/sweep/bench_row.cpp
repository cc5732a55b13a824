#include "core/sweep/bench_row.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/dynamics/stepper_table.h"
#include "core/scene/format/method_section.h"
#include "core/sweep/pareto.h"

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
    {"method_error_m", &BenchRow::method_error},
    {"mesh_error_m", &BenchRow::mesh_error},
    {"position_error_95_m", &BenchRow::position_error_95},
    {"surface_error_m", &BenchRow::surface_error},
    {"surface_error_95_m", &BenchRow::surface_error_95},
    {"bend_error_per_m", &BenchRow::bend_error},
    {"bend_error_of_regions_per_m", &BenchRow::bend_error_of_regions},
    {"rms_stretch", &BenchRow::rms_stretch},
    {"largest_stretch", &BenchRow::largest_stretch},
    {"rms_stretch_error", &BenchRow::rms_stretch_error},
    {"largest_stretch_error", &BenchRow::largest_stretch_error},
    {"residual", &BenchRow::residual},
    {"iterations_per_step", &BenchRow::iterations_per_step},
    {"energy_drift", &BenchRow::energy_drift},
    {"unbalanced_share", &BenchRow::unbalanced_share},
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

struct ObjectField {
  const char* key;
  Json BenchRow::*value;
};
constexpr ObjectField kObjectFields[] = {
    {"setting", &BenchRow::setting}, {"fabric", &BenchRow::fabric}, {"model", &BenchRow::model}};

/// The numbers in a table, times what turns them into the title's unit.
struct NumberColumn {
  const char* title;
  double BenchRow::*value;
  double factor;
  bool is_optional = false;  ///< left out where no row has it
};
constexpr NumberColumn kNumberColumns[] = {
    {"ms per frame", &BenchRow::ms_per_frame, 1},
    {"spread", &BenchRow::spread_ms, 1},
    {"position error mm", &BenchRow::position_error, 1e3},
    {"%", &BenchRow::position_error_percent, 1},
    {"of the method", &BenchRow::method_error, 1e3},
    {"of the mesh", &BenchRow::mesh_error, 1e3},
    {"95 % within mm", &BenchRow::position_error_95, 1e3},
    {"surface mm", &BenchRow::surface_error, 1e3},
    {"bend 1/m", &BenchRow::bend_error, 1},
    {"rms stretch %", &BenchRow::rms_stretch, 1e2},
    {"largest %", &BenchRow::largest_stretch, 1e2},
    {"residual", &BenchRow::residual, 1},
    {"unbalanced %", &BenchRow::unbalanced_share, 1e2, true},
};

/// A number with three significant digits, or a dash.
std::string short_number(double value) { return std::isfinite(value) ? three_digits(value) : "-"; }

std::string method_phrase(const BenchRow& row) {
  const MethodOptions& method = row.method;
  std::string text = method.stepper->name;
  if (method.stepper->reads("solver")) text += std::string(" ") + name(method.solver);
  if (method.preconditioner != Preconditioner::automatic)
    text += std::string(" with ") + name(method.preconditioner);
  text += ", " + step_phrase(method.step);
  if (row.n_substeps > 0) text += " x " + std::to_string(row.n_substeps);
  if (method.iterations > 1) text += " x " + std::to_string(method.iterations);
  if (method.acceleration != Acceleration::none) text += " accelerated";
  return text;
}

/// True for what a phrase and a table say in words of their own.
bool is_told(const std::string& pointer) {
  return pointer == "/method" || pointer == "/refinement/level";
}

/// Pointers whose value is not the same in all rows, in the order in which they appear.
std::vector<std::string> varying_pointers(std::span<const BenchRow> rows) {
  std::vector<std::string> varying;
  std::set<std::string> known;
  for (const BenchRow& row : rows)
    for (const auto& change : row.setting.items()) {
      const std::string& pointer = change.key();
      if (is_told(pointer) || !known.insert(pointer).second) continue;
      const auto differs = [&](const BenchRow& other) {
        return !other.setting.contains(pointer) || other.setting[pointer] != change.value();
      };
      if (std::any_of(rows.begin(), rows.end(), differs)) varying.push_back(pointer);
    }
  return varying;
}

/// The text escaped for a row of a Markdown table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : printable(text)) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped + " | ";
}

std::string value_text(const Json& value) {
  return cut(value.is_string() ? value.get<std::string>() : value.dump());
}

std::string value_cell(const BenchRow& row, const std::string& pointer) {
  const auto value = row.setting.find(pointer);
  return cell(value == row.setting.end() ? "" : value_text(*value));
}

/// The parts of a step that took time in some row.
std::vector<Part> timed_parts(std::span<const BenchRow> rows) {
  std::vector<Part> parts;
  for (int s = 0; s < kPartCount; ++s) {
    const auto took_time = [s](const BenchRow& row) {
      return row.parts_ms[static_cast<std::size_t>(s)] > 0;
    };
    if (std::any_of(rows.begin(), rows.end(), took_time)) parts.push_back(static_cast<Part>(s));
  }
  return parts;
}

std::vector<NumberColumn> known_columns(std::span<const BenchRow> rows) {
  std::vector<NumberColumn> columns;
  for (const NumberColumn& column : kNumberColumns) {
    const auto has = [&](const BenchRow& row) { return std::isfinite(row.*column.value); };
    if (!column.is_optional || std::any_of(rows.begin(), rows.end(), has))
      columns.push_back(column);
  }
  return columns;
}

/// The columns of a table that are not the same in all.
struct VaryingColumns {
  std::vector<std::string> pointers;
  std::vector<NumberColumn> numbers;
  std::vector<Part> parts;
};

std::string table_head(const VaryingColumns& varying) {
  std::string head = "| front | method | level | ";
  for (const std::string& pointer : varying.pointers) head += cell(cut(pointer));
  head += "vertices | ";
  for (const NumberColumn& column : varying.numbers) head += cell(column.title);
  for (const Part part : varying.parts) head += cell(std::string(name(part)) + " ms");
  head += "process peak MB | status |\n|";
  const std::size_t n_columns =
      6 + varying.pointers.size() + varying.numbers.size() + varying.parts.size();
  for (std::size_t c = 0; c < n_columns; ++c) head += "---|";
  return head + "\n";
}

const char* mark_of(const BenchRow& row, bool is_on_front) {
  if (is_on_front) return "*";
  return row.is_plausible() ? "" : "!";
}

std::string table_line(const BenchRow& row, bool is_on_front, const VaryingColumns& varying) {
  std::string line = "| " + cell(mark_of(row, is_on_front)) + cell(method_phrase(row)) +
                     cell(std::to_string(row.level));
  for (const std::string& pointer : varying.pointers) line += value_cell(row, pointer);
  line += cell(std::to_string(row.n_vertices));
  for (const NumberColumn& column : varying.numbers)
    line += cell(short_number(column.factor * row.*column.value));
  for (const Part part : varying.parts)
    line += cell(short_number(row.parts_ms[static_cast<std::size_t>(part)]));
  constexpr double kBytesPerMegabyte = 1e6;
  line += cell(short_number(row.process_peak_memory
                                ? static_cast<double>(*row.process_peak_memory) / kBytesPerMegabyte
                                : BenchRow::kUnknown));
  return line + row.status + " |\n";
}

std::string remarks_on(const BenchRow& row) {
  const std::string which = printable(setting_phrase(row)) + ": ";
  std::string remarks;
  if (!row.message.empty()) remarks += which + row.status + ", " + printable(row.message) + "\n";
  if (row.n_unresolved_contacts > 0)
    remarks += which + std::to_string(row.n_unresolved_contacts) +
               " times solids left a vertex no place outside of them\n";
  for (const RunWarning& warning : row.warnings)
    remarks += which + sentence(warning) + "; " + advice(warning) + "\n";
  return remarks;
}

/// Meaning of signs and gaps in the table, where there are any.
std::string meaning_of_signs(std::span<const BenchRow> rows) {
  const auto has = [&](auto&& is) { return std::any_of(rows.begin(), rows.end(), is); };
  std::string text;
  if (has([](const BenchRow& row) { return !row.is_plausible(); }))
    text +=
        "!: the run shows what its scene cannot explain, or hardly solved its equations; such a "
        "row is on no front\n";
  if (has([](const BenchRow& row) { return row.finished() && !std::isfinite(row.residual); }))
    text += "residual -: not measured; a direct solver does not compute it\n";
  return text;
}

}  // namespace

BenchRow::BenchRow(ReferenceLabel against) : reference(std::move(against)) {
  PLEAT_CHECK(!reference.id.empty(), "no error, no row: a row names what it is measured against");
}

bool BenchRow::is_plausible() const {
  return std::none_of(warnings.begin(), warnings.end(),
                      [](const RunWarning& warning) { return warning.is_nonsense(); });
}

Json json_parts(const std::array<double, kPartCount>& parts_ms) {
  Json json = Json::object();
  for (int s = 0; s < kPartCount; ++s)
    json[name(static_cast<Part>(s))] = parts_ms[static_cast<std::size_t>(s)];
  return json;
}

Json json_bench_row(const BenchRow& row) {
  Json json;
  const auto put = [&json](const char* key, Json value) { json[key] = std::move(value); };
  for (const TextField& field : kTextFields) put(field.key, row.*field.value);
  for (const ObjectField& field : kObjectFields) put(field.key, row.*field.value);
  for (const CountField& field : kCountFields) put(field.key, row.*field.value);
  put("method", json_method(row.method));
  for (const NumberField& field : kNumberFields) put(field.key, number_json(row.*field.value));
  put("ms_per_simulated_second", number_json(row.ms_per_simulated_second()));
  put("parts_ms", json_parts(row.parts_ms));
  put("reference", json_label(row.reference));
  put("process_peak_memory_bytes",
      row.process_peak_memory ? Json(*row.process_peak_memory) : Json());
  put("warnings", json_warnings(row.warnings));
  return json;
}

BenchRow read_bench_row(const JsonReader& reader, StepperTable steppers) {
  constexpr std::int64_t kMostCounted = 1'000'000'000;
  BenchRow row(read_label(reader.at("reference")));
  for (const TextField& field : kTextFields) row.*field.value = reader.at(field.key).text();
  for (const ObjectField& field : kObjectFields) {
    const JsonReader object = reader.at(field.key);
    object.members();
    row.*field.value = object.json();
  }
  for (const CountField& field : kCountFields)
    row.*field.value = static_cast<int>(reader.at(field.key).integer(0, kMostCounted));
  row.method = read_method(reader.at("method"), steppers);
  for (const NumberField& field : kNumberFields)
    row.*field.value = reader.at(field.key).number_or(BenchRow::kUnknown);
  const JsonReader parts = reader.at("parts_ms");
  for (int s = 0; s < kPartCount; ++s)
    row.parts_ms[static_cast<std::size_t>(s)] =
        parts.at(name(static_cast<Part>(s))).number(kNotNegative);
  const JsonReader memory = reader.at("process_peak_memory_bytes");
  if (!memory.is_null()) row.process_peak_memory = memory.integer(0, std::int64_t{1} << 53);
  row.warnings = read_warnings(reader.at("warnings"));
  return row;
}

std::vector<std::vector<std::size_t>> fronts_of(std::span<const BenchRow> rows) {
  constexpr CostAndError kNowhere{BenchRow::kUnknown, BenchRow::kUnknown};
  std::vector<std::string> references;
  for (const BenchRow& row : rows)
    if (std::find(references.begin(), references.end(), row.reference.id) == references.end())
      references.push_back(row.reference.id);
  std::vector<std::vector<std::size_t>> fronts;
  for (const std::string& reference : references) {
    std::vector<CostAndError> points;
    for (const BenchRow& row : rows) {
      const bool takes_part = row.reference.id == reference && row.finished() && row.is_plausible();
      points.push_back(takes_part ? CostAndError{row.ms_per_frame, row.position_error} : kNowhere);
    }
    fronts.push_back(pareto_front(points));
  }
  return fronts;
}

std::vector<std::size_t> front_of(std::span<const BenchRow> rows) {
  std::vector<std::size_t> all;
  for (const std::vector<std::size_t>& front : fronts_of(rows))
    all.insert(all.end(), front.begin(), front.end());
  return all;
}

std::string setting_phrase(const BenchRow& row) {
  std::string phrase = method_phrase(row) + ", level " + std::to_string(row.level);
  for (const auto& change : row.setting.items())
    if (!is_told(change.key())) phrase += ", " + change.key() + " " + value_text(change.value());
  return phrase;
}

std::string markdown_table(std::span<const BenchRow> rows) {
  const VaryingColumns varying{varying_pointers(rows), known_columns(rows), timed_parts(rows)};
  std::vector<bool> on_front(rows.size(), false);
  for (const std::size_t i : front_of(rows)) on_front[i] = true;
  std::string table = table_head(varying);
  std::string remarks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table += table_line(rows[i], on_front[i], varying);
    remarks += remarks_on(rows[i]);
  }
  const std::string below = meaning_of_signs(rows) + remarks;
  return below.empty() ? table : table + "\n" + below;
}

}  // namespace pleat
