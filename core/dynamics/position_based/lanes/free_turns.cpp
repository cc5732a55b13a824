#include "core/dynamics/position_based/lanes/free_turns.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace pleat {
namespace {

/// Pins nearer to a line than this share of its length are in it.
constexpr double kLineTolerance = 1e-6;
/// Least share of gravity along the only axis. About a flatter one weight brings cloth back, and a
/// couple only shifts where it rests.
constexpr double kLeastSteepness = 0.7;
/// Axes about which cloth has less than this share of its largest inertia do not turn it: those of
/// straight threads.
constexpr double kLeastInertia = 1e-6;
/// Largest turn within a substep [rad]. It lengthens cloth by its square over 2; a larger one comes
/// of cloth that is all but in one point.
constexpr double kLargestTurn = 0.1;

bool stays(const Motion& motion) {
  return motion.kind == Motion::Kind::hold || (!motion.turns() && motion.offset.isZero(0));
}

/// True where springs and bending elements join all vertices.
bool is_one_piece(const ClothModel& model) {
  std::vector<int> parents(static_cast<std::size_t>(model.n_vertices()));
  std::iota(parents.begin(), parents.end(), 0);
  const auto root_of = [&](int vertex) {
    while (parents[static_cast<std::size_t>(vertex)] != vertex) {
      int& parent = parents[static_cast<std::size_t>(vertex)];
      parent = parents[static_cast<std::size_t>(parent)];
      vertex = parent;
    }
    return vertex;
  };
  int n_pieces = model.n_vertices();
  const auto join = [&](VertexId a, VertexId b) {
    const int from = root_of(a.value);
    const int to = root_of(b.value);
    if (from == to) return;
    parents[static_cast<std::size_t>(from)] = to;
    --n_pieces;
  };
  for (const Spring& spring : model.springs)
    if (spring.stiffness > 0) join(spring.a, spring.b);
  for (const BendElement& bend : model.bends) {
    join(bend.vertices[0], bend.vertices[1]);
    join(bend.vertices[1], bend.vertices[2]);
  }
  for (const HangingVertex& hanging : model.hanging)
    for (const VertexId parent : hanging.parents) join(hanging.vertex, parent);
  return n_pieces == 1;
}

}  // namespace

void FreeTurns::refresh(const ClothModel& model, const float* inverse_masses) {
  axes_ = Axes::none;
  const bool pins_stay = std::all_of(model.pins.begin(), model.pins.end(),
                                     [](const Pin& pin) { return stays(pin.motion); });
  if (!pins_stay || !is_one_piece(model)) return;
  is_held_ = !model.pins.empty();
  Axes axes = Axes::all;
  if (is_held_) {
    point_ = model.pins.front().position(0);
    axis_.setZero();
    for (const Pin& pin : model.pins) {
      const Vec3 away = pin.position(0) - point_;
      if (away.squaredNorm() > axis_.squaredNorm()) axis_ = away;
    }
    const double length = axis_.norm();
    if (length > 0) {
      axes = Axes::one;
      axis_ /= length;
      if (std::abs(axis_.dot(model.gravity)) < kLeastSteepness * model.gravity.norm()) return;
      for (const Pin& pin : model.pins)
        if (axis_.cross(pin.position(0) - point_).norm() > kLineTolerance * length) return;
    }
  }
  const auto n_slots = static_cast<std::size_t>(layout_.n_slots);
  masses_.assign(n_slots, 0.0f);
  unconstrained_.assign(3 * n_slots, 0.0f);
  mass_ = 0;
  for (std::size_t slot = 0; slot < n_slots; ++slot)
    if (inverse_masses[slot] > 0) {
      masses_[slot] = 1 / inverse_masses[slot];
      mass_ += masses_[slot];
    }
  if (mass_ > 0) axes_ = axes;
}

std::array<float*, 3> FreeTurns::unconstrained() {
  const auto n_slots = static_cast<std::size_t>(layout_.n_slots);
  float* const first = unconstrained_.data();
  return {first, first + n_slots, first + 2 * n_slots};
}

FreeTurns::Sums FreeTurns::sums(const LaneView& v, const Vec3& centre) const {
  const auto n_slots = static_cast<std::size_t>(layout_.n_slots);
  const float* const first = unconstrained_.data();
  const std::array<const float*, 3> without = {first, first + n_slots, first + 2 * n_slots};
  const auto all = [](double number) { return Float4::all(static_cast<float>(number)); };
  const Vec3Lanes<Float4> at = {all(centre[0]), all(centre[1]), all(centre[2])};
  const Float4 zero = Float4::all(0);
  Vec3Lanes<Float4> torque{zero, zero, zero};
  Vec3Lanes<Float4> moment{zero, zero, zero};
  Vec3Lanes<Float4> squares{zero, zero, zero};
  Vec3Lanes<Float4> mixed{zero, zero, zero};  // yz, zx, xy
  for (int slot = 0; slot < layout_.n_slots; slot += Float4::kLanes) {
    const Float4 m = Float4::load(masses_.data() + slot);
    const Vec3Lanes<Float4> b = load<Float4>(v.begins, slot) - at;
    const Vec3Lanes<Float4> d = load<Float4>(v.moves, slot) - load<Float4>(without, slot);
    const Vec3Lanes<Float4> mb = m * b;
    torque = torque + Vec3Lanes<Float4>{mb.y * d.z - mb.z * d.y, mb.z * d.x - mb.x * d.z,
                                        mb.x * d.y - mb.y * d.x};
    moment = moment + mb;
    squares = squares + Vec3Lanes<Float4>{mb.x * b.x, mb.y * b.y, mb.z * b.z};
    mixed = mixed + Vec3Lanes<Float4>{mb.y * b.z, mb.z * b.x, mb.x * b.y};
  }
  const auto total = [](const Vec3Lanes<Float4>& lanes) {
    return Vec3(sum_of_lanes<double>(lanes.x), sum_of_lanes<double>(lanes.y),
                sum_of_lanes<double>(lanes.z));
  };
  const Vec3 off = total(mixed);
  Mat3 products = total(squares).asDiagonal();
  products(1, 2) = products(2, 1) = off[0];
  products(2, 0) = products(0, 2) = off[1];
  products(0, 1) = products(1, 0) = off[2];
  return {total(torque), total(moment), products};
}

// A turn w moves b by w x b, and has the torque sum of m b x (w x b) = I w, with the inertia
// I = tr(S) 1 - S of S = sum of m b b^T.
Vec3 FreeTurns::turn_against(const Sums& sums) const {
  const Mat3 inertia = sums.products.trace() * Mat3::Identity() - sums.products;
  if (axes_ == Axes::one) {
    const double about_axis = axis_.dot(inertia * axis_);
    if (!(about_axis > kLeastInertia * inertia.trace())) return Vec3::Zero();
    return -axis_.dot(sums.torque) / about_axis * axis_;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
  Vec3 turn = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (axes.eigenvalues()[k] > kLeastInertia * axes.eigenvalues()[2])
      turn -= axes.eigenvectors().col(k).dot(sums.torque) / axes.eigenvalues()[k] *
              axes.eigenvectors().col(k);
  return turn;
}

// Takes the torque about a held point, else about any: the moves of a solve have no momentum where
// nothing is held, so that their torque is the same
// about every point, and a turn about the centre of mass adds none.
void FreeTurns::keep(const LaneView& v, const Vec3& origin) const {
  Vec3 centre = is_held_ ? Vec3(point_ - origin) : Vec3(Vec3::Zero());
  Sums all = sums(v, centre);
  if (!is_held_) {
    centre = all.moment / mass_;
    all.products -= mass_ * centre * centre.transpose();
  }
  const Vec3 turn = turn_against(all);
  if (!(turn.norm() <= kLargestTurn)) return;
  const auto lanes_of = [](const Vec3& vector) {
    const auto all_lanes = [](double number) { return Float4::all(static_cast<float>(number)); };
    return Vec3Lanes<Float4>{all_lanes(vector[0]), all_lanes(vector[1]), all_lanes(vector[2])};
  };
  const Vec3Lanes<Float4> w = lanes_of(turn);
  const Vec3Lanes<Float4> at = lanes_of(centre);
  for (int slot = 0; slot < layout_.n_slots; slot += Float4::kLanes) {
    const Float4 m = Float4::load(masses_.data() + slot);
    const Vec3Lanes<Float4> b = load<Float4>(v.begins, slot) - at;
    const Vec3Lanes<Float4> by = {where_positive(m, w.y * b.z - w.z * b.y),
                                  where_positive(m, w.z * b.x - w.x * b.z),
                                  where_positive(m, w.x * b.y - w.y * b.x)};
    store(load<Float4>(v.moves, slot) + by, v.moves, slot);
  }
}

}  // namespace pleat
