#include "core/mesh/mesh_lines.h"

#include <algorithm>
#include <unordered_map>

#include "core/base/check.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

constexpr int kNone = -1;

/// Two edges within 60 degrees of opposite are one line: the cosine between their directions.
constexpr double kLargestCosine = -0.5;

/// Gathers the edges along one thread.
class EdgeCollector {
 public:
  explicit EdgeCollector(Thread thread) : thread_(thread) {}

  int add(FaceId id, int level, VertexId from, VertexId to, double length, double half_width) {
    const auto [place, is_new] =
        index_.try_emplace(edge_key(from, to), static_cast<int>(edges_.size()));
    if (is_new) {
      edges_.push_back({from, to, thread_, level, length, half_width, {id, FaceId()}});
    } else {
      edges_[place->second].faces[1] = id;
      edges_[place->second].width += half_width;
    }
    return place->second;
  }

  bool holds(const ThreadEdge& edge) const {
    return index_.count(edge_key(edge.from, edge.to)) > 0;
  }
  const std::vector<ThreadEdge>& edges() const { return edges_; }

 private:
  Thread thread_;
  std::vector<ThreadEdge> edges_;
  std::unordered_map<std::uint64_t, int> index_;  // only looked up, never walked
};

/// A line's way out of a vertex.
struct Arm {
  int edge = kNone;
  VertexId to;
  double width = 0;
  std::array<FaceId, 2> faces;  // faces beside the arm at the vertex
};

struct VertexArms {
  std::vector<Arm> arms;
  int n_faces = 0;
};

bool share_face(const Arm& a, const Arm& b) {
  for (const FaceId face : a.faces)
    if (face.valid() && (face == b.faces[0] || face == b.faces[1])) return true;
  return false;
}

/// Finds the arms of every vertex. Along the border of two levels the two edges from a vertex to
/// the hanging one and to the end of the coarser edge are one arm, which goes to the end.
std::vector<VertexArms> arms_of_vertices(const QuadMesh& mesh, const ThreadEdges& edges) {
  std::vector<VertexArms> vertices(static_cast<std::size_t>(mesh.n_vertices()));
  for (const QuadFace& face : mesh.faces())
    if (face.active())
      for (const VertexId v : face.corners) ++vertices[v].n_faces;
  std::unordered_map<std::uint64_t, int> halves;  // fine edges at hanging vertices
  std::vector<bool> hangs(vertices.size(), false);
  for (const HangingVertex& hanging : mesh.hanging_vertices()) {
    hangs[hanging.vertex] = true;
    for (const VertexId parent : hanging.parents)
      halves.emplace(edge_key(parent, hanging.vertex), kNone);
  }
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    const auto half = halves.find(edge_key(edges.edges[e].from, edges.edges[e].to));
    if (half != halves.end()) half->second = static_cast<int>(e);
  }
  const auto add = [&](int index, VertexId at, VertexId to) {
    const ThreadEdge& edge = edges.edges[index];
    if (hangs[at] || halves.count(edge_key(at, to)) > 0) return;
    Arm arm{index, to, edge.width, edge.faces};
    if (const VertexId middle = mesh.middle(at, to); middle.valid()) {
      const ThreadEdge& half = edges.edges[halves.at(edge_key(at, middle))];
      arm.width += half.width;
      arm.faces[1] = half.faces[0];
    }
    vertices[at].arms.push_back(arm);
  };
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    const ThreadEdge& edge = edges.edges[e];
    add(static_cast<int>(e), edge.from, edge.to);
    add(static_cast<int>(e), edge.to, edge.from);
  }
  return vertices;
}

struct ArmPair {
  std::size_t a, b;
  double cosine;  // cosine of the angle between their directions
};

/// The pairs of arms that are one line, by the faces where these say it and by the angle elsewhere.
std::vector<ArmPair> paired_arms(const QuadMesh& mesh, VertexId vertex, const VertexArms& at) {
  const auto direction = [&](const Arm& arm) {
    return Vec3(
        (mesh.rest_positions().col(arm.to) - mesh.rest_positions().col(vertex)).normalized());
  };
  std::vector<ArmPair> candidates;
  for (std::size_t a = 0; a < at.arms.size(); ++a)
    for (std::size_t b = a + 1; b < at.arms.size(); ++b)
      if (!share_face(at.arms[a], at.arms[b]))
        candidates.push_back({a, b, direction(at.arms[a]).dot(direction(at.arms[b]))});
  const bool is_regular =
      (at.n_faces == 4 && at.arms.size() == 4) || (at.n_faces == 2 && at.arms.size() == 3);
  if (is_regular) return candidates;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const ArmPair& p, const ArmPair& q) { return p.cosine < q.cosine; });
  std::vector<ArmPair> pairs;
  std::vector<bool> taken(at.arms.size(), false);
  for (const ArmPair& pair : candidates) {
    if (pair.cosine > kLargestCosine || taken[pair.a] || taken[pair.b]) continue;
    taken[pair.a] = taken[pair.b] = true;
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace

ThreadEdges thread_edges(const QuadMesh& mesh) {
  const Positions& x = mesh.rest_positions();
  const auto distance = [&x](VertexId a, VertexId b) { return (x.col(a) - x.col(b)).norm(); };
  EdgeCollector warp(Thread::warp);
  EdgeCollector weft(Thread::weft);
  ThreadEdges result;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    const QuadFace& face = mesh.faces()[f];
    if (!face.active()) continue;
    const auto& c = face.corners;
    const std::array<double, 4> length = {distance(c[0], c[1]), distance(c[3], c[2]),
                                          distance(c[0], c[3]), distance(c[1], c[2])};
    const double half_along_warp = (length[0] + length[1]) / 4;
    const double half_along_weft = (length[2] + length[3]) / 4;
    const FaceId id(static_cast<std::int64_t>(f));
    result.of_faces.push_back({warp.add(id, face.level, c[0], c[1], length[0], half_along_weft),
                               warp.add(id, face.level, c[3], c[2], length[1], half_along_weft),
                               weft.add(id, face.level, c[0], c[3], length[2], half_along_warp),
                               weft.add(id, face.level, c[1], c[2], length[3], half_along_warp)});
  }
  result.edges = warp.edges();
  for (const ThreadEdge& edge : weft.edges()) {
    PLEAT_CHECK(!warp.holds(edge), "faces agree on the thread of their common edge");
    result.edges.push_back(edge);
  }
  const int n_warp = static_cast<int>(warp.edges().size());
  for (std::array<int, 4>& edges : result.of_faces) {
    edges[2] += n_warp;
    edges[3] += n_warp;
  }
  return result;
}

std::vector<LineChord> line_chords(const QuadMesh& mesh, const ThreadEdges& edges) {
  struct Ranked {
    int first_edge;
    LineChord chord;
  };
  const std::vector<VertexArms> vertices = arms_of_vertices(mesh, edges);
  std::vector<Ranked> ranked;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const VertexId middle(static_cast<std::int64_t>(v));
    for (const ArmPair& pair : paired_arms(mesh, middle, vertices[v])) {
      const Arm* before = &vertices[v].arms[pair.a];
      const Arm* after = &vertices[v].arms[pair.b];
      if (edges.edges[before->edge].to != middle && edges.edges[after->edge].to == middle)
        std::swap(before, after);
      const ThreadEdge& first = edges.edges[before->edge];
      const ThreadEdge& second = edges.edges[after->edge];
      double width = (before->width + after->width) / 2;
      if (first.level != second.level)
        width = first.level < second.level ? before->width : after->width;
      ranked.push_back({before->edge,
                        {before->to, middle, after->to, first.length, second.length, width,
                         first.thread, second.thread}});
    }
  }
  // Ordered by the edges that they come from: springs and bends of one thread lie together.
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.first_edge < b.first_edge; });
  std::vector<LineChord> chords;
  chords.reserve(ranked.size());
  for (const Ranked& entry : ranked) chords.push_back(entry.chord);
  return chords;
}

std::vector<DiagonalChord> diagonal_chords(const QuadMesh& mesh) {
  struct Corner {
    const QuadFace* face;
    int place;
  };
  std::vector<std::vector<Corner>> corners(static_cast<std::size_t>(mesh.n_vertices()));
  for (const QuadFace& face : mesh.faces())
    if (face.active())
      for (int k = 0; k < 4; ++k) corners[face.corners[k]].push_back({&face, k});
  const auto share_edge = [](const Corner& a, const Corner& b) {
    const auto next = [](const Corner& c) { return c.face->corners[(c.place + 1) % 4]; };
    const auto last = [](const Corner& c) { return c.face->corners[(c.place + 3) % 4]; };
    return next(a) == last(b) || last(a) == next(b);
  };
  std::vector<DiagonalChord> chords;
  for (std::size_t v = 0; v < corners.size(); ++v) {
    if (corners[v].size() != 4) continue;
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) {
        const Corner& first = corners[v][a];
        const Corner& second = corners[v][b];
        if (first.face->level != second.face->level || share_edge(first, second)) continue;
        chords.push_back({first.face->corners[(first.place + 2) % 4],
                          VertexId(static_cast<std::int64_t>(v)),
                          second.face->corners[(second.place + 2) % 4]});
      }
    }
  }
  return chords;
}

}  // namespace pleat
