#include "core/run/run_warning.h"

#include <array>
#include <limits>

#include "core/base/formatted.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {
namespace {

constexpr std::array<Word<RunWarning::Kind>, 9> kKinds = {
    {{"stretch", RunWarning::Kind::stretch},
     {"speed", RunWarning::Kind::speed},
     {"unsolved", RunWarning::Kind::unsolved},
     {"not_converged", RunWarning::Kind::not_converged},
     {"given_up", RunWarning::Kind::given_up},
     {"unbalanced", RunWarning::Kind::unbalanced},
     {"held_back", RunWarning::Kind::held_back},
     {"blocked", RunWarning::Kind::blocked},
     {"soft", RunWarning::Kind::soft}}};

}  // namespace

std::string sentence(const RunWarning& warning) {
  const double time = warning.time;
  const int vertex = warning.vertex.value;
  const double share = 100 * warning.value;  // [%], as is the next
  const double explained = 100 * warning.bound;
  switch (warning.kind) {
    case RunWarning::Kind::stretch:
      return formatted(
          "from %.3g s at vertex %d on, the cloth stretched by up to %.3g %%; its load explains "
          "%.3g %%",
          time, vertex, share, explained);
    case RunWarning::Kind::soft:
      return formatted(
          "from %.3g s at vertex %d on, the cloth stretched like a softer fabric, by up to %.3g "
          "%%; its own explains %.3g %%",
          time, vertex, share, explained);
    case RunWarning::Kind::speed:
      return formatted(
          "from %.3g s at vertex %d on, the cloth was as fast as %.3g m/s; falling and pulling "
          "explain %.3g m/s",
          time, vertex, warning.value, warning.bound);
    case RunWarning::Kind::unsolved:
      return formatted("from %.3g s on, steps left %.3g %% of their equations unsolved", time,
                       share);
    case RunWarning::Kind::not_converged:
      return formatted(
          "from %.3g s on, steps did not converge and left %.3g %% of their equations unsolved",
          time, share);
    case RunWarning::Kind::given_up:
      return formatted(
          "from %.3g s on, the solver gave up in some steps, and a factor solved them in its place",
          time);
    case RunWarning::Kind::unbalanced:
      return formatted(
          "from %.3g s on, cloth at rest was held up by what its steps leave unsolved, not by the "
          "cloth: %.3g %% of its weight was unbalanced",
          time, share);
    case RunWarning::Kind::held_back:
      return formatted(
          "from %.3g s on, %.3g %% of the vertices were held back from passing through cloth "
          "or a solid: their motion is the guard's, not the method's",
          time, share);
    case RunWarning::Kind::blocked:
      return formatted(
          "from %.3g s on, cloth was pulled through itself or a solid, and what pulled was held "
          "back in %.3g substeps",
          time, warning.value);
  }
  return "";
}

std::string advice(const RunWarning& warning) {
  std::string text = "try";
  for (const SettingHint& hint : warning.hints)
    text +=
        (&hint == warning.hints.data() ? " " : " or ") + hint.pointer + " = " + hint.value.dump();
  return text;
}

Json json_warning(const RunWarning& warning) {
  Json hints = Json::object();
  for (const SettingHint& hint : warning.hints) hints[hint.pointer] = hint.value;
  return {{"kind", word_for(kKinds, warning.kind)},
          {"time_s", warning.time},
          {"vertex", warning.vertex.value},
          {"value", warning.value},
          {"bound", warning.bound},
          {"is_nonsense", warning.is_nonsense()},
          {"hints", hints},
          {"sentence", sentence(warning)}};
}

Json json_warnings(std::span<const RunWarning> warnings) {
  Json json = Json::array();
  for (const RunWarning& warning : warnings) json.push_back(json_warning(warning));
  return json;
}

std::vector<RunWarning> read_warnings(const JsonReader& reader) {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  std::vector<RunWarning> warnings;
  for (const JsonReader& element : reader.elements()) {
    RunWarning warning{element.at("kind").word(kKinds),
                       element.at("time_s").number(kNotNegative),
                       VertexId(static_cast<int>(element.at("vertex").integer(0, kMaxVertices))),
                       element.at("value").number_or(kBeyond),
                       element.at("bound").number_or(kBeyond),
                       {}};
    for (const auto& [pointer, value] : element.at("hints").members())
      warning.hints.push_back({pointer, value.json()});
    warnings.push_back(std::move(warning));
  }
  return warnings;
}

}  // namespace pleat
