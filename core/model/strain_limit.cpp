#include "core/model/strain_limit.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kStraight = 0.7071;  // the cosine of 45 degrees

/// Takes edges out of a cloth, line by line.
class LineFinder {
 public:
  LineFinder(const std::vector<GaugeEdge>& edges, const PositionsView& positions)
      : edges_(edges),
        positions_(positions),
        is_taken_(edges.size(), char{0}),
        around_(static_cast<std::size_t>(positions.cols())) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      around_[edges[e].a].push_back(e);
      around_[edges[e].b].push_back(e);
    }
  }

  bool is_taken(std::size_t e) const { return is_taken_[e] != 0; }

  /// The line of an edge that is not taken.
  std::vector<GaugeEdge> take_line(std::size_t e) {
    is_taken_[e] = 1;
    std::vector<GaugeEdge> line;
    extend({edges_[e].b, edges_[e].a, edges_[e].rest_length}, line);
    std::reverse(line.begin(), line.end());
    for (GaugeEdge& edge : line) std::swap(edge.a, edge.b);
    line.push_back(edges_[e]);
    extend(edges_[e], line);
    return line;
  }

 private:
  /// Goes on from the end b of an edge.
  void extend(GaugeEdge last, std::vector<GaugeEdge>& line) {
    while (true) {
      const Vec3 ahead = (positions_.col(last.b) - positions_.col(last.a)).normalized();
      std::size_t best = edges_.size();
      double best_cosine = kStraight;
      VertexId best_end;
      for (const std::size_t e : around_[last.b]) {
        if (is_taken(e)) continue;
        const VertexId end = edges_[e].a == last.b ? edges_[e].b : edges_[e].a;
        const double cosine =
            ahead.dot((positions_.col(end) - positions_.col(last.b)).normalized());
        if (cosine <= best_cosine) continue;
        best = e;
        best_cosine = cosine;
        best_end = end;
      }
      if (best == edges_.size()) return;
      is_taken_[best] = 1;
      last = {last.b, best_end, edges_[best].rest_length};
      line.push_back(last);
    }
  }

  const std::vector<GaugeEdge>& edges_;
  const PositionsView& positions_;
  std::vector<char> is_taken_;
  std::vector<std::vector<std::size_t>> around_;  // the edges at each vertex
};

}  // namespace

std::vector<GaugeEdge> in_lines(const std::vector<GaugeEdge>& edges,
                                const PositionsView& rest_positions) {
  LineFinder finder(edges, rest_positions);
  std::vector<GaugeEdge> ordered;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (finder.is_taken(e)) continue;
    const std::vector<GaugeEdge> line = finder.take_line(e);
    ordered.insert(ordered.end(), line.begin(), line.end());
  }
  return ordered;
}

void StrainLimitOptions::validate() const {
  PLEAT_CHECK(stretch > 0, "an edge may stretch");
  PLEAT_CHECK(compression > 0 && compression <= 1, "an edge may be compressed, to nothing at most");
  PLEAT_CHECK(max_sweeps >= 1, "a limit takes a sweep at least");
}

}  // namespace pleat
