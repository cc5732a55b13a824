#include "core/refinement/refinement_plan.h"

#include <algorithm>
#include <array>
#include <queue>
#include <set>

#include "core/base/check.h"
#include "core/refinement/mesh_match.h"
#include "core/refinement/shape_splits.h"

namespace pleat {
namespace {

std::string number_text(double number) {
  std::string text = std::to_string(number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// The level of a uniform mesh.
int uniform_level(const QuadMesh& mesh) { return mesh.faces().back().level; }

/// The highest pattern that any example gives a base vertex.
std::vector<int> merged_patterns(std::span<const BendExample> examples, int n_vertices) {
  std::vector<int> patterns(static_cast<std::size_t>(n_vertices), 0);
  for (const BendExample& example : examples)
    for (std::size_t v = 0; v < patterns.size(); ++v)
      patterns[v] = std::max(patterns[v], example.patterns.of_vertices[v]);
  return patterns;
}

/// Mean curvature over time of each fine vertex in the example where it is largest [1/m].
Eigen::VectorXd largest_means(std::span<const BendExample> examples) {
  Eigen::VectorXd largest = examples[0].features.row(0);
  for (const BendExample& example : examples.subspan(1))
    largest = largest.cwiseMax(example.features.row(0).transpose());
  return largest;
}

/// Loss of each face in the example where it is largest [m^4].
FaceLosses largest_losses(std::span<const BendExample> examples, std::size_t n_faces) {
  FaceLosses largest = FaceLosses::Zero(4, static_cast<Eigen::Index>(n_faces));
  for (const BendExample& example : examples) {
    PLEAT_CHECK(example.losses.cols() == largest.cols(), "an example has losses of each fine face");
    largest = largest.cwiseMax(example.losses);
  }
  return largest;
}

double corner_sum(const QuadFace& face, const Eigen::VectorXd& values) {
  double sum = 0;
  for (const VertexId v : face.corners) sum += values[v];
  return sum;
}

/// Splits a face with what balance needs, and appends the splits to `splits`.
template <class IsWanted>
void split_balanced(QuadMesh& mesh, FaceId face, const Eigen::VectorXd& demands,
                    const IsWanted& is_wanted, std::vector<PlannedSplit>& splits) {
  const std::size_t n_before = mesh.faces().size();
  mesh.refine(std::array{face});
  for (std::size_t f = n_before; f < mesh.faces().size(); f += 4) {
    const FaceId split = mesh.faces()[f].parent;
    const double sum = corner_sum(mesh.faces()[split], demands);
    splits.push_back({split, sum, !is_wanted(split, sum)});
  }
}

std::vector<PlannedSplit> split_by_demand(QuadMesh& mesh, Eigen::VectorXd demands,
                                          const PlanOptions& options) {
  std::vector<PlannedSplit> splits;
  const auto is_wanted = [&](FaceId, double sum) { return sum > options.demand; };
  for (;;) {
    std::vector<FaceId> wanted;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
      const QuadFace& face = mesh.faces()[f];
      const FaceId id(static_cast<std::int64_t>(f));
      if (face.active() && face.level < *options.level_cap &&
          is_wanted(id, corner_sum(face, demands)))
        wanted.push_back(id);
    }
    if (wanted.empty()) return splits;
    for (const FaceId face : wanted) split_balanced(mesh, face, demands, is_wanted, splits);
    const Eigen::RowVectorXd corrected = (demands.array() - 1).cwiseMax(0);
    demands = continued(corrected, mesh).transpose();
  }
}

/// Mean curvature of the fine vertices that each fine face covers [1/m].
class CoveredMeans {
 public:
  CoveredMeans(const QuadMesh& fine, Eigen::VectorXd curvature)
      : fine_(fine), curvature_(std::move(curvature)) {}

  double of(FaceId face) const {
    std::vector<VertexId> vertices;
    gather(face, vertices);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    double sum = 0;
    for (const VertexId v : vertices) sum += curvature_[v];
    return sum / static_cast<double>(vertices.size());
  }

 private:
  void gather(FaceId id, std::vector<VertexId>& vertices) const {
    const QuadFace& face = fine_.faces()[id];
    if (face.active())
      vertices.insert(vertices.end(), face.corners.begin(), face.corners.end());
    else
      for (const FaceId child : face.children) gather(child, vertices);
  }

  const QuadMesh& fine_;
  Eigen::VectorXd curvature_;
};

/// Vertices that refining a face would add.
int n_added(QuadMesh& mesh, FaceId face) {
  int n_centres = 0;
  std::set<std::pair<int, int>> edges;
  for (const FaceId split : mesh.balanced_splits(face)) {
    ++n_centres;
    const auto& c = mesh.faces()[split].corners;
    for (int k = 0; k < 4; ++k)
      if (!mesh.middle(c[k], c[(k + 1) % 4]).valid())
        edges.insert(std::minmax<int>(c[k], c[(k + 1) % 4]));
  }
  return n_centres + static_cast<int>(edges.size());
}

/// A face that may be split, the most urgent the largest.
struct Candidate {
  double excess = 0;     // sum of max(demand - level, 0) over the corners
  double curvature = 0;  // mean of the example over the cloth covered [1/m]
  FaceId face;

  bool operator<(const Candidate& other) const {
    if (excess != other.excess) return excess < other.excess;
    if (curvature != other.curvature) return curvature < other.curvature;
    return face > other.face;
  }
};

/// Splits the most urgent face that fits, until none does.
class BudgetSplitter {
 public:
  BudgetSplitter(QuadMesh& mesh, Eigen::VectorXd demands, const QuadMesh& fine,
                 Eigen::VectorXd curvature, const PlanOptions& options)
      : mesh_(mesh),
        demands_(std::move(demands)),
        fine_(fine),
        means_(fine, std::move(curvature)),
        options_(options) {
    for (int f = 0; f < mesh.n_base_faces(); ++f) offer(FaceId(f), FaceId(f));
  }

  /// A face that does not fit never will: what others add of its vertices is room that they take.
  std::vector<PlannedSplit> run() {
    while (!queue_.empty()) {
      const FaceId face = queue_.top().face;
      queue_.pop();
      if (mesh_.faces()[face].active() &&
          mesh_.n_vertices() + n_added(mesh_, face) <= *options_.max_vertices)
        split(face);
    }
    return std::move(splits_);
  }

 private:
  void offer(FaceId id, FaceId fine_face) {
    fine_faces_.push_back(fine_face);
    const QuadFace& face = mesh_.faces()[id];
    if (face.level >= *options_.level_cap) return;
    double excess = 0;
    for (const VertexId v : face.corners) excess += std::max(demands_[v] - face.level, 0.0);
    queue_.push({excess, means_.of(fine_face), id});
  }

  void split(FaceId face) {
    const std::size_t n_before = mesh_.faces().size();
    const auto is_wanted = [&](FaceId id, double) { return id == face; };
    split_balanced(mesh_, face, demands_, is_wanted, splits_);
    demands_ = continued(demands_.transpose(), mesh_).transpose();
    for (std::size_t f = n_before; f < mesh_.faces().size(); ++f) {
      const FaceId parent = mesh_.faces()[f].parent;
      offer(FaceId(static_cast<std::int64_t>(f)),
            fine_.faces()[fine_faces_[parent]].children[(f - n_before) % 4]);
    }
  }

  QuadMesh& mesh_;
  Eigen::VectorXd demands_;
  const QuadMesh& fine_;
  CoveredMeans means_;
  const PlanOptions& options_;
  std::vector<FaceId> fine_faces_;  // fine face that covers each face's cloth
  std::priority_queue<Candidate> queue_;
  std::vector<PlannedSplit> splits_;
};

}  // namespace

void check_plan_options(const PlanOptions& options, int n_patterns, const QuadMesh& base,
                        int max_level) {
  const double end = 4.0 * (n_patterns - 1);
  if (options.max_vertices) {
    if (*options.max_vertices < base.n_vertices())
      throw InputError("vertex budget", "expected at least the base mesh's " +
                                            std::to_string(base.n_vertices()) + ", got " +
                                            std::to_string(*options.max_vertices));
  } else if (options.criterion == PlanCriterion::shape) {
    if (!(options.largest_loss >= 0 && options.largest_loss < kLargestLossEnd))
      throw InputError("detail demand",
                       "expected what the criterion shape may lose, from 0 to below " +
                           number_text(kLargestLossEnd) + " m, got " +
                           number_text(options.largest_loss));
  } else if (!(options.demand >= 0 && options.demand < end)) {
    throw InputError("detail demand", "expected a number from 0 to below " + number_text(end) +
                                          ", got " + number_text(options.demand));
  }
  const int cap = options.level_cap.value_or(max_level);
  if (cap < 0 || cap > max_level)
    throw InputError("level cap", "expected a whole number from 0 to the fine mesh's level, " +
                                      std::to_string(max_level) + ", got " + std::to_string(cap));
}

RefinementPlan refinement_plan(const QuadMesh& base, const QuadMesh& fine,
                               std::span<const BendExample> examples, const PlanOptions& options) {
  PLEAT_CHECK(!examples.empty(), "a plan has an example");
  PLEAT_CHECK(static_cast<int>(base.faces().size()) == base.n_base_faces(),
              "the base mesh is not refined");
  PLEAT_CHECK(base_fingerprint(base) == base_fingerprint(fine), "both meshes have the same base");
  RefinementPlan plan;
  plan.n_patterns = static_cast<int>(examples[0].patterns.centres.cols());
  for (const BendExample& example : examples) {
    PLEAT_CHECK(example.features.cols() == fine.n_vertices() &&
                    static_cast<int>(example.patterns.of_vertices.size()) == fine.n_vertices(),
                "an example has features and a pattern of each fine vertex");
    PLEAT_CHECK(example.patterns.centres.cols() == plan.n_patterns,
                "all examples have as many patterns");
    plan.examples.push_back(
        {example.name, example.patterns.centres, example.patterns.low, example.patterns.high});
  }
  check_plan_options(options, plan.n_patterns, base, uniform_level(fine));
  plan.options = options;
  plan.options.level_cap = options.level_cap.value_or(uniform_level(fine));
  plan.patterns = merged_patterns(examples, base.n_vertices());
  plan.base_mesh = base_fingerprint(base);
  const Eigen::VectorXd demands =
      Eigen::Map<const Eigen::VectorXi>(plan.patterns.data(), base.n_vertices()).cast<double>();
  if (options.criterion == PlanCriterion::shape) {
    plan.splits = shape_splits(fine, largest_losses(examples, fine.faces().size()), plan.options);
    QuadMesh mesh = base;
    for (const PlannedSplit& split : plan.splits) mesh.refine(std::array{split.face});
    plan.n_vertices = mesh.n_vertices();
    return plan;
  }
  QuadMesh mesh = base;
  plan.splits =
      options.max_vertices
          ? BudgetSplitter(mesh, demands, fine, largest_means(examples), plan.options).run()
          : split_by_demand(mesh, demands, plan.options);
  plan.n_vertices = mesh.n_vertices();
  return plan;
}

QuadMesh planned_mesh(const QuadMesh& base, const RefinementPlan& plan) {
  PLEAT_CHECK(static_cast<int>(base.faces().size()) == base.n_base_faces(),
              "the base mesh is not refined");
  if (plan.base_mesh != base_fingerprint(base) ||
      plan.patterns.size() != static_cast<std::size_t>(base.n_vertices()))
    throw InputError("/base_mesh", "expected a plan for this mesh, got one for another");
  QuadMesh mesh = base;
  for (std::size_t s = 0; s < plan.splits.size(); ++s) {
    const FaceId face = plan.splits[s].face;
    const std::string where = "/splits/" + std::to_string(s);
    if (face < 0 || face >= static_cast<int>(mesh.faces().size()) ||
        mesh.faces()[face].level >= kMaxLevel || !mesh.faces()[face].active() ||
        mesh.balanced_splits(face).size() != 1)
      throw InputError(where,
                       "expected a face that can be split here, got " + std::to_string(face.value));
    mesh.refine(std::array{face});
  }
  if (mesh.n_vertices() != plan.n_vertices)
    throw InputError("/vertices", "expected " + std::to_string(mesh.n_vertices()) +
                                      ", which the splits make, got " +
                                      std::to_string(plan.n_vertices));
  return mesh;
}

}  // namespace pleat
