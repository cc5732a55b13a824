#include "core/sweep/sweep.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/check.h"
#include "core/scene/format/scene_file.h"
#include "native-tests/support/assets.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

constexpr double kLongSlice = 1e6;  // [s]

Scene read_any_scene(const JsonReader& root) { return read_scene(root, fabric_library()); }

SweepPlan plan_of(const Json& json) { return read_sweep_plan(JsonReader(json), read_any_scene); }

Json implicit_method(double step) {
  return {{"stepper", "implicit"}, {"step_s", step}, {"solver", "eigen"}};
}

/// Two levels, two methods each.
Json small_plan() {
  Json scene = parse_json(write_scene(released_sheet_scene(2, "fine cotton")));
  scene["fabric"] = {{"name", "fine cotton"}, {"bending", "moving"}};
  const Json methods = Json::array({implicit_method(1.0 / 30), implicit_method(1.0 / 120)});
  return {{"scene", scene},
          {"grid", {{"/refinement/level", {0, 1}}, {"/method", methods}}},
          {"duration_s", 0.5},
          {"repeats", 2}};
}

/// Thirty cheap points.
Json plan_of_thirty() {
  Json plan = small_plan();
  plan["grid"] = {{"/fabric/name", {"silk", "wool", "linen"}},
                  {"/refinement/level", {0, 1}},
                  {"/method/substeps", {1, 2, 3, 4, 5}}};
  plan["settings"] = Json::array({{{"/method", implicit_method(1.0 / 30)}}});
  plan["duration_s"] = 0.1;
  return plan;
}

std::vector<BenchRow> rows_of(const Json& plan, double budget) {
  MemoryReferenceStore store;
  Sweep sweep(plan_of(plan), store, "test");
  while (!sweep.done()) sweep.advance(budget);
  return sweep.rows();
}

/// A row without what a clock or the operating system says.
Json timeless(const BenchRow& row) {
  Json json = json_bench_row(row);
  for (const char* key : {"ms_per_frame", "ms_per_simulated_second", "spread_ms", "parts_ms",
                          "process_peak_memory_bytes"})
    json.erase(key);
  return json;
}

bool same_but_times(const std::vector<BenchRow>& a, const std::vector<BenchRow>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const BenchRow& x, const BenchRow& y) { return timeless(x) == timeless(y); });
}

/// Counts what is made.
class CountingStore : public MemoryReferenceStore {
 public:
  void keep(const Reference& reference) override {
    ++n_kept;
    MemoryReferenceStore::keep(reference);
  }
  int n_kept = 0;
};

std::string journal_of(const Json& plan, ReferenceStore& store) {
  Sweep sweep(plan_of(plan), store, "test");
  std::string journal;
  sweep.on_run([&](const std::string& line) { journal += line; });
  while (!sweep.done()) sweep.advance(kLongSlice);
  return journal;
}

double reference_step(const Json& plan) {
  return sweep_references(plan_of(plan)).recipes.at(0).scene.method.step;
}

/// The error with which a plan is refused.
InputError fault_of(const Json& plan) {
  try {
    const SweepPlan read = plan_of(plan);
    sweep_references(read);
  } catch (const InputError& error) {
    return error;
  }
  return InputError("accepted", "");
}

Json sheet_plan(const Json& more) {
  Json plan = {{"scene", {{"cloth", {{"sheet", Json::object()}}}}}};
  plan.update(more);
  return plan;
}

}  // namespace

TEST_CASE("sweep: every setting of the plan gets a row, in order", "[sweep]") {
  const std::vector<BenchRow> rows = rows_of(small_plan(), kLongSlice);
  REQUIRE(rows.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(rows[i].level == static_cast<int>(i / 2));
    CHECK(rows[i].method.step == Approx(i % 2 == 0 ? 1.0 / 30 : 1.0 / 120));
    CHECK(rows[i].setting.at("/refinement/level") == i / 2);
    CHECK(rows[i].fabric.at("name") == "fine cotton");
    CHECK(rows[i].model.at("bending") == "quadratic");
    CHECK(rows[i].finished());
    CHECK(rows[i].n_runs == 2);
    CHECK(rows[i].ms_per_frame > 0);
    CHECK_FALSE(rows[i].reference.converged);
  }
}

TEST_CASE("sweep: any value of the scene can be a setting", "[sweep]") {
  Json plan = small_plan();
  plan["grid"] = {{"/world/gravity_m_per_s2/1", {-9.81, -1.6}}};
  plan["settings"] = {{{"/model/bending", "none"}},
                      {{"/fabric/name", "silk"}, {"/method/stepper", "xpbd"}},
                      Json::object()};
  const SweepPlan read = plan_of(plan);
  REQUIRE(read.settings.size() == 6);
  for (const std::size_t s : {0, 1, 2, 3, 4, 5}) {
    CAPTURE(s);
    const Scene scene = read.scene_of(s);
    CHECK(scene.gravity.y() == (s < 3 ? -9.81 : -1.6));
    CHECK((scene.model.bending == BendingModel::none) == (s % 3 == 0));
    CHECK(scene.fabric.name == (s % 3 == 1 ? "silk" : "fine cotton"));
    CHECK((scene.method.stepper == &steppers::kXpbd) == (s % 3 == 1));
    CHECK(scene.duration == 0.5);
  }
}

TEST_CASE("sweep: slices and pauses change no number but times", "[sweep]") {
  CHECK(same_but_times(rows_of(small_plan(), kLongSlice), rows_of(small_plan(), 0)));
}

TEST_CASE("sweep: a sweep given up keeps the rows it has", "[sweep]") {
  MemoryReferenceStore store;
  Sweep sweep(plan_of(small_plan()), store, "test");
  while (sweep.rows().size() < 2) sweep.advance(0);
  const Json report = sweep.report();
  CHECK(report.at("done") == false);
  CHECK(report.at("rows").size() == 2);
  CHECK(report.at("progress").get<double>() > 0);
  CHECK(report.at("progress").get<double>() < 1);
  CHECK_FALSE(report.at("message").get<std::string>().empty());
}

TEST_CASE("sweep: progress never goes back and ends at one", "[sweep]") {
  MemoryReferenceStore store;
  Sweep sweep(plan_of(plan_of_thirty()), store, "test");
  double last = 0;
  while (!sweep.done()) {
    sweep.advance(0);
    CHECK(sweep.progress() >= last);
    last = sweep.progress();
  }
  CHECK(last == Approx(1));
}

TEST_CASE("sweep: a journal cut anywhere gives every row once, to the bit", "[sweep]") {
  CountingStore store;
  const Json plan = plan_of_thirty();
  const std::string journal = journal_of(plan, store);
  CHECK(store.n_kept == 9);  // one of each level for each fabric, and a finer one
  REQUIRE(std::count(journal.begin(), journal.end(), '\n') == 90);
  Sweep whole(plan_of(plan), store, "test");
  CHECK(whole.resume(journal) == journal.size());
  CHECK(whole.done());
  REQUIRE(whole.rows().size() == 30);

  for (const double share : {0.0, 0.001, 0.2, 0.331, 0.5, 0.77, 0.9, 0.99, 0.9999}) {
    CAPTURE(share);
    const auto n_bytes = static_cast<std::size_t>(share * static_cast<double>(journal.size()));
    const std::string cut = journal.substr(0, n_bytes);
    Sweep sweep(plan_of(plan), store, "test");
    const std::size_t n_taken = sweep.resume(cut);
    CHECK(n_taken == cut.rfind('\n') + 1);
    std::string both = cut.substr(0, n_taken);
    sweep.on_run([&](const std::string& line) { both += line; });
    while (!sweep.done()) sweep.advance(0);
    CHECK(store.n_kept == 9);                                 // no reference again
    CHECK(std::count(both.begin(), both.end(), '\n') == 90);  // no run lost, none again
    CHECK(same_but_times(sweep.rows(), whole.rows()));
    for (const BenchRow& row : sweep.rows()) CHECK(row.n_runs == 2);
    // Rows measured before the cut have the times that they had then.
    Sweep again(plan_of(plan), store, "test");
    REQUIRE(again.resume(both) == both.size());
    for (std::size_t i = 0; i < 30; ++i)
      CHECK(json_bench_row(again.rows()[i]).dump() == json_bench_row(sweep.rows()[i]).dump());
  }
}

TEST_CASE("sweep: of a journal only the lines of this very sweep are taken", "[sweep]") {
  MemoryReferenceStore store;
  const Json plan = small_plan();
  const std::string journal = journal_of(plan, store);
  const std::size_t first = journal.find('\n') + 1;
  const std::size_t second = journal.find('\n', first) + 1;
  std::size_t round_end[3] = {};  // ends of rounds of four lines
  for (std::size_t line = 0, at = 0; line < 12; ++line)
    round_end[line / 4] = at = journal.find('\n', at) + 1;
  const auto n_taken = [&](const std::string& text, const Json& of) {
    return Sweep(plan_of(of), store, "test").resume(text);
  };
  CHECK(n_taken(journal + journal, plan) == journal.size());
  CHECK(n_taken(journal.substr(first), plan) == 0);
  CHECK(n_taken(journal.substr(0, round_end[0]) + journal.substr(round_end[1]), plan) ==
        round_end[0]);
  CHECK(n_taken(journal.substr(0, first) + journal.substr(second), plan) == first);
  CHECK(n_taken(journal.substr(0, first) + "{\"setting\": 1}\n", plan) == first);
  CHECK(n_taken(journal.substr(0, first) + std::string("\0\0\n", 3), plan) == first);
  Json longer = plan;
  longer["duration_s"] = 0.6;
  CHECK(n_taken(journal, longer) == 0);
}

TEST_CASE("sweep: a setting that cannot run is left out when a sweep goes on", "[sweep]") {
  Json plan = small_plan();
  plan["grid"]["/method"][1] = {{"stepper", "explicit"}, {"substeps", 1}};  // unstable
  MemoryReferenceStore store;
  const std::string journal = journal_of(plan, store);
  CHECK(std::count(journal.begin(), journal.end(), '\n') == 4 + 2 * 2);
  for (std::size_t n = 0; n < journal.size(); n += 97) {
    Sweep sweep(plan_of(plan), store, "test");
    sweep.resume(journal.substr(0, n));
    while (!sweep.done()) sweep.advance(kLongSlice);
    REQUIRE(sweep.rows().size() == 4);
    CHECK(sweep.rows()[1].status == "refused");
    CHECK(sweep.rows()[2].n_runs == 2);
  }
}

TEST_CASE("sweep: its identity is that of its plan, scene, fabric, core and commit", "[sweep]") {
  const Json plan = small_plan();
  const std::string identity = sweep_identity(plan_of(plan), "test");
  CHECK(sweep_identity(plan_of(json_sweep_plan(plan_of(plan))), "test") == identity);
  CHECK(sweep_identity(plan_of(plan), "other") != identity);
  for (const auto& [key, value] : {std::pair{"repeats", Json(3)},
                                   {"duration_s", Json(0.25)},
                                   {"reference", Json("rigid_chain")}}) {
    Json other = plan;
    other[key] = value;
    CHECK(sweep_identity(plan_of(other), "test") != identity);
  }
  // Equal names for other numbers.
  const auto softer = [](const JsonReader& root) {
    Scene scene = read_any_scene(root);
    scene.fabric.shear /= 2;
    return scene;
  };
  CHECK(sweep_identity(read_sweep_plan(JsonReader(plan), softer), "test") != identity);
}

TEST_CASE("sweep: the reference is newton's run on a mesh finer than any setting's", "[sweep]") {
  const SweepPlan plan = plan_of(small_plan());
  const SweepReferences references = sweep_references(plan);
  const Scene finest = references.recipes.at(references.of_setting[0].whole).scene;
  CHECK(finest.level == 2);
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

TEST_CASE("sweep: a smaller step and a finer mesh come nearer to the reference", "[sweep]") {
  Json plan = small_plan();
  plan["reference_level"] = 3;
  const std::vector<BenchRow> rows = rows_of(plan, kLongSlice);
  CHECK(rows[1].position_error < rows[0].position_error);
  CHECK(rows[3].position_error < rows[2].position_error);
  // These steps are small enough to leave the mesh's error.
  CHECK(rows[3].position_error < rows[1].position_error);
}

TEST_CASE("sweep: settings that differ in level and method alone share a reference", "[sweep]") {
  Json plan = small_plan();
  plan["grid"]["/fabric/name"] = {"silk", "wool"};
  const SweepReferences references = sweep_references(plan_of(plan));
  CHECK(references.recipes.size() == 2 * 3);
  for (std::size_t s = 0; s < 8; ++s) {
    CAPTURE(s);
    const auto& [whole, own] = references.of_setting[s];
    CHECK(whole == references.of_setting[s % 2].whole);
    CHECK(references.recipes[whole].scene.level == 2);
    REQUIRE(own);
    CHECK(references.recipes[*own].scene.level == plan_of(plan).settings[s].level);
    CHECK(references.recipes[*own].scene.fabric.name == (s % 2 == 0 ? "silk" : "wool"));
  }
  // A caption moves no vertex.
  plan["grid"] = {{"/caption", {"one", "two"}}};
  CHECK(sweep_references(plan_of(plan)).recipes.size() == 1);
}

TEST_CASE("sweep: a kept reference is not computed again", "[sweep]") {
  MemoryReferenceStore store;
  const SweepPlan plan = plan_of(small_plan());
  for (const ReferenceRecipe& recipe : sweep_references(plan).recipes) {
    Reference marked{{recipe.id, "kept", true}, {}};
    const int n_vertices = recipe.scene.cloth->n_vertices(recipe.scene.level);
    for (const double time : sweep_sample_times(plan.duration))
      marked.samples.push_back({time, Positions::Zero(3, n_vertices), {}});
    store.keep(marked);
  }
  Sweep sweep(plan, store, "test");
  while (sweep.rows().empty()) sweep.advance(0);
  CHECK(sweep.rows()[0].reference.description == "kept");
}

TEST_CASE("sweep: a finer reference that is there needs no coarser one", "[sweep]") {
  const SweepPlan plan = plan_of(small_plan());
  CountingStore store;
  Sweep first(plan, store, "test");
  while (!first.done()) first.advance(kLongSlice);
  CHECK(store.n_kept == 3);
  Json only_coarse = small_plan();
  only_coarse["grid"]["/refinement/level"] = {0};
  only_coarse["reference_level"] = 2;
  CountingStore shipped;
  Sweep sweep(plan_of(only_coarse), shipped, "test");
  for (const std::string& id : sweep.reference_ids()) shipped.keep(*store.find(id));
  CHECK(shipped.n_kept == 2);  // not that of level 1, from which the finer one is known
  while (!sweep.done()) sweep.advance(0);
  CHECK(shipped.n_kept == 2);
  CHECK(sweep.progress() == Approx(1));
}

TEST_CASE("sweep: a reference on a finer mesh is its own mesh's, doubted further", "[sweep]") {
  const SweepPlan plan = plan_of(small_plan());
  const std::vector<double> times = sweep_sample_times(plan.duration);
  const auto made = [&](const ReferenceRecipe& recipe, const Reference* coarser) {
    const auto maker = make_reference_maker(recipe, times, coarser);
    while (!maker->done()) maker->advance(kLongSlice);
    return maker->reference();
  };
  const std::vector<ReferenceRecipe> recipes = sweep_references(plan).recipes;
  const ReferenceRecipe& finer = recipes.at(1);
  REQUIRE(finer.kind == ReferenceKind::converged);
  const Reference coarser = made(recipes.at(*finer.coarser), nullptr);
  ReferenceRecipe own = finer;
  own.kind = ReferenceKind::same_mesh;
  own.coarser.reset();
  const Reference expected = made(finer, &coarser);
  const Reference found = checked_on_coarser(finer, made(own, nullptr), coarser);
  CHECK(write_reference(found) == write_reference(expected));
}

TEST_CASE("sweep: a reference of fewer vertices tells the same of what it has", "[sweep]") {
  const SweepPlan plan = plan_of(small_plan());
  MemoryReferenceStore whole;
  MemoryReferenceStore thinned;
  Sweep first(plan, whole, "test");
  while (!first.done()) first.advance(kLongSlice);
  const int n_coarse = first.rows().front().n_vertices;
  for (const std::string& id : first.reference_ids()) {
    Reference reference = *whole.find(id);
    thin(reference, n_coarse);
    thinned.keep(reference);
  }
  Sweep second(plan, thinned, "test");
  while (!second.done()) second.advance(kLongSlice);
  for (const std::size_t i : {0, 2}) {  // the long steps, whose errors are told
    CAPTURE(i);
    const BenchRow& expected = first.rows()[i];
    const BenchRow& found = second.rows()[i];
    const bool is_coarse = expected.level == 0;
    // The coarse vertices alone stand for the finer mesh.
    const double tolerance = is_coarse ? 1e-12 : 0.2;
    CHECK(found.position_error == Approx(expected.position_error).epsilon(tolerance));
    CHECK(found.position_error_95 == Approx(expected.position_error_95).epsilon(tolerance));
    CHECK(found.method_error == Approx(expected.method_error).epsilon(tolerance));
    CHECK(std::isnan(found.surface_error));
    CHECK(std::isnan(found.bend_error));
    CHECK(found.rms_stretch_error == Approx(expected.rms_stretch_error));
  }
}

TEST_CASE("sweep: what it takes in all is told once something has run", "[sweep]") {
  MemoryReferenceStore store;
  Sweep sweep(plan_of(small_plan()), store, "test");
  CHECK(sweep.report().at("estimated_s").is_null());
  while (sweep.rows().empty()) sweep.advance(0);
  const double early = sweep.report().at("estimated_s");
  CHECK(early > 0);
  while (!sweep.done()) sweep.advance(0);
  CHECK(sweep.report().at("estimated_s").get<double>() > 0);
}

TEST_CASE("sweep: a rigid chain is kept under the id that was expected", "[sweep]") {
  Json plan = small_plan();
  plan["reference"] = "rigid_chain";
  MemoryReferenceStore store;
  Sweep sweep(plan_of(plan), store, "test");
  while (sweep.rows().empty()) sweep.advance(kLongSlice);
  CHECK(sweep.rows()[0].reference.id == sweep_references(plan_of(plan)).recipes.at(0).id);
  CHECK(store.find(sweep.rows()[0].reference.id));
  CHECK(sweep.rows()[0].reference.converged);
}

TEST_CASE("sweep: a reference that a scene is not for is told at the scene", "[sweep]") {
  Json plan = small_plan();
  plan["reference"] = "rigid_chain";
  plan["scene"]["pins"] = Json::array();
  MemoryReferenceStore store;
  Sweep sweep(plan_of(plan), store, "test");
  try {
    sweep.advance(0);
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == "/scene/pins");
  }
}

TEST_CASE("sweep: a method that cannot run is a row that says why", "[sweep]") {
  Json plan = small_plan();
  plan["grid"].erase("/refinement/level");
  plan["grid"]["/method"][0] = {{"stepper", "explicit"}, {"substeps", 1}};  // unstable
  const std::vector<BenchRow> rows = rows_of(plan, kLongSlice);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].status == "refused");
  CHECK(rows[0].message.find("stability") != std::string::npos);
  CHECK(std::isnan(rows[0].position_error));
  CHECK(rows[1].finished());
  CHECK(front_of(rows) == std::vector<std::size_t>{1});
}

TEST_CASE("sweep: the reference's step is a quarter of the smallest, many substeps aside",
          "[sweep]") {
  Json plan = small_plan();
  Json& methods = plan["grid"]["/method"];
  methods = Json::array({{{"stepper", "xpbd"}, {"step_s", 1.0 / 300}, {"substeps", 100}},
                         {{"stepper", "implicit"}, {"step_s", 1.0 / 300}}});
  CHECK(reference_step(plan) == Approx(1.0 / 1200));
  methods[1]["substeps"] = 2;
  CHECK(reference_step(plan) == Approx(1.0 / 2400));
  methods.erase(1);
  CHECK(reference_step(plan) == Approx(1.0 / 1200));
  methods[0]["step_s"] = 1.0 / 60;
  CHECK(reference_step(plan) == Approx(1.0 / 960));
}

TEST_CASE("sweep: a plan reads back to what was written", "[sweep]") {
  Json plan = plan_of_thirty();
  plan["reference"] = "rigid_chain";
  const std::string text = format_json(json_sweep_plan(plan_of(plan)));
  const SweepPlan read = plan_of(parse_json(text));
  CHECK(read.settings.size() == 30);
  CHECK(read.settings[29].changes == plan_of(plan).settings[29].changes);
  CHECK(read.reference == ReferenceKind::rigid_chain);
  CHECK(format_json(json_sweep_plan(read)) == text);
}

TEST_CASE("sweep: a bad plan is refused at its place", "[sweep]") {
  struct Bad {
    Json plan;
    std::string where;
  };
  const auto grid = [](const char* pointer, Json values) {
    return sheet_plan({{"grid", {{pointer, std::move(values)}}}});
  };
  const auto setting = [](Json changes) {
    return sheet_plan({{"settings", Json::array({Json::object(), std::move(changes)})}});
  };
  Json particles = sheet_plan({{"grid", {{"/refinement/level", {1}}}}});
  particles["scene"] =
      parse_json(R"({"cloth": {"particles": {"positions_m": [[0, 0, 0]], "masses_kg": [1]}}})");
  Json fine = sheet_plan({{"grid", {{"/refinement/level", {3, 4}}}}});
  fine["scene"]["cloth"]["sheet"] = {{"columns", 64}, {"rows", 64}};
  Json both = setting({{"/caption", "b"}});
  both["grid"] = {{"/caption", {"a"}}};
  Json no_scene = sheet_plan(Json::object());
  no_scene.erase("scene");
  Json bad_scene = sheet_plan(Json::object());
  bad_scene["scene"]["cloth"]["sheet"]["rows"] = -1;
  Json many = grid("/caption", Json::array());
  for (int i = 0; i < 101; ++i) {
    many["grid"]["/caption"].push_back(std::to_string(i));
    many["grid"]["/name"].push_back(std::to_string(i));
  }
  const std::vector<Bad> cases = {
      {grid("/refinement/level", Json::array()), "/grid/~1refinement~1level"},
      {grid("/refinement/level", 1), "/grid/~1refinement~1level"},
      {grid("/refinement/level", {0, 9}), "/grid/~1refinement~1level/1"},
      {grid("/refinement/level", {0, 0}), "/grid/~1refinement~1level/1"},
      {grid("/duration_s", {1, 2}), "/grid/~1duration_s/0"},
      {grid("method", {1}), "/grid/method/0"},
      {grid("/pins/0", {1}), "/grid/~1pins~10/0"},
      {grid("/nonsense/key", {1}), "/grid/~1nonsense~1key/0"},
      {grid("/method/step_s", {1e-12}), "/grid/~1method~1step_s/0"},
      {fine, "/grid/~1refinement~1level/1"},
      {particles, "/grid/~1refinement~1level/0"},
      {many, "/grid"},
      {setting({{"/method/step_s", -1}}), "/settings/1/~1method~1step_s"},
      {setting({{"/method", {{"step_s", -1}}}}), "/settings/1/~1method"},
      {setting({{"/method", 3}, {"/caption", "c"}}), "/settings/1/~1method"},
      {setting({{"/method/substeps", 0}, {"/method", {{"substeps", 1}}}}),
       "/settings/1/~1method~1substeps"},
      {setting(Json::array()), "/settings/1"},
      {both, "/settings/1/~1caption"},
      {sheet_plan({{"settings", Json::array()}}), "/settings"},
      {sheet_plan({{"duration_s", 1e9}}), "/duration_s"},
      // The reference's steps are sixteen times as many.
      {sheet_plan({{"duration_s", 5e6}}), "/duration_s"},
      {sheet_plan({{"duration_s", 5e6}, {"reference", "rigid_chain"}}), "accepted"},
      {sheet_plan({{"duration_s", 0}}), "/duration_s"},
      {sheet_plan({{"repeats", 0}}), "/repeats"},
      {sheet_plan({{"reference", "none"}}), "/reference"},
      {sheet_plan({{"speed", 1}}), "/speed"},
      {bad_scene, "/scene/cloth/sheet/rows"},
      {sheet_plan({{"scene", "sheet.json"}}), "/scene"},
      {no_scene, ""},
  };
  for (const Bad& bad : cases) {
    const InputError fault = fault_of(bad.plan);
    CAPTURE(bad.plan.dump(), fault.sentence());
    CHECK(fault.where() == bad.where);
  }
  CHECK(fault_of(grid("/refinement/level", {0, 9})).sentence() ==
        "in the scene, /refinement/level: expected a whole number from 0 to 8, got 9");
}

namespace {

Json newton_method(double step) {
  return {{"stepper", "newton"}, {"rule", "midpoint"}, {"step_s", step}};
}

Json implicit_against_newton(const char* kind) {
  Json plan = small_plan();
  plan["grid"]["/method"] = Json::array({implicit_method(1.0 / 60), newton_method(1.0 / 60)});
  plan["duration_s"] = 0.3;
  plan["repeats"] = 1;
  plan["reference"] = kind;
  return plan;
}

}  // namespace

TEST_CASE("sweep: on the same mesh only the steps are wrong", "[sweep]") {
  const std::vector<BenchRow> rows = rows_of(implicit_against_newton("same_mesh"), kLongSlice);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].reference.id != rows[2].reference.id);  // one for each level
  CHECK(rows[0].reference.id == rows[1].reference.id);
  for (std::size_t level = 0; level < 2; ++level) {
    const BenchRow& implicit = rows[2 * level];
    const BenchRow& newton = rows[2 * level + 1];
    CHECK(implicit.level == newton.level);
    CHECK(implicit.position_error > 4 * implicit.reference.uncertainty);
    CHECK(implicit.position_error > 5 * newton.position_error);
    CHECK(implicit.surface_error > 0);
    CHECK(implicit.surface_error <= implicit.position_error);
    CHECK(implicit.bend_error >= 0);
    CHECK(implicit.reference.converged);
  }
}

TEST_CASE("sweep: newton's reference knows what its mesh leaves open", "[sweep]") {
  const std::vector<BenchRow> same = rows_of(implicit_against_newton("same_mesh"), kLongSlice);
  const std::vector<BenchRow> rows = rows_of(implicit_against_newton("converged"), kLongSlice);
  CHECK(rows[0].reference.id == rows[3].reference.id);
  CHECK(rows[0].reference.uncertainty > 3 * same[2].reference.uncertainty);
  CHECK(rows[0].reference.description.find("halving its mesh") != std::string::npos);
}

TEST_CASE("sweep: an error that the reference cannot tell is not shown, and said so", "[sweep]") {
  Json plan = implicit_against_newton("same_mesh");
  plan["grid"]["/method"] = Json::array({newton_method(1.0 / 480)});
  plan["reference_step_s"] = 1.0 / 60;  // coarser than what it judges
  const std::vector<BenchRow> rows = rows_of(plan, kLongSlice);
  for (const BenchRow& row : rows) {
    CHECK(std::isnan(row.position_error));
    CHECK(std::isnan(row.position_error_percent));
    CHECK_FALSE(row.reference.converged);
    CHECK(row.message.find("no error:") != std::string::npos);
    CHECK(row.finished());
  }
  CHECK(front_of(rows).empty());
  CHECK(markdown_table(rows).find("no error:") != std::string::npos);
}

TEST_CASE("sweep: a shape at rest is compared with its closed form", "[sweep]") {
  Json plan = small_plan();
  plan["scene"]["fabric"] = {{"areal_density_kg_per_m2", 0.2},
                             {"stretch_warp_n_per_m", 50},
                             {"stretch_weft_n_per_m", 50},
                             {"shear_n_per_m", 0}};
  plan["scene"]["cloth"]["sheet"]["warp_direction"] = {0, -1, 0};
  plan["scene"]["model"] = {{"bending", "none"}};
  Json at_rest = newton_method(0.05);
  at_rest["rule"] = "equilibrium";
  plan["grid"]["/method"] = Json::array({at_rest});
  plan["reference"] = "closed_form";
  for (const BenchRow& row : rows_of(plan, kLongSlice)) {
    CHECK(row.status == "ok");
    CHECK(row.position_error < 1e-9);
    CHECK(row.reference.converged);
  }
}
