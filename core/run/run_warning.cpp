#include "core/run/run_warning.h"

#include <array>
#include <limits>

#include "core/base/formatted.h"
#include "core/mesh/triangle_mesh.h"

namespace pleat {
namespace {

constexpr std::array<Word<RunWarning::Kind>, 7> kKinds = {
    {{"stretch", RunWarning::Kind::stretch},
     {"speed", RunWarning::Kind::speed},
     {"unsolved", RunWarning::Kind::unsolved},
     {"not_converged", RunWarning::Kind::not_converged},
     {"given_up", RunWarning::Kind::given_up},
     {"unbalanced", RunWarning::Kind::unbalanced},
     {"soft", RunWarning::Kind::soft}}};

}  // namespace

std::string sentence(const RunWarning& warning) {
  const std::string since = "from " + three_digits(warning.time) + " s";
  const std::string place = since + " at vertex " + std::to_string(warning.vertex.value);
  const std::string left = three_digits(100 * warning.value) + " % of their equations unsolved";
  switch (warning.kind) {
    case RunWarning::Kind::stretch:
      return place + " on, the cloth stretched by up to " + three_digits(100 * warning.value) +
             " %; its load explains " + three_digits(100 * warning.bound) + " %";
    case RunWarning::Kind::soft:
      return place + " on, the cloth stretched like a softer fabric, by up to " +
             three_digits(100 * warning.value) + " %; its own explains " +
             three_digits(100 * warning.bound) + " %";
    case RunWarning::Kind::speed:
      return place + " on, the cloth was as fast as " + three_digits(warning.value) +
             " m/s; falling and pulling explain " + three_digits(warning.bound) + " m/s";
    case RunWarning::Kind::unsolved:
      return since + " on, steps left " + left;
    case RunWarning::Kind::not_converged:
      return since + " on, steps did not converge and left " + left;
    case RunWarning::Kind::given_up:
      return since + " on, the solver gave up in some steps, and a factor solved them in its place";
    case RunWarning::Kind::unbalanced:
      return since + " on, cloth at rest was held up by too few rounds, not by the cloth: " +
             three_digits(100 * warning.value) + " % of its weight was unbalanced";
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
