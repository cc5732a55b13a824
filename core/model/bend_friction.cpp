#include "core/model/bend_friction.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kYield = kPreSlidingCurvature;  // e_y

Vec3 curvature_vector(const BendElement& bend, const PositionsView& columns) {
  return bend.weights[0] * columns.col(bend.vertices[0]) +
         bend.weights[1] * columns.col(bend.vertices[1]) +
         bend.weights[2] * columns.col(bend.vertices[2]);
}

/// The potential per stiffness of a strain, and its slope.
double huber(double strain, double knee) {
  const double size = std::abs(strain);
  return size <= knee ? 0.5 * strain * strain : knee * (size - 0.5 * knee);
}

double limited(double strain, double bound) { return std::clamp(strain, -bound, bound); }

/// FNV-1a over the bits of three places.
std::uint64_t place_of(const BendElement& bend, const Positions& rest_positions) {
  std::uint64_t hash = 14695981039346656037U;
  for (const VertexId v : bend.vertices) {
    for (const double coordinate : Vec3(rest_positions.col(v))) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = (hash ^ bits) * 1099511628211U;
      hash ^= hash >> 32;
    }
  }
  return hash;
}

}  // namespace

BendFriction::BendFriction(std::vector<BendElement> bends, double hysteresis,
                           std::vector<Triangle> surface, const Positions& rest_positions)
    : surface_(std::move(surface)),
      rigidity_(hysteresis / 2 / kYield),
      knee_(kYield),
      normals_(3, rest_positions.cols()) {
  PLEAT_CHECK(hysteresis > 0, "a moment loop has a width");
  elements_.reserve(bends.size());
  for (BendElement& bend : bends) {
    bend.stiffness *= rigidity_;
    Element element{bend};
    element.place = place_of(bend, rest_positions);
    elements_.push_back(element);
  }
  restart(rest_positions);
}

/// Moments go on to the bit when normals turn: e is kept, and kappa looked up anew.
void BendFriction::find_curvatures(const Positions& positions, const Positions& places_of_normals) {
  normals_.setZero();
  for (const Triangle& t : surface_) {
    const auto& x = places_of_normals;
    const Vec3 edge = x.col(t[1]) - x.col(t[0]);
    const Vec3 doubled_area = edge.cross(x.col(t[2]) - x.col(t[0]));
    for (const VertexId v : t) normals_.col(v) += doubled_area;
  }
  for (Element& element : elements_) {
    const Vec3 normal = normals_.col(element.bend.vertices[1]);
    const double length = normal.norm();
    const bool has_normal = length > 0 && std::isfinite(length);
    element.normal = has_normal ? Vec3(normal / length) : Vec3(Vec3::Zero());
    element.curvature = element.normal.dot(curvature_vector(element.bend, positions));
  }
}

void BendFriction::restart(const Positions& positions) {
  for (Element& element : elements_) element.strain = 0;
  dissipated_ = 0;
  find_curvatures(positions, positions);
}

void BendFriction::take_moments(const BendFriction& other, const Positions& positions) {
  std::unordered_map<std::uint64_t, std::size_t> known;  // only looked up, never walked
  for (std::size_t i = 0; i < other.elements_.size(); ++i) known[other.elements_[i].place] = i;
  const double share = other.rigidity_ / rigidity_;
  for (Element& element : elements_) {
    const auto found = known.find(element.place);
    element.strain =
        found == known.end() ? 0 : limited(other.elements_[found->second].strain * share, kYield);
  }
  dissipated_ = other.dissipated_;
  find_curvatures(positions, positions);
}

void BendFriction::keep(Kept& kept) const {
  kept.strains.clear();
  for (const Element& element : elements_) kept.strains.push_back(element.strain);
  kept.dissipated = dissipated_;
}

void BendFriction::restore(const Kept& kept, const Positions& positions) {
  PLEAT_CHECK(kept.strains.size() == elements_.size(), "a strain for each element");
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    elements_[i].strain = kept.strains[i];
    elements_[i].share = 1;
  }
  dissipated_ = kept.dissipated;
  knee_ = kYield;
  reach_ = 1;
  find_curvatures(positions, positions);
}

// A normal that stays in space sees cloth that turns by an angle a lose kappa a^2/2 when it is that
// of the start, and nothing, up to a^4/24, when it is that of the middle.
void BendFriction::begin_substep(const State& state, double h, Knee knee) {
  middle_ = state.positions + h / 2 * state.velocities;
  find_curvatures(state.positions, middle_);
  reach_ = knee == Knee::in_middle ? 0.5 : 1;
  if (knee != Knee::foreseen) return;
  knee_ = std::numeric_limits<double>::infinity();
  for (Element& element : elements_) {
    const double rate = element.normal.dot(curvature_vector(element.bend, state.velocities));
    const double size = std::abs(element.strain + h * rate);
    element.share = size > kYield ? kYield / size : 1;
  }
}

// Over a change d of curvature the moment m that the substep took does the work m d: with the new
// strain squared at most e^2 + 2 m d no more is stored than that. With m = c s, s = e + d, of a
// secant c <= 1 this bound is (e - c s)^2 + (2 c - c^2) s^2, at least (c s)^2. Lost is the rest of
// what the law itself takes along d.
void BendFriction::end_substep(const Positions& positions) {
  for (Element& element : elements_) {
    const double now = element.normal.dot(curvature_vector(element.bend, positions));
    const double e = element.strain;
    const double d = now - element.curvature;
    const double m = element.share * limited(e + reach_ * d, knee_);
    const double storable = std::sqrt(std::max(0.0, e * e + 2 * m * d));
    element.strain = limited(e + d, std::min(kYield, storable));
    element.curvature = now;
    element.share = 1;
    dissipated_ +=
        element.bend.stiffness * (huber(e + d, kYield) - 0.5 * element.strain * element.strain);
  }
  knee_ = kYield;
  reach_ = 1;
}

/// The strain at these places, without slip.
double BendFriction::bent(const Element& element, const PositionsView& positions) const {
  return element.strain +
         (element.normal.dot(curvature_vector(element.bend, positions)) - element.curvature);
}

double BendFriction::energy(const PositionsView& positions) const {
  double sum = 0;
  for (const Element& element : elements_)
    sum += element.share * element.bend.stiffness * huber(bent(element, positions), knee_);
  return sum;
}

void BendFriction::add_forces(const PositionsView& positions, PositionsRef forces) const {
  for (const Element& element : elements_) {
    const BendElement& bend = element.bend;
    const Vec3 moment =
        element.share * bend.stiffness * limited(bent(element, positions), knee_) * element.normal;
    for (std::size_t k = 0; k < 3; ++k) forces.col(bend.vertices[k]) -= bend.weights[k] * moment;
  }
}

double BendFriction::tangent(const Element& element, const PositionsView& positions) const {
  return std::abs(bent(element, positions)) <= knee_ ? element.share * element.bend.stiffness : 0;
}

std::size_t BendFriction::bytes() const {
  return elements_.size() * sizeof(Element) + surface_.size() * sizeof(Triangle) +
         static_cast<std::size_t>(normals_.size() + middle_.size()) * sizeof(double);
}

}  // namespace pleat
