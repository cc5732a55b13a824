#include "core/sweep/bench_row.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/files/json_text.h"

using namespace pleat;

namespace {

BenchRow measured_row() {
  BenchRow row({"chain-00ff", "planar chain of 64 rigid links", true});
  row.scene = "swinging \"sheet\"";
  row.setting = {{"/refinement/level", 3}, {"/fabric/name", "silk"}};
  row.fabric = {{"name", "silk"}};
  row.model = {{"bending", "none"}};
  row.method.stepper = &steppers::kProjective;
  row.method.step = 1.0 / 120;
  row.method.iterations = 7;
  row.method.solver = SolverKind::eigen;
  row.level = 3;
  row.n_vertices = 4225;
  row.n_substeps = 1;
  row.ms_per_frame = 6.2;
  row.spread_ms = 0.3;
  row.n_runs = 5;
  row.parts_ms = {0, 0.1, 0.2, 0, 5.9, 0};
  row.position_error = 0.013;
  row.position_error_percent = 0.92;
  row.position_error_95 = 0.031;
  row.surface_error = 0.0042;
  row.bend_error = 1.75;
  row.rms_stretch = 1.0 / 3;
  row.largest_stretch = 0.5;
  row.rms_stretch_error = -1e-5;
  row.largest_stretch_error = 1e-4;
  row.residual = 1e-3;
  row.iterations_per_step = 7;
  row.energy_drift = 0.25;
  row.unbalanced_share = 0.0625;
  row.n_unresolved_contacts = 2;
  row.target = "native";
  row.commit = "abc";
  row.process_peak_memory = 123456789;
  return row;
}

/// A row whose run stretched cloth by a million million times and ended ok.
BenchRow exploded_row() {
  BenchRow row = measured_row();
  row.largest_stretch = 1e15;
  row.warnings = {
      {RunWarning::Kind::stretch, 0.4, VertexId(12), 1e15, 0.35, {{"/method/substeps", 4}}}};
  return row;
}

}  // namespace

TEST_CASE("bench_row: a row reads back to what was written", "[sweep]") {
  const BenchRow row = measured_row();
  const std::string line = json_bench_row(row).dump();
  CHECK(line.find('\n') == std::string::npos);
  const Json parsed = parse_json(line);
  const BenchRow read = read_bench_row(JsonReader(parsed));
  CHECK(read.scene == row.scene);
  CHECK(read.setting == row.setting);
  CHECK(read.fabric == row.fabric);
  CHECK(read.model == row.model);
  CHECK(read.method.stepper == &steppers::kProjective);
  CHECK(read.rms_stretch == row.rms_stretch);
  CHECK(read.position_error_95 == row.position_error_95);
  CHECK(read.energy_drift == row.energy_drift);
  CHECK(read.unbalanced_share == row.unbalanced_share);
  CHECK(read.n_unresolved_contacts == row.n_unresolved_contacts);
  CHECK(read.process_peak_memory == row.process_peak_memory);
  CHECK(json_bench_row(read).dump() == line);
}

TEST_CASE("bench_row: a row without a reference cannot be made", "[sweep]") {
  CHECK_THROWS_AS(BenchRow(ReferenceLabel{}), ContractError);
  Json json = json_bench_row(measured_row());
  json["reference"]["id"] = "";
  CHECK_THROWS_AS(read_bench_row(JsonReader(json)), InputError);
  json.erase("reference");
  CHECK_THROWS_AS(read_bench_row(JsonReader(json)), InputError);
}

TEST_CASE("bench_row: a failed run is a row with its status and nulls", "[sweep]") {
  BenchRow row({"chain-00ff", "", true});
  row.status = "not_finite";
  const Json json = json_bench_row(row);
  CHECK(json.at("position_error_m").is_null());
  CHECK(json.at("ms_per_simulated_second").is_null());
  const BenchRow read = read_bench_row(JsonReader(json));
  CHECK(std::isnan(read.position_error));
  CHECK_FALSE(read.finished());
}

TEST_CASE("bench_row: milliseconds per second are sixty frames", "[sweep]") {
  const Json json = json_bench_row(measured_row());
  CHECK(json.at("ms_per_simulated_second").get<double>() == Approx(60 * 6.2));
}

TEST_CASE("bench_row: rows against different references are on fronts of their own", "[sweep]") {
  std::vector<BenchRow> rows(4, measured_row());
  rows[0].ms_per_frame = 1;
  rows[1].ms_per_frame = 2;
  rows[2].ms_per_frame = 3;
  rows[3].ms_per_frame = 4;
  for (const std::size_t i : {0, 1}) rows[i].position_error = 1e-3;
  for (const std::size_t i : {2, 3}) {
    rows[i].reference.id = "another";
    rows[i].position_error = 1e-2;
  }
  CHECK(fronts_of(rows) == std::vector<std::vector<std::size_t>>{{0}, {2}});
  CHECK(front_of(rows) == std::vector<std::size_t>{0, 2});
}

TEST_CASE("bench_row: failed rows are on no front", "[sweep]") {
  std::vector<BenchRow> rows(3, measured_row());
  rows[0].ms_per_frame = 1;
  rows[0].status = "not_finite";
  rows[1].ms_per_frame = 2;
  rows[2].ms_per_frame = 3;
  CHECK(front_of(rows) == std::vector<std::size_t>{1});
  const std::string table = markdown_table(rows);
  CHECK(std::count(table.begin(), table.end(), '*') == 1);
}

TEST_CASE("bench_row: a row with a warning reads back with it and with numbers of any size",
          "[sweep]") {
  const std::string line = json_bench_row(exploded_row()).dump();
  const Json parsed = parse_json(line);
  CHECK(json_bench_row(read_bench_row(JsonReader(parsed))).dump() == line);
}

TEST_CASE("bench_row: a row with a warning is on no front, and the table says why", "[sweep]") {
  std::vector<BenchRow> rows = {exploded_row(), measured_row(), measured_row()};
  rows[0].ms_per_frame = 1;
  rows[1].ms_per_frame = 2;
  rows[2].ms_per_frame = 3;
  CHECK(front_of(rows) == std::vector<std::size_t>{1});
  const std::string table = markdown_table(rows);
  CHECK(table.find("| ! | projective") != std::string::npos);
  CHECK(table.find("!: the run shows what its scene cannot explain") != std::string::npos);
  CHECK(table.find(sentence(rows[0].warnings.front()) + "; try /method/substeps = 4") !=
        std::string::npos);
  rows[0].warnings = {{RunWarning::Kind::not_converged, 0.1, VertexId(0), 1e-5, 0, {}}};
  CHECK(front_of(rows) == std::vector<std::size_t>{0});
  CHECK(markdown_table(rows).find("| ! |") == std::string::npos);
}

TEST_CASE("bench_row: a residual that was not measured is a dash, and the table says so",
          "[sweep]") {
  std::vector<BenchRow> rows(1, measured_row());
  CHECK(markdown_table(rows).find("residual -") == std::string::npos);
  rows[0].residual = BenchRow::kUnknown;
  CHECK(markdown_table(rows).find("residual -: not measured") != std::string::npos);
}

TEST_CASE("bench_row: the table tells surface, bend, parts and the process's memory", "[sweep]") {
  std::vector<BenchRow> rows(2, measured_row());
  rows[1].process_peak_memory.reset();
  rows[1].parts_ms = {};
  const std::string table = markdown_table(rows);
  for (const char* title :
       {"| 95 % within mm |", "| surface mm |", "| bend 1/m |", "| process peak MB |"})
    CHECK(table.find(title) != std::string::npos);
  CHECK(table.find(std::string("| ") + name(Part::solve) + " ms |") != std::string::npos);
  CHECK(table.find(std::string("| ") + name(Part::contact) + " ms |") == std::string::npos);
  CHECK(table.find("| 31 | 4.2 | 1.75 |") != std::string::npos);
  CHECK(table.find("| 123 | ok |") != std::string::npos);
  CHECK(table.find("| - | ok |") != std::string::npos);
}

TEST_CASE("bench_row: the table says whose rounds are accelerated", "[sweep]") {
  std::vector<BenchRow> rows(1, measured_row());
  CHECK(markdown_table(rows).find("accelerated") == std::string::npos);
  rows[0].method.acceleration = Acceleration::anderson;
  CHECK(markdown_table(rows).find(" x 7 accelerated |") != std::string::npos);
}

TEST_CASE("bench_row: the table has a column for each pointer that varies", "[sweep]") {
  std::vector<BenchRow> rows(3, measured_row());
  const auto head = [&] {
    const std::string table = markdown_table(rows);
    return table.substr(0, table.find('\n'));
  };
  CHECK(head().find("/fabric/name") == std::string::npos);
  rows[1].setting["/fabric/name"] = "wo|ol\x1b";
  CHECK(head().find("| level | /fabric/name | vertices |") != std::string::npos);
  CHECK(head().find("/refinement/level") == std::string::npos);  // it has a column already
  CHECK(markdown_table(rows).find("| wo\\|ol\\u001b |") != std::string::npos);
  rows[2].setting["/world/air"] = {{"density_kg_per_m3", 1}};  // the others are without it
  CHECK(head().find("| /fabric/name | /world/air |") != std::string::npos);
  // Every line has as many cells.
  const std::string table = markdown_table(std::vector<BenchRow>{rows[0], rows[2]});
  const auto cells = [](const std::string& line) {
    return std::count(line.begin(), line.end(), '|');
  };
  const std::size_t second = table.find('\n') + 1;
  const std::size_t third = table.find('\n', second) + 1;
  CHECK(cells(table.substr(0, second)) == cells(table.substr(second, third - second)));
  CHECK(cells(table.substr(0, second)) ==
        cells(table.substr(third, table.find('\n', third) - third)));
}
