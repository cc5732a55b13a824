#include "core/dynamics/position_based/levels/attachments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

namespace pleat {
namespace {

constexpr std::size_t kMostPatches = 4;
constexpr double kNever = std::numeric_limits<double>::infinity();

struct Road {
  VertexId to;
  double length;  // [m]
};
using Roads = std::vector<std::vector<Road>>;

Roads roads_of(const ClothModel& model, const MeshHierarchy& hierarchy) {
  Roads roads(static_cast<std::size_t>(model.n_vertices()));
  const auto join = [&](VertexId a, VertexId b, double length) {
    roads[a].push_back({b, length});
    roads[b].push_back({a, length});
  };
  for (const Spring& spring : model.springs) join(spring.a, spring.b, spring.rest_length);
  for (const MeshLevel& level : hierarchy.levels)
    for (const LevelEdge& edge : level.edges)
      join(level.vertices[edge.a], level.vertices[edge.b], edge.geodesic);
  return roads;
}

/// Pins joined by springs, patch by patch.
std::vector<std::vector<VertexId>> patches_of(const ClothModel& model) {
  std::vector<bool> is_open(static_cast<std::size_t>(model.n_vertices()), false);
  for (const Pin& pin : model.pins) is_open[pin.vertex] = true;
  const Roads springs = roads_of(model, {});
  std::vector<std::vector<VertexId>> patches;
  for (const Pin& pin : model.pins) {
    if (!is_open[pin.vertex]) continue;
    is_open[pin.vertex] = false;
    std::vector<VertexId> patch{pin.vertex};
    for (std::size_t i = 0; i < patch.size(); ++i)
      for (const Road& road : springs[patch[i]])
        if (is_open[road.to]) {
          is_open[road.to] = false;
          patch.push_back(road.to);
        }
    patches.push_back(std::move(patch));
  }
  return patches;
}

struct Nearest {
  VertexId pin;
  double distance = kNever;  // [m]
};

/// The nearest pin of each vertex, by Dijkstra's algorithm from all pins of a patch at once.
std::vector<Nearest> nearest_by_roads(const Roads& roads, const std::vector<VertexId>& patch) {
  using Reached = std::pair<double, std::int32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  std::vector<Nearest> nearest(roads.size());
  for (const VertexId pin : patch) {
    nearest[pin] = {pin, 0};
    queue.emplace(0, pin);
  }
  while (!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    const Nearest from = nearest[static_cast<std::size_t>(v)];
    if (distance > from.distance) continue;
    for (const Road& road : roads[static_cast<std::size_t>(v)]) {
      if (distance + road.length >= nearest[road.to].distance) continue;
      nearest[road.to] = {from.pin, distance + road.length};
      queue.emplace(distance + road.length, road.to);
    }
  }
  return nearest;
}

std::vector<Nearest> nearest_on_rectangle(const RestCoordinates& at,
                                          const std::vector<VertexId>& patch) {
  std::vector<Nearest> nearest(static_cast<std::size_t>(at.cols()));
  for (Eigen::Index v = 0; v < at.cols(); ++v) {
    Nearest& best = nearest[static_cast<std::size_t>(v)];
    double least = kNever;
    for (const VertexId pin : patch) {
      const double square = (at.col(v) - at.col(pin)).squaredNorm();
      if (square >= least) continue;
      least = square;
      best.pin = pin;
    }
    best.distance = std::sqrt(least);
  }
  return nearest;
}

/// True where every spring is as long as its rest coordinates say and these fill their box: the
/// shortest path is straight then.
bool is_flat_rectangle(const ClothModel& model) {
  constexpr double kSame = 1e-6;
  const RestCoordinates& at = model.rest_coordinates;
  if (at.cols() != model.n_vertices() || model.surface.triangles.empty()) return false;
  for (const Spring& spring : model.springs) {
    const double length = (at.col(spring.a) - at.col(spring.b)).norm();
    if (std::abs(length - spring.rest_length) > kSame * spring.rest_length) return false;
  }
  double area = 0;
  for (const auto& [a, b, c] : model.surface.triangles) {
    const Eigen::Vector2d u = at.col(b) - at.col(a), v = at.col(c) - at.col(a);
    area += std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
  }
  const Eigen::Vector2d box = at.rowwise().maxCoeff() - at.rowwise().minCoeff();
  return std::abs(area - box.prod()) < kSame * area;
}

}  // namespace

std::vector<PlaceLength> long_range_attachments(const ClothModel& model,
                                                const MeshHierarchy& hierarchy) {
  const bool is_rectangle = is_flat_rectangle(model);
  const Roads roads = is_rectangle ? Roads() : roads_of(model, hierarchy);
  std::vector<std::vector<Nearest>> by_patch;
  for (const std::vector<VertexId>& patch : patches_of(model))
    by_patch.push_back(is_rectangle ? nearest_on_rectangle(model.rest_coordinates, patch)
                                    : nearest_by_roads(roads, patch));
  const std::vector<bool> is_pinned = model.pinned();
  std::vector<PlaceLength> lengths;
  std::vector<Nearest> holds;
  for (int v = 0; v < model.n_vertices(); ++v) {
    if (is_pinned[static_cast<std::size_t>(v)] || model.hangs(VertexId(v))) continue;
    holds.clear();
    for (const std::vector<Nearest>& patch : by_patch)
      if (patch[static_cast<std::size_t>(v)].distance < kNever)
        holds.push_back(patch[static_cast<std::size_t>(v)]);
    std::stable_sort(holds.begin(), holds.end(),
                     [](const Nearest& a, const Nearest& b) { return a.distance < b.distance; });
    if (holds.size() > kMostPatches) holds.resize(kMostPatches);
    for (const Nearest& hold : holds) lengths.push_back({{v, hold.pin}, hold.distance});
  }
  return lengths;
}

std::vector<PlaceLength> lengths_between_pins(const std::vector<PlaceLength>& attachments) {
  std::map<PlacePair, double> least;
  for (std::size_t i = 0; i < attachments.size(); ++i)
    for (std::size_t j = i + 1; j < attachments.size(); ++j) {
      if (attachments[j].places[0] != attachments[i].places[0]) break;
      const auto [low, high] = std::minmax(attachments[i].places[1], attachments[j].places[1]);
      const double sum = attachments[i].length + attachments[j].length;
      const auto known = least.try_emplace({low, high}, sum).first;
      known->second = std::min(known->second, sum);
    }
  std::vector<PlaceLength> lengths;
  lengths.reserve(least.size());
  for (const auto& [pins, length] : least) lengths.push_back({pins, length});
  return lengths;
}

AttachmentProgram::AttachmentProgram(const std::vector<PlaceLength>& attachments,
                                     const std::vector<int>& slots, double slack) {
  const auto slot_of = [&slots](int vertex) { return slots[static_cast<std::size_t>(vertex)]; };
  // By group of four and by how many of the same vertex are nearer: those come first.
  std::map<std::pair<int, int>, Operation> operations;
  int rank = 0;
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    const auto& [places, strain_free] = attachments[i];
    const double length = strain_free + slack;
    rank = i > 0 && attachments[i - 1].places[0] == places[0] ? rank + 1 : 0;
    const int slot = slot_of(places[0]);
    const int lane = slot % Float4::kLanes;
    Operation none{slot - lane, true, kNoMembers, {}};
    none.rest.fill(kEmptyLane);
    Operation& operation = operations.try_emplace({slot - lane, rank}, none).first->second;
    operation.pins[static_cast<std::size_t>(lane)] = slot_of(places[1]);
    operation.rest[static_cast<std::size_t>(lane)] = static_cast<float>(length * length);
  }
  for (auto& [key, operation] : operations) {
    const int some_pin = *std::max_element(operation.pins.begin(), operation.pins.end());
    for (int& pin : operation.pins)
      if (pin < 0) pin = some_pin;
    operation.has_one_pin = std::all_of(operation.pins.begin(), operation.pins.end(),
                                        [some_pin](int pin) { return pin == some_pin; });
    operations_.push_back(operation);
  }
  for (const auto& [places, length] : lengths_between_pins(attachments))
    between_pins_.push_back({slot_of(places[0]), slot_of(places[1]), length + 2 * slack});
}

float AttachmentProgram::stretch_of_pins(const LaneView& view) const {
  double most = 1;
  for (const auto& [a, b, length] : between_pins_) {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = (static_cast<double>(view.begins[k][a]) - view.begins[k][b]) +
                       (static_cast<double>(view.moves[k][a]) - view.moves[k][b]);
      square += d * d;
    }
    most = std::max(most, std::sqrt(square) / length);
  }
  return static_cast<float>(most);
}

// The rigid law of springs (core/dynamics/position_based/spring_law.h), with an end that does not
// move.
float AttachmentProgram::sweep(const LaneView& view) const {
  const float stretch = stretch_of_pins(view);
  const Float4 squared_stretch = Float4::all(stretch * stretch);
  const auto at_pins = [](const auto& arrays, const Operation& operation) {
    Vec3Lanes<Float4> places;
    std::size_t k = 0;
    for (Float4* const component : {&places.x, &places.y, &places.z}) {
      const float* const from = arrays[k++];
      const LaneMembers& pins = operation.pins;
      *component = operation.has_one_pin
                       ? Float4::all(from[pins[0]])
                       : Float4::load(std::array<float, 4>{from[pins[0]], from[pins[1]],
                                                           from[pins[2]], from[pins[3]]}
                                          .data());
    }
    return places;
  };
  for (const Operation& operation : operations_) {
    const int slot = operation.first_slot;
    const Vec3Lanes<Float4> moves = load<Float4>(view.moves, slot);
    const Vec3Lanes<Float4> d_begin =
        load<Float4>(view.begins, slot) - at_pins(view.begins, operation);
    const Vec3Lanes<Float4> d = d_begin + (moves - at_pins(view.moves, operation));
    const Float4 square = dot(d, d);
    const Float4 rest = squared_stretch * Float4::load(operation.rest.data());
    const Float4 excess = square - rest;
    if (positive_lanes(excess) == 0) continue;
    const Vec3Lanes<Float4> g = d + d_begin;
    const Float4 slope = max(dot(d, g), max(rest, square));
    const Float4 pull = where_positive(excess, Float4::all(0.5f) * excess / slope);
    store(moves - pull * g, view.moves, slot);
  }
  return stretch;
}

}  // namespace pleat
