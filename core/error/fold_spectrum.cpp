#include "core/error/fold_spectrum.h"

#include <cmath>
#include <map>
#include <utility>

#include "core/base/check.h"
#include "core/mesh/edge_key.h"

namespace pleat {
namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;

/// Points of a plane's cut through edges, and through which triangle each goes on to which other.
struct Cut {
  std::map<std::uint64_t, std::vector<std::uint64_t>> beside;  // neighbours of each edge
  std::map<std::uint64_t, Vec3> points;                        // point on each edge
};

Cut cut_at(const TriangleMesh& mesh, double height) {
  Cut cut;
  const Positions& x = mesh.rest_positions;
  for (const Triangle& t : mesh.triangles) {
    std::vector<std::uint64_t> crossed;
    for (int k = 0; k < 3; ++k) {
      const VertexId a = std::min(t[k], t[(k + 1) % 3]);
      const VertexId b = std::max(t[k], t[(k + 1) % 3]);
      const double above_a = x(1, a.value) - height;
      const double above_b = x(1, b.value) - height;
      if ((above_a > 0) == (above_b > 0)) continue;
      crossed.push_back(edge_key(a, b));
      cut.points[crossed.back()] = x.col(a) + above_a / (above_a - above_b) * (x.col(b) - x.col(a));
    }
    if (crossed.empty()) continue;
    cut.beside[crossed[0]].push_back(crossed[1]);
    cut.beside[crossed[1]].push_back(crossed[0]);
  }
  return cut;
}

/// Takes a line out of the cut. Where it is closed the first point is the last one, too.
std::vector<Vec3> taken_line(Cut& cut, std::uint64_t start) {
  std::vector<Vec3> line;
  std::uint64_t last = start;
  for (std::uint64_t at = start;;) {
    line.push_back(cut.points[at]);
    const auto place = cut.beside.find(at);
    if (place == cut.beside.end()) return line;
    const std::vector<std::uint64_t> beside = std::move(place->second);
    cut.beside.erase(place);
    const std::uint64_t next = beside[0] == last && beside.size() > 1 ? beside[1] : beside[0];
    if (next == last) return line;
    last = std::exchange(at, next);
  }
}

std::vector<std::vector<Vec3>> closed_lines(Cut cut) {
  std::vector<std::uint64_t> ends;
  for (const auto& [edge, beside] : cut.beside)
    if (beside.size() == 1) ends.push_back(edge);
  for (const std::uint64_t end : ends)
    if (cut.beside.count(end) > 0) taken_line(cut, end);
  std::vector<std::vector<Vec3>> lines;
  while (!cut.beside.empty()) lines.push_back(taken_line(cut, cut.beside.begin()->first));
  return lines;
}

Positions at_equal_steps(const std::vector<Vec3>& line, int n_points) {
  std::vector<double> ways{0};
  for (std::size_t i = 1; i < line.size(); ++i)
    ways.push_back(ways.back() + (line[i] - line[i - 1]).norm());
  Positions ring(3, n_points);
  std::size_t i = 1;
  for (int p = 0; p < n_points; ++p) {
    const double way = ways.back() * p / n_points;
    while (ways[i] <= way) ++i;  // the end is beyond all of them
    const double share = (way - ways[i - 1]) / (ways[i] - ways[i - 1]);
    ring.col(p) = line[i - 1] + share * (line[i] - line[i - 1]);
  }
  return ring;
}

}  // namespace

// With the turn s of a point, c the mean of the ring and u cos s + v sin s its first harmonic, the
// distance is r(s) = (x(s) - c) . d(s) with d(s) the direction of the harmonic. On a circle it is
// the radius: waves of n >= 3 in it change positions by harmonics of n - 1 and n + 1 alone.
FoldAmplitudes fold_amplitudes(const PositionsView& ring) {
  const Eigen::Index n = ring.cols();
  PLEAT_CHECK(n > 2 * kMostFolds, "a ring has two points for each fold");
  const Vec3 centre = ring.rowwise().mean();
  const Eigen::RowVectorXd turns = Eigen::RowVectorXd::LinSpaced(n, 0, kTurn * (n - 1) / n);
  const auto harmonic = [&](const Eigen::Ref<const Eigen::MatrixXd>& values, int k) {
    const Eigen::ArrayXd angles = k * turns.transpose().array();
    Eigen::MatrixXd both(values.rows(), 2);
    both.col(0) = 2.0 / static_cast<double>(n) * (values * angles.cos().matrix());
    both.col(1) = 2.0 / static_cast<double>(n) * (values * angles.sin().matrix());
    return both;
  };
  const Eigen::MatrixXd first = harmonic(ring, 1);
  Eigen::RowVectorXd distances(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const Vec3 direction = first.col(0) * std::cos(turns[p]) + first.col(1) * std::sin(turns[p]);
    distances[p] = (ring.col(p) - centre).dot(direction.normalized());
  }
  FoldAmplitudes amplitudes;
  for (int k = kFewestFolds; k <= kMostFolds; ++k)
    amplitudes[k - kFewestFolds] = harmonic(distances, k).norm();
  return amplitudes;
}

std::vector<Positions> rest_rings(const TriangleMesh& mesh, double height, int n_points) {
  std::vector<Positions> rings;
  for (const std::vector<Vec3>& line : closed_lines(cut_at(mesh, height)))
    rings.push_back(at_equal_steps(line, n_points));
  return rings;
}

std::vector<Positions> garment_rings(const TriangleMesh& mesh) {
  constexpr int kPoints = 256;                     // six for each of the narrowest folds
  constexpr double kShares[] = {0.5, 0.25, 0.01};  // shares of the height; the hem itself is no cut
  const double low = mesh.rest_positions.row(1).minCoeff();
  const double high = mesh.rest_positions.row(1).maxCoeff();
  std::vector<Positions> rings;
  for (const double share : kShares)
    for (Positions& ring : rest_rings(mesh, low + share * (high - low), kPoints))
      rings.push_back(std::move(ring));
  return rings;
}

FoldSpectrum::FoldSpectrum(const TriangleMesh& mesh, const std::vector<Positions>& rings)
    : squares_(Eigen::MatrixXd::Zero(FoldAmplitudes::RowsAtCompileTime,
                                     static_cast<Eigen::Index>(rings.size()))) {
  for (const Positions& ring : rings) maps_.emplace_back(mesh, ring);
}

void FoldSpectrum::add(const PositionsView& positions) {
  ++n_added_;
  for (std::size_t r = 0; r < maps_.size(); ++r)
    squares_.col(static_cast<Eigen::Index>(r)) +=
        fold_amplitudes(maps_[r].of(positions)).cwiseAbs2();
}

double fold_distance(const Eigen::Ref<const Eigen::MatrixXd>& amplitudes_a,
                     const Eigen::Ref<const Eigen::MatrixXd>& amplitudes_b) {
  PLEAT_CHECK(amplitudes_a.rows() == amplitudes_b.rows() && amplitudes_a.cols() > 0 &&
                  amplitudes_a.cols() == amplitudes_b.cols(),
              "two spectra are of the same rings");
  return (amplitudes_a - amplitudes_b).norm() / std::sqrt(static_cast<double>(amplitudes_a.cols()));
}

}  // namespace pleat
