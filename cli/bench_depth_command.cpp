#include <cstdio>

#include "cli/command_table.h"
#include "core/base/core_version.h"
#include "core/files/whole_file.h"
#include "core/scene/format/surface_section.h"
#include "core/sweep/depth_cost.h"

namespace pleat {
namespace {

constexpr int kPlaces = 10000;
constexpr std::uint64_t kSeed = 1;

Outcome bench_depth(Arguments arguments) {
  const int n_places = arguments.whole_number("--places", 1, 100000000).value_or(kPlaces);
  const std::string file = arguments.word("BODY.obj");
  arguments.finish();
  const Json collider = {{"mesh", {{"obj", file}}}};
  const BodySurface body = read_surface(JsonReader(collider), "mesh", [](const std::string& name) {
                             return read_file(name);
                           }).surface();
  const DepthCost cost = depth_cost(body.places, body.triangles, n_places, kSeed);
  const Json json = {{"n_triangles", body.triangles.size()},
                     {"n_places", n_places},
                     {"build_ms", cost.build_ms},
                     {"query_ms", cost.query_ms},
                     {"bytes", cost.bytes},
                     {"n_checked", cost.n_checked},
                     {"largest_error_m", cost.largest_error},
                     {"n_wrong_sides", cost.n_wrong_sides},
                     {"core", core_version()}};
  std::printf("%s\n", json.dump().c_str());
  return Outcome::ok;
}

}  // namespace

extern const Command kBenchDepth(
    "depth", "BODY.obj", "what distances from a closed mesh cost, and how right they are",
    bench_depth, {},
    R"(  --places N             random, in and around it (default 10000)
)");

}  // namespace pleat
