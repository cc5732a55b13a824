#include "core/modal/key_completion.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"
#include "core/modal/fill_in.h"

namespace pleat {
namespace {

using Frame = KeyCompletion::Frame;

void check_keys(const std::vector<Positions>& keys, const std::vector<Triangle>& triangles) {
  if (keys.size() < 2)
    throw InputError("",
                     "expected two keys or more, between which there is something to fill in; "
                     "found " +
                         std::to_string(keys.size()));
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k].cols() != keys[0].cols())
      throw InputError("", "expected keys with the same vertices; key 0 has " +
                               std::to_string(keys[0].cols()) + ", key " + std::to_string(k) +
                               " has " + std::to_string(keys[k].cols()));
    if (!keys[k].allFinite())
      throw InputError("", "expected finite places; key " + std::to_string(k) + " has others");
  }
  if (triangles.empty()) throw InputError("", "expected a surface, found no triangle");
}

/// The vertices of each part of a surface.
std::vector<std::vector<VertexId>> part_vertices(Eigen::Index n_vertices,
                                                 const std::vector<Triangle>& triangles) {
  std::vector<bool> is_used(static_cast<std::size_t>(n_vertices), false);
  for (const Triangle& triangle : triangles)
    for (const VertexId v : triangle) is_used[static_cast<std::size_t>(v)] = true;
  const std::vector<int> numbers = surface_parts(n_vertices, triangles);
  std::vector<std::vector<VertexId>> parts;
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (!is_used[v])
      throw InputError(
          "", "expected every vertex in a triangle; vertex " + std::to_string(v) + " is in none");
    const auto part = static_cast<std::size_t>(numbers[v]);
    if (part == parts.size()) parts.emplace_back();
    parts[part].push_back(VertexId(static_cast<int>(v)));
  }
  return parts;
}

std::vector<Triangle> triangles_of(const std::vector<VertexId>& part, Eigen::Index n_vertices,
                                   const std::vector<Triangle>& triangles) {
  std::vector<int> index(static_cast<std::size_t>(n_vertices), -1);
  for (std::size_t i = 0; i < part.size(); ++i)
    index[static_cast<std::size_t>(part[i])] = static_cast<int>(i);
  const auto renumbered = [&](VertexId v) { return VertexId(index[static_cast<std::size_t>(v)]); };
  std::vector<Triangle> own;
  for (const auto& [a, b, c] : triangles)
    if (renumbered(a).valid()) own.push_back({renumbered(a), renumbered(b), renumbered(c)});
  return own;
}

Positions columns(const Positions& all, const std::vector<VertexId>& vertices) {
  Positions some(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    some.col(static_cast<Eigen::Index>(i)) = all.col(vertices[i]);
  return some;
}

}  // namespace

double KeyCompletion::Frame::unequal_halves() const {
  double from_a = 0, from_b = 0;
  for (const ModalBody::Shape& body : bodies) {
    from_a += body.distances.from_a;
    from_b += body.distances.from_b;
  }
  const double larger = std::max(from_a, from_b);
  return larger > 0 ? std::abs(from_a - from_b) / larger : 0;
}

KeyCompletion::KeyCompletion(const std::vector<Positions>& keys,
                             const std::vector<Triangle>& triangles, const ModalOptions& options) {
  check_keys(keys, triangles);
  n_vertices_ = keys.front().cols();
  vertices_ = part_vertices(n_vertices_, triangles);
  bodies_.reserve(vertices_.size());
  for (const std::vector<VertexId>& vertices : vertices_) {
    std::vector<Positions> own;
    own.reserve(keys.size());
    for (const Positions& key : keys) own.push_back(columns(key, vertices));
    bodies_.emplace_back(own, triangles_of(vertices, n_vertices_, triangles), options);
  }
}

std::vector<Frame> KeyCompletion::key_frames() const {
  std::vector<Frame> frames;
  for (int k = 0; k < n_keys(); ++k) {
    Frame frame{static_cast<double>(k), k, 0, {}};
    for (const ModalBody& body : bodies_) frame.bodies.push_back(body.key(k));
    frames.push_back(std::move(frame));
  }
  return frames;
}

Frame KeyCompletion::middle(const Frame& a, const Frame& b) const {
  const double time = (a.time + b.time) / 2;
  Frame frame{time, a.left, time - a.left, {}};
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    frame.bodies.push_back(bodies_[i].middle(a.bodies[i], b.bodies[i]));
  return frame;
}

std::vector<Frame> KeyCompletion::frames(int count) const {
  std::vector<Frame> frames = key_frames();
  fill_in(
      frames,
      [&](const Frame& a, const Frame& b) {
        double sum = 0;
        for (std::size_t i = 0; i < bodies_.size(); ++i)
          sum += bodies_[i].distance(a.bodies[i], b.bodies[i]);
        return sum;
      },
      [&](const Frame& a, const Frame& b) { return middle(a, b); },
      [&](std::size_t n, double) { return n < static_cast<std::size_t>(std::max(count, 0)); });
  return frames;
}

std::vector<Frame> KeyCompletion::frames_by_step(double step, int most) const {
  PLEAT_CHECK(step > 0, "a step is positive");
  std::vector<Frame> frames = key_frames();
  fill_in(
      frames,
      [&](const Frame& a, const Frame& b) {
        return (surface(a) - surface(b)).colwise().norm().maxCoeff();
      },
      [&](const Frame& a, const Frame& b) { return middle(a, b); },
      [&](std::size_t n, double widest) {
        return widest > step && n < static_cast<std::size_t>(std::max(most, 0));
      });
  return frames;
}

Positions KeyCompletion::surface(const Frame& frame) const {
  Positions surface(3, n_vertices_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Positions own = bodies_[i].surface(frame.bodies[i], frame.left, frame.share_of_next);
    for (std::size_t j = 0; j < vertices_[i].size(); ++j)
      surface.col(vertices_[i][j]) = own.col(static_cast<Eigen::Index>(j));
  }
  return surface;
}

SolveReport KeyCompletion::replace_key(int index, const Positions& surface) {
  PLEAT_CHECK(index >= 0 && index < n_keys() && surface.cols() == n_vertices_,
              "a key that there is, of the same vertices");
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolveReport report = bodies_[i].replace_key(index, columns(surface, vertices_[i]));
    if (report.ends_run()) return report;
  }
  return {};
}

}  // namespace pleat
