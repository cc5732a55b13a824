#include "core/reference/reference.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/files/json_text.h"
#include "native-tests/support/models.h"

using namespace pleat;

namespace {

const std::vector<double> kSampleTimes = {0.5, 1};

Reference small_reference() {
  Reference reference{{"made-0123", "by hand", true}, {}};
  for (const double time : kSampleTimes) {
    Sample sample{time, Positions(3, 2), {0.01, 0.1 / 3}};
    sample.positions << 1.0 / 3, -0.0, 1e-300, 4, 5e17, time;
    reference.samples.push_back(sample);
  }
  return reference;
}

}  // namespace

TEST_CASE("reference: what is written reads back to the bit", "[reference]") {
  const Reference written = small_reference();
  const Reference read = read_reference(write_reference(written));
  CHECK(read.label.id == written.label.id);
  CHECK(read.label.description == written.label.description);
  CHECK(read.label.converged == written.label.converged);
  REQUIRE(read.samples.size() == 2);
  for (std::size_t s = 0; s < 2; ++s) {
    CHECK(read.samples[s].time == written.samples[s].time);
    CHECK(read.samples[s].positions == written.samples[s].positions);
    CHECK(read.samples[s].stretch.largest == written.samples[s].stretch.largest);
  }
}

TEST_CASE("reference: a file cut anywhere is refused", "[reference]") {
  const std::string bytes = write_reference(small_reference());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    CHECK_THROWS_AS(read_reference(bytes.substr(0, n)), InputError);
  CHECK_THROWS_AS(read_reference(bytes + "x"), InputError);
}

TEST_CASE("reference: a header that promises more than follows allocates nothing", "[reference]") {
  Json samples = Json::array();
  for (int s = 0; s < 10000; ++s)  // 24 TB
    samples.push_back({{"time_s", 1 + s},
                       {"n_vertices", 100'000'000},
                       {"rms_stretch", 0},
                       {"largest_stretch", 0}});
  const Json header{{"id", "a"}, {"description", "b"}, {"converged", false}, {"samples", samples}};
  CHECK_THROWS_AS(read_reference(header.dump() + "\n" + std::string(4800, 'x')), InputError);
}

TEST_CASE("reference: every change of scene, method or times has another id", "[reference]") {
  const Scene scene = released_sheet_scene(3, "fine cotton");
  const std::string id = reference_id("run", scene, kSampleTimes);
  CHECK(id == reference_id("run", scene, kSampleTimes));
  CHECK(id.rfind("run-", 0) == 0);

  Scene changed = scene;
  changed.gravity.y() = -9.8100000000000005 - 1e-15;
  CHECK(reference_id("run", changed, kSampleTimes) != id);
  changed = scene;
  changed.level = 1;
  CHECK(reference_id("run", changed, kSampleTimes) != id);
  changed = scene;
  changed.method.tolerance = 1e-4;
  CHECK(reference_id("run", changed, kSampleTimes) != id);
  CHECK(reference_id("run", scene, std::vector<double>{0.5}) != id);
}

TEST_CASE("reference: a library's fabric counts by its numbers", "[reference]") {
  Scene scene = released_sheet_scene(3, "fine cotton");
  const std::string id = reference_id("run", scene, kSampleTimes);
  scene.fabric_is_named = true;
  CHECK(reference_id("run", scene, kSampleTimes) == id);
  scene.fabric.shear *= 1 + 1e-15;
  CHECK(reference_id("run", scene, kSampleTimes) != id);
}

TEST_CASE("reference: what moves no vertex leaves the id as it is", "[reference]") {
  const Scene scene = released_sheet_scene(3, "fine cotton");
  Scene renamed = scene;
  renamed.name = "another";
  renamed.caption = "look";
  renamed.duration = 17;
  renamed.record.every = 1;
  CHECK(reference_id("run", renamed, kSampleTimes) == reference_id("run", scene, kSampleTimes));
}

// Fowler, Noll & Vo's published values of the 64-bit hash.
TEST_CASE("reference: the hash is FNV-1a", "[reference]") {
  CHECK(content_hash("") == "cbf29ce484222325");
  CHECK(content_hash("a") == "af63dc4c8601ec8c");
  CHECK(content_hash("foobar") == "85944171f73967e8");
}

TEST_CASE("reference: a store gives back what it keeps, and nothing else", "[reference]") {
  MemoryReferenceStore store;
  CHECK_FALSE(store.find("made-0123"));
  store.keep(small_reference());
  REQUIRE(store.find("made-0123"));
  CHECK(store.find("made-0123")->samples.size() == 2);
  CHECK_FALSE(store.find("made-0124"));
}
