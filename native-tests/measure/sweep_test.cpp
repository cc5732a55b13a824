#include "core/measure/sweep.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/scene/json_text.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

MethodOptions implicit_method(double step) {
  MethodOptions method;
  method.step = step;
  method.solver = SolverKind::eigen;
  return method;
}

SweepPlan small_plan() {
  SweepPlan plan;
  plan.scene = released_sheet_scene(2, "fine cotton");
  plan.levels = {0, 1};
  plan.methods = {implicit_method(1.0 / 30), implicit_method(1.0 / 120)};
  plan.duration = 0.5;
  plan.n_repeats = 2;
  return plan;
}

std::vector<BenchRow> rows_of(const SweepPlan& plan, double budget) {
  MemoryReferenceStore store;
  Sweep sweep(plan, store, "test");
  while (!sweep.done()) sweep.advance(budget);
  return sweep.rows();
}

constexpr double kLongSlice = 1e6;  // [s]

/// A row without what a clock or the operating system says.
Json timeless(const BenchRow& row) {
  Json json = parse_json(write_bench_row(row));
  for (const char* key : {"ms_per_frame", "ms_per_simulated_second", "spread_ms", "parts_ms",
                          "process_peak_memory_bytes"})
    json.erase(key);
  return json;
}

std::string plan_text(const std::string& more) {
  return R"({"scene": {"cloth": {"sheet": {}}})" + more + "}";
}

}  // namespace

TEST_CASE("sweep: every setting of the plan gets a row, in order", "[measure]") {
  const std::vector<BenchRow> rows = rows_of(small_plan(), kLongSlice);
  REQUIRE(rows.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(rows[i].level == static_cast<int>(i / 2));
    CHECK(rows[i].method.step == Approx(i % 2 == 0 ? 1.0 / 30 : 1.0 / 120));
    CHECK(rows[i].finished());
    CHECK(rows[i].n_runs == 2);
    CHECK(rows[i].ms_per_frame > 0);
    CHECK_FALSE(rows[i].reference.converged);
  }
}

TEST_CASE("sweep: slices and pauses change no number but times", "[measure]") {
  const std::vector<BenchRow> whole = rows_of(small_plan(), kLongSlice);
  const std::vector<BenchRow> sliced = rows_of(small_plan(), 0);
  REQUIRE(whole.size() == sliced.size());
  for (std::size_t i = 0; i < whole.size(); ++i) CHECK(timeless(whole[i]) == timeless(sliced[i]));
}

TEST_CASE("sweep: a sweep given up keeps the rows it has", "[measure]") {
  MemoryReferenceStore store;
  Sweep sweep(small_plan(), store, "test");
  while (sweep.rows().size() < 2) sweep.advance(0);
  const Json report = parse_json(sweep.report_json());
  CHECK(report.at("done") == false);
  CHECK(report.at("rows").size() == 2);
  CHECK(report.at("progress").get<double>() > 0);
  CHECK(report.at("progress").get<double>() < 1);
  CHECK_FALSE(report.at("message").get<std::string>().empty());
}

TEST_CASE("sweep: progress never goes back and ends at one", "[measure]") {
  MemoryReferenceStore store;
  Sweep sweep(small_plan(), store, "test");
  double last = 0;
  while (!sweep.done()) {
    sweep.advance(0);
    CHECK(sweep.progress() >= last);
    last = sweep.progress();
  }
  CHECK(last == Approx(1));
}

// The finest setting run as a setting is the reference itself.
TEST_CASE("sweep: the reference is not wrong against itself", "[measure]") {
  SweepPlan plan = small_plan();
  const Scene finest = finest_scene(plan);
  CHECK(finest.level == 1);
  CHECK(finest.method.step == Approx(1.0 / 960));
  MemoryReferenceStore store;
  Sweep sweep(plan, store, "test");
  while (sweep.rows().empty()) sweep.advance(0);
  SampledRun run(finest, sweep_sample_times(plan.duration), SampledRun::Parts::untimed);
  run.advance(kLongSlice);
  const auto kept = store.find(sweep.rows()[0].reference.id);
  REQUIRE(kept);
  for (std::size_t s = 0; s < run.samples().size(); ++s)
    CHECK(kept->samples[s].positions == run.samples()[s].positions);
}

TEST_CASE("sweep: a smaller step and a finer mesh come nearer to the reference", "[measure]") {
  const std::vector<BenchRow> rows = rows_of(small_plan(), kLongSlice);
  CHECK(rows[1].position_error < rows[0].position_error);
  CHECK(rows[3].position_error < rows[2].position_error);
}

TEST_CASE("sweep: a kept reference is not computed again", "[measure]") {
  MemoryReferenceStore store;
  const SweepPlan plan = small_plan();
  Reference marked{
      {reference_id("finest", finest_scene(plan), sweep_sample_times(plan.duration)), "kept", true},
      {}};
  for (const double time : sweep_sample_times(plan.duration))
    marked.samples.push_back({time, Positions::Zero(3, 25), {}});
  store.keep(marked);
  Sweep sweep(plan, store, "test");
  while (sweep.rows().empty()) sweep.advance(0);
  CHECK(sweep.rows()[0].reference.description == "kept");
}

TEST_CASE("sweep: a method that cannot run is a row that says why", "[measure]") {
  SweepPlan plan = small_plan();
  plan.levels = {0};
  plan.methods[0].stepper = StepperKind::explicit_euler;  // far beyond its stability bound
  const std::vector<BenchRow> rows = rows_of(plan, kLongSlice);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].status == "refused");
  CHECK(rows[0].message.find("stability") != std::string::npos);
  CHECK(std::isnan(rows[0].position_error));
  CHECK(rows[1].finished());
  CHECK(front_of(rows) == std::vector<std::size_t>{1});
}

TEST_CASE("sweep: the reference's step is a quarter of the smallest, many substeps aside",
          "[measure]") {
  SweepPlan plan = small_plan();
  for (MethodOptions& method : plan.methods) method.step = 1.0 / 300;
  plan.methods[0].stepper = StepperKind::xpbd;
  plan.methods[0].substeps = 100;
  CHECK(finest_scene(plan).method.step == Approx(1.0 / 1200));
  plan.methods[1].substeps = 2;
  CHECK(finest_scene(plan).method.step == Approx(1.0 / 2400));
  plan.methods[1] = plan.methods[0];
  CHECK(finest_scene(plan).method.step == Approx(1.0 / 1200));
  for (MethodOptions& method : plan.methods) method.step = 1.0 / 60;
  CHECK(finest_scene(plan).method.step == Approx(1.0 / 960));
}

TEST_CASE("sweep: a plan reads back to what was written", "[measure]") {
  SweepPlan plan = small_plan();
  plan.reference = ReferenceKind::rigid_chain;
  const std::string text = write_sweep_plan(plan);
  const SweepPlan read = read_sweep_plan(text, FabricLibrary{});
  CHECK(read.levels == plan.levels);
  CHECK(read.methods.size() == 2);
  CHECK(read.reference == ReferenceKind::rigid_chain);
  CHECK(write_sweep_plan(read) == text);
}

TEST_CASE("sweep: a bad plan is refused at its place", "[measure]") {
  const auto where = [](const std::string& text) -> std::string {
    try {
      read_sweep_plan(text, FabricLibrary{});
    } catch (const InputError& error) {
      return error.where();
    }
    return "accepted";
  };
  CHECK(where(plan_text(R"(, "levels": [])")) == "/levels");
  CHECK(where(plan_text(R"(, "levels": [0, 9])")) == "/levels/1");
  CHECK(
      where(R"({"scene": {"cloth": {"sheet": {"columns": 64, "rows": 64}}}, "levels": [3, 4]})") ==
      "/levels/1");
  CHECK(where(R"({"scene": {"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}}},
                  "levels": [1]})") == "/levels/0");
  CHECK(where(plan_text(R"(, "duration_s": 1e9)")) == "/duration_s");
  // The reference's steps are four times as many.
  CHECK(where(plan_text(R"(, "duration_s": 5e6)")) == "/duration_s");
  CHECK(where(plan_text(R"(, "duration_s": 5e6, "reference": "rigid_chain")")) == "accepted");
  CHECK(where(plan_text(R"(, "methods": [{"step_s": 0.01}, {"step_s": -1}])")) ==
        "/methods/1/step_s");
  CHECK(where(plan_text(R"(, "duration_s": 0)")) == "/duration_s");
  CHECK(where(plan_text(R"(, "repeats": 0)")) == "/repeats");
  CHECK(where(plan_text(R"(, "reference": "none")")) == "/reference");
  CHECK(where(plan_text(R"(, "speed": 1)")) == "/speed");
  CHECK(where(R"({"scene": {"cloth": {"sheet": {"rows": -1}}}})") == "/scene/cloth/sheet/rows");
  CHECK(where("{}").empty());
}
