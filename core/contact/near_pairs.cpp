#include "core/contact/near_pairs.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

/// Leaves that a leaf may overlap, on average. Ten layers that touch come to a fifth.
constexpr std::size_t kMostNeighbours = 100;

/// Boxes that have grown by so much in all are worth a new tree.
constexpr double kMostGrowth = 1.5;

using Edge = std::array<VertexId, 2>;

Edge edge_of(VertexId a, VertexId b) { return a < b ? Edge{a, b} : Edge{b, a}; }

template <class Item>
void sort_each_once(std::vector<Item>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Two numbers as one that orders by the first.
std::uint64_t key_of(int first, int second) {
  return (static_cast<std::uint64_t>(first) << 32) | static_cast<std::uint64_t>(second);
}
int first_of(std::uint64_t key) { return static_cast<int>(key >> 32); }
int second_of(std::uint64_t key) { return static_cast<int>(key & 0xffffffffU); }

/// Vertices in common, counted without a branch.
int n_shared(const Edge& a, const Edge& b) {
  return int{a[0] == b[0]} + int{a[0] == b[1]} + int{a[1] == b[0]} + int{a[1] == b[1]};
}
int n_shared(const Triangle& face, VertexId v) {
  return int{face[0] == v} + int{face[1] == v} + int{face[2] == v};
}

/// Takes what one pair of leaves finds: all is written, and kept if so told.
class FoundKeys {
 public:
  explicit FoundKeys(std::vector<std::uint64_t>& keys) : keys_(keys) {}
  FoundKeys(const FoundKeys&) = delete;
  FoundKeys& operator=(const FoundKeys&) = delete;
  ~FoundKeys() { keys_.insert(keys_.end(), found_, found_ + count_); }

  void add_if(bool overlaps, int n_shared, std::uint64_t key) {
    found_[count_] = key;
    count_ += int{overlaps} & int{n_shared == 0};
  }

 private:
  std::vector<std::uint64_t>& keys_;
  int count_ = 0;
  std::uint64_t found_[40];  // two faces have six edges, and 36 pairs of them
};

/// Sorts numbers below `n` that the keys have at `shift`, and keeps the order of equal ones.
void sort_by(int shift, int n, std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& sorted,
             std::vector<int>& starts) {
  const auto number = [shift](std::uint64_t key) {
    return static_cast<std::size_t>((key >> shift) & 0xffffffffU);
  };
  starts.assign(static_cast<std::size_t>(n) + 1, 0);
  for (const std::uint64_t key : keys) ++starts[number(key) + 1];
  for (int k = 0; k < n; ++k) starts[k + 1] += starts[k];
  sorted.resize(keys.size());
  for (const std::uint64_t key : keys) sorted[starts[number(key)]++] = key;
  keys.swap(sorted);
}

}  // namespace

NearPairs::NearPairs(std::vector<Triangle> faces, std::span<const HangingVertex> hanging,
                     int n_vertices)
    : n_vertices_(n_vertices), faces_(std::move(faces)) {
  const auto exists = [n_vertices](VertexId v) { return v >= 0 && v < n_vertices; };
  std::vector<Edge> halved;
  if (!hanging.empty()) parents_.resize(static_cast<std::size_t>(n_vertices));
  for (const HangingVertex& h : hanging) {
    PLEAT_CHECK(exists(h.vertex) && exists(h.parents[0]) && exists(h.parents[1]),
                "a vertex that hangs and its parents are the cloth's");
    parents_[h.vertex] = h.parents;
    halved.push_back(edge_of(h.parents[0], h.parents[1]));
  }
  std::sort(halved.begin(), halved.end());
  for (Triangle& face : faces_) {
    std::sort(face.begin(), face.end());
    PLEAT_CHECK(exists(face[0]) && exists(face[2]) && face[0] != face[1] && face[1] != face[2],
                "a face has three vertices of the cloth");
  }
  sort_each_once(faces_);
  for (const Triangle& f : faces_)
    for (const Edge& edge : {Edge{f[0], f[1]}, Edge{f[1], f[2]}, Edge{f[0], f[2]}})
      if (!std::binary_search(halved.begin(), halved.end(), edge)) edges_.push_back(edge);
  sort_each_once(edges_);
  for (const Triangle& f : faces_) {
    const auto number_of = [this](const Edge& edge) {
      const auto place = std::lower_bound(edges_.begin(), edges_.end(), edge);
      return place != edges_.end() && *place == edge ? static_cast<int>(place - edges_.begin())
                                                     : -1;
    };
    face_edges_.push_back(
        {number_of({f[0], f[1]}), number_of({f[1], f[2]}), number_of({f[0], f[2]})});
  }
}

NearPairs::NearPairs(std::vector<Triangle> faces, std::span<const HangingVertex> hanging,
                     std::vector<BoxGroup> groups)
    : NearPairs(std::move(faces), hanging, static_cast<int>(groups.size())) {
  groups_ = std::move(groups);
}

/// Fits all boxes; makes the tree first where there is none, and anew where it has grown too much.
void NearPairs::fit(const Corridors& corridors, double margin) {
  Vec3 origin(0, 0, 0);
  for (int v = n_vertices_; v-- > 0;)
    if ((corridors.begins.col(v).array().abs() < kFarthest).all()) origin = corridors.begins.col(v);
  vertex_boxes_.clear();
  for (int v = 0; v < n_vertices_; ++v)
    vertex_boxes_.push_back(box_on_way(corridors.begins.data() + 3 * v,
                                       corridors.ends.data() + 3 * v,
                                       corridors.rooms[v] + margin / 2, origin));
  for (std::size_t v = 0; v < groups_.size(); ++v) set_group(vertex_boxes_[v], groups_[v]);
  if (n_builds_ == 0 || fit_faces() > kMostGrowth * surface_at_build_) {
    build();
    surface_at_build_ = fit_faces();
  }
  edge_boxes_.clear();
  for (const OrderedEdge& edge : ordered_edges_)
    edge_boxes_.push_back(merged(vertex_boxes_[edge.ends[0]], vertex_boxes_[edge.ends[1]]));
}

/// Returns the surface of the tree.
double NearPairs::fit_faces() {
  face_boxes_.clear();
  for (const OrderedFace& face : ordered_faces_) face_boxes_.push_back(face_box(face.corners));
  return tree_.fit(face_boxes_);
}

MovingBox NearPairs::face_box(const Triangle& face) const {
  return merged(merged(vertex_boxes_[face[0]], vertex_boxes_[face[1]]), vertex_boxes_[face[2]]);
}

/// Makes the tree, and gives each vertex and edge to the first leaf that it is in.
void NearPairs::build() {
  ++n_builds_;
  face_boxes_.clear();
  for (const Triangle& face : faces_) face_boxes_.push_back(face_box(face));
  tree_.build(face_boxes_);
  ordered_faces_.clear();
  ordered_edges_.clear();
  ordered_vertices_.clear();
  leaves_.clear();
  vertex_owned_at_.resize(static_cast<std::size_t>(n_vertices_));
  edge_owned_at_.resize(edges_.size());
  for (int leaf = 0; leaf <= tree_.n_leaves(); ++leaf) {
    leaves_.push_back({tree_.first_of(leaf), static_cast<int>(ordered_vertices_.size()),
                       static_cast<int>(ordered_edges_.size())});
    if (leaf == tree_.n_leaves()) break;
    for (int k = tree_.first_of(leaf); k < tree_.first_of(leaf + 1); ++k) {
      const int number = tree_.order()[k];
      ordered_faces_.push_back({faces_[number], number});
      for (const VertexId v : faces_[number])
        if (std::exchange(vertex_owned_at_[v], n_builds_) != n_builds_)
          ordered_vertices_.push_back(v);
      for (const int edge : face_edges_[number])
        if (edge >= 0 && std::exchange(edge_owned_at_[edge], n_builds_) != n_builds_)
          ordered_edges_.push_back({edges_[edge], edge});
    }
  }
}

/// Adds pairs of a vertex that the one leaf owns and a face of the other.
void NearPairs::add_faces(int leaf_of_vertices, int leaf_of_faces) {
  FoundKeys found(vertex_face_);
  const int end_a = leaves_[leaf_of_vertices + 1].vertex;
  const int begin_b = leaves_[leaf_of_faces].face;
  const int end_b = leaves_[leaf_of_faces + 1].face;
  for (int a = leaves_[leaf_of_vertices].vertex; a < end_a; ++a) {
    const VertexId vertex = ordered_vertices_[a];
    const MovingBox& box = vertex_boxes_[vertex];
    for (int b = begin_b; b < end_b; ++b)
      found.add_if(overlap(box, face_boxes_[b]), n_shared(ordered_faces_[b].corners, vertex),
                   key_of(vertex, ordered_faces_[b].number));
  }
}

void NearPairs::add_edges(int leaf_a, int leaf_b) {
  FoundKeys found(edge_edge_);
  const int end_a = leaves_[leaf_a + 1].edge;
  const int end_b = leaves_[leaf_b + 1].edge;
  for (int a = leaves_[leaf_a].edge; a < end_a; ++a) {
    const OrderedEdge& edge = ordered_edges_[a];
    const MovingBox& box = edge_boxes_[a];
    for (int b = leaf_a == leaf_b ? a + 1 : leaves_[leaf_b].edge; b < end_b; ++b) {
      const OrderedEdge& other = ordered_edges_[b];
      found.add_if(
          overlap(box, edge_boxes_[b]), n_shared(edge.ends, other.ends),
          key_of(std::min(edge.number, other.number), std::max(edge.number, other.number)));
    }
  }
}

/// Drops pairs for which a vertex of the first side and one of the second are not to be looked at.
template <class Rule>
void NearPairs::leave_out(const Rule& rule) {
  const auto drop = [](std::vector<std::uint64_t>& keys, const auto& is_out) {
    keys.erase(std::remove_if(keys.begin(), keys.end(), is_out), keys.end());
  };
  drop(vertex_face_, [&](std::uint64_t key) {
    const VertexId v(first_of(key));
    const Triangle& face = faces_[second_of(key)];
    return rule(v, face[0]) || rule(v, face[1]) || rule(v, face[2]);
  });
  drop(edge_edge_, [&](std::uint64_t key) {
    const Edge& a = edges_[first_of(key)];
    const Edge& b = edges_[second_of(key)];
    return rule(a[0], b[0]) || rule(a[0], b[1]) || rule(a[1], b[0]) || rule(a[1], b[1]);
  });
}

/// Lists what was found, ascending: vertices, faces and edges are numbered so.
void NearPairs::list_pairs() {
  const int n_faces = static_cast<int>(faces_.size());
  const int n_edges = static_cast<int>(edges_.size());
  sort_by(0, n_faces, vertex_face_, sorted_, starts_);
  sort_by(32, n_vertices_, vertex_face_, sorted_, starts_);
  sort_by(0, n_edges, edge_edge_, sorted_, starts_);
  sort_by(32, n_edges, edge_edge_, sorted_, starts_);
  pairs_.clear();
  for (const std::uint64_t key : vertex_face_) {
    const Triangle& face = faces_[second_of(key)];
    pairs_.push_back(
        {SurfacePair::Kind::vertex_face, {VertexId(first_of(key)), face[0], face[1], face[2]}});
  }
  for (const std::uint64_t key : edge_edge_) {
    const Edge& a = edges_[first_of(key)];
    const Edge& b = edges_[second_of(key)];
    pairs_.push_back({SurfacePair::Kind::edges, {a[0], a[1], b[0], b[1]}});
  }
}

bool NearPairs::detect(const Corridors& corridors, double margin) {
  PLEAT_CHECK(corridors.begins.cols() == n_vertices_ && corridors.ends.cols() == n_vertices_ &&
                  corridors.rooms.size() == n_vertices_,
              "a corridor for every vertex");
  PLEAT_CHECK(margin >= 0 && margin - margin == 0, "a margin that is finite and not below 0");
  vertex_face_.clear();
  edge_edge_.clear();
  pairs_.clear();
  fit(corridors, margin);
  const auto overlapping =
      tree_.overlapping_leaves(kMostNeighbours * static_cast<std::size_t>(tree_.n_leaves()));
  if (!overlapping) return false;
  for (int leaf = 0; leaf < tree_.n_leaves(); ++leaf) {
    add_faces(leaf, leaf);
    add_edges(leaf, leaf);
  }
  for (const auto& [a, b] : *overlapping) {
    add_faces(a, b);
    add_faces(b, a);
    add_edges(a, b);
  }
  if (!parents_.empty())
    leave_out([this](VertexId a, VertexId b) {
      return parents_[a][0] == b || parents_[a][1] == b || parents_[b][0] == a ||
             parents_[b][1] == a;
    });
  if (std::any_of(vertex_boxes_.begin(), vertex_boxes_.end(), is_empty))
    leave_out([this](VertexId a, VertexId b) {
      return is_empty(vertex_boxes_[a]) || is_empty(vertex_boxes_[b]);
    });
  list_pairs();
  return true;
}

std::size_t NearPairs::bytes() const {
  const auto held = [](const auto&... vectors) {
    return ((vectors.capacity() * sizeof(vectors[0])) + ...);
  };
  return held(groups_, faces_, edges_, face_edges_, parents_, ordered_faces_, ordered_edges_,
              ordered_vertices_, leaves_, vertex_owned_at_, edge_owned_at_, vertex_boxes_,
              face_boxes_, edge_boxes_, vertex_face_, edge_edge_, sorted_, starts_, pairs_) +
         tree_.bytes();
}

}  // namespace pleat
