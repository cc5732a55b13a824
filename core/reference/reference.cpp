#include "core/reference/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/scene/format/scene_file.h"

namespace pleat {
namespace {

constexpr std::array<Word<Precision>, 2> kPrecisions{
    {{"float64", Precision::float64}, {"float32", Precision::float32}}};

double read_number_or_nan(const JsonReader& reader) {
  return reader.is_null() ? std::numeric_limits<double>::quiet_NaN() : reader.number(kNotNegative);
}

Json header_json(const Reference& reference, Precision precision) {
  Json samples = Json::array();
  for (const Sample& sample : reference.samples)
    samples.push_back(Json{{"time_s", sample.time},
                           {"n_vertices", sample.positions.cols()},
                           {"rms_stretch", sample.stretch.rms},
                           {"largest_stretch", sample.stretch.largest},
                           {"uncertainty_m", number_json(sample.uncertainty)}});
  Json json = json_label(reference.label);
  json["content"] = reference.content;
  json["physics"] = reference.physics;
  json["precision"] = word_for(kPrecisions, precision);
  json["samples"] = samples;
  return json;
}

template <class Number>
void append_positions(const Positions& positions, std::string& bytes) {
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): a double is cast too
  const Eigen::Matrix<Number, 3, Eigen::Dynamic> numbers = positions.cast<Number>();
  bytes.append(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::size_t>(numbers.size()) * sizeof(Number));
}

/// Fills the positions from bytes that are there.
template <class Number>
void take_positions(const char* bytes, Positions& positions) {
  Eigen::Matrix<Number, 3, Eigen::Dynamic> numbers(3, positions.cols());
  std::memcpy(numbers.data(), bytes, static_cast<std::size_t>(numbers.size()) * sizeof(Number));
  positions = numbers.template cast<double>();
}

std::size_t size_of(Precision precision) {
  return precision == Precision::float64 ? sizeof(double) : sizeof(float);
}

/// n_bytes  that follow the header: what they cannot fill is not allocated
Reference read_header(const JsonReader& header, std::size_t n_bytes, Precision precision) {
  constexpr std::int64_t kMostVertices = 100'000'000;
  auto n_left = static_cast<std::int64_t>(n_bytes / (3 * size_of(precision)));  // vertices
  constexpr std::int64_t kMostVersions = 1'000'000;
  header.allow_keys({"id", "description", "converged", "uncertainty_m", "content", "physics",
                     "precision", "samples"});
  Reference reference;
  reference.content = header.at("content").text();
  reference.physics = static_cast<int>(header.at("physics").integer(1, kMostVersions));
  reference.label = read_label(header);
  for (const JsonReader& entry : header.at("samples").elements()) {
    Sample sample{entry.at("time_s").number(kPositive), {}, {}};
    const std::int64_t n_vertices = entry.at("n_vertices").integer(1, kMostVertices);
    if (n_vertices > n_left) throw InputError("", "the reference's positions are cut short");
    n_left -= n_vertices;
    sample.positions.resize(3, n_vertices);
    sample.stretch = {entry.at("rms_stretch").number(kNotNegative),
                      entry.at("largest_stretch").number(kNotNegative)};
    sample.uncertainty = read_number_or_nan(entry.at("uncertainty_m"));
    reference.samples.push_back(std::move(sample));
  }
  return reference;
}

}  // namespace

Json json_label(const ReferenceLabel& label) {
  return {{"id", label.id},
          {"description", label.description},
          {"converged", label.converged},
          {"uncertainty_m", number_json(label.uncertainty)}};
}

ReferenceLabel read_label(const JsonReader& reader) {
  ReferenceLabel label{reader.at("id").text(), reader.at("description").text(),
                       reader.at("converged").boolean()};
  if (label.id.empty()) reader.at("id").fail("the id of what errors are measured against");
  label.uncertainty = read_number_or_nan(reader.at("uncertainty_m"));
  return label;
}

std::string step_phrase(double step) {
  constexpr double kRounding = 1e-9;  // relative; what 1/n written in 15 digits has
  const double per_second = 1 / step;
  const bool is_whole_part = std::abs(std::round(per_second) - per_second) < kRounding * per_second;
  return is_whole_part && per_second > 0.5 ? formatted("1/%.0f s", per_second)
                                           : formatted("%.3g s", step);
}

void thin(Reference& reference, std::int64_t n_vertices) {
  for (Sample& sample : reference.samples) {
    const Eigen::Index n = std::min<Eigen::Index>(n_vertices, sample.positions.cols());
    sample.positions = sample.positions.leftCols(n).eval();
  }
}

std::string reference_id(std::string_view prefix, const Scene& scene,
                         std::span<const double> times) {
  std::string content = "physics " + std::to_string(kPhysicsVersion);
  content.append("\n").append(write_scene(moving_part(scene)));
  for (const double time : times) content.append("\n").append(Json(time).dump());
  return std::string(prefix) + "-" + content_hash(content);
}

std::optional<Reference> MemoryReferenceStore::find(const std::string& id) {
  const auto place = references_.find(id);
  if (place == references_.end()) return std::nullopt;
  return place->second;
}

std::string write_reference(const Reference& reference, Precision precision) {
  std::string bytes = header_json(reference, precision).dump() + "\n";
  for (const Sample& sample : reference.samples) {
    if (precision == Precision::float64)
      append_positions<double>(sample.positions, bytes);
    else
      append_positions<float>(sample.positions, bytes);
  }
  return bytes;
}

Reference read_reference(std::string_view bytes) {
  const std::size_t line = std::min(bytes.find('\n'), bytes.size());
  std::size_t at = std::min(line + 1, bytes.size());
  const Json json = parse_json(bytes.substr(0, line));
  const JsonReader header(json);
  const Precision precision = header.at("precision").word(kPrecisions);
  Reference reference = read_header(header, bytes.size() - at, precision);
  for (Sample& sample : reference.samples) {
    if (precision == Precision::float64)
      take_positions<double>(bytes.data() + at, sample.positions);
    else
      take_positions<float>(bytes.data() + at, sample.positions);
    if (!sample.positions.allFinite())
      throw InputError("", "expected finite positions in the reference, got others");
    at += static_cast<std::size_t>(sample.positions.size()) * size_of(precision);
  }
  if (at != bytes.size()) throw InputError("", "the reference has bytes after its positions");
  return reference;
}

}  // namespace pleat
