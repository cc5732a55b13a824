#include "core/body/garment_patterns.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/check.h"
#include "core/base/formatted.h"
#include "core/body/body_section.h"

namespace pleat {
namespace {

constexpr double kTwoPi = 6.283185307179586;

constexpr double kWaistHeight = 0.984;  // [m], where the body is narrowest
constexpr int kDirections = 360;        // an outline's; its polygon is 4e-5 of its radius larger

/// Air of 5 mm over the skin and twice what contact keeps quads of 12 mm off a shank of 59 mm [m].
constexpr double kGap = 0.0057;

/// How far the garment's crotch is below the body's, and its fork above the body's [m]: the line
/// between the legs has to pass under the hips and between the thighs.
constexpr double kCrotchDrop = 0.02;
constexpr double kForkRise = 0.05;

/// How much longer than wide quads of trousers are: 20 columns, refined twice, then have the 9400
/// vertices of the published ones.
constexpr double kTrouserAspect = 1.13;

using Ring = std::vector<VertexId>;

/// Throws InputError unless low <= value <= high.
void require(const char* measure, double value, double low, double high, const char* reason) {
  if (value >= low && value <= high) return;
  throw InputError(std::string("/") + measure,
                   formatted("expected %.3f to %.3f, %s, got %g", low, high, reason, value));
}

double length_of(const std::vector<Vec3>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// The vertices and quads from which a garment's patch grows.
struct Pattern {
  std::vector<Vec3> places;
  std::vector<Eigen::Vector2d> coordinates;
  std::vector<std::array<VertexId, 4>> quads;

  VertexId add(const Vec3& place, double u, double v) {
    places.push_back(place);
    coordinates.emplace_back(u, v);
    return VertexId(static_cast<std::int64_t>(places.size()) - 1);
  }
};

double girth_of(const Pattern& pattern, const Ring& ring) {
  double length = (pattern.places[ring.front()] - pattern.places[ring.back()]).norm();
  for (std::size_t i = 1; i < ring.size(); ++i)
    length += (pattern.places[ring[i]] - pattern.places[ring[i - 1]]).norm();
  return length;
}

/// u is that of the ring above, if there is one, and the mean way down from there: a ring is a row
/// of the cloth's grid. v begins at `v_begin`.
Ring add_ring(Pattern& pattern, const std::vector<Vec3>& places, const Ring& above,
              double v_begin) {
  double u = 0;
  for (std::size_t i = 0; i < above.size(); ++i)
    u += (pattern.coordinates[above[i]].x() + (places[i] - pattern.places[above[i]]).norm()) /
         static_cast<double>(above.size());
  Ring ring;
  double v = v_begin;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) v += (places[i] - places[i - 1]).norm();
    ring.push_back(pattern.add(places[i], u, v));
  }
  return ring;
}

void join(Pattern& pattern, const Ring& above, const Ring& below) {
  for (std::size_t i = 0; i < above.size(); ++i) {
    const std::size_t next = (i + 1) % above.size();
    pattern.quads.push_back({above[i], below[i], below[next], above[next]});
  }
}

VertexGroup group(const char* name, Ring ring) {
  std::sort(ring.begin(), ring.end());
  return {name, std::move(ring)};
}

Garment garment(const Pattern& pattern, std::vector<VertexGroup> groups) {
  const auto n = static_cast<Eigen::Index>(pattern.places.size());
  Garment result{{Positions(3, n), RestCoordinates(2, n), pattern.quads}, std::move(groups)};
  for (Eigen::Index i = 0; i < n; ++i) {
    result.patch.rest_positions.col(i) = pattern.places[static_cast<std::size_t>(i)];
    result.patch.rest_coordinates.col(i) = pattern.coordinates[static_cast<std::size_t>(i)];
  }
  return result;
}

/// Shares of a tube's length at which its rows end, which are `aspect` times as high as their
/// columns are wide there. The girth goes linearly from `girth_begin` to `girth_end`, so rows grow
/// in geometric progression.
std::vector<double> row_ends(int columns, double girth_begin, double girth_end, double length,
                             double aspect) {
  const double growth = girth_end / girth_begin;
  const bool is_straight = std::abs(growth - 1) < 1e-6;  // nearer to 1, rounding spoils the mean
  const double mean = is_straight ? girth_begin : (girth_end - girth_begin) / std::log(growth);
  const int rows = std::max(1, static_cast<int>(std::lround(columns * length / (mean * aspect))));
  std::vector<double> ends;
  for (int r = 1; r <= rows; ++r) {
    const double share = static_cast<double>(r) / rows;
    ends.push_back(is_straight ? share : (std::pow(growth, share) - 1) / (growth - 1));
  }
  return ends;
}

/// The body that a garment is cut around.
struct Fitting {
  std::vector<BodyPart> body;
  Outline waist;
  double waist_girth = 0;  // [m]
  double hip_girth = 0;    // the largest between waist and crotch [m]
  double crotch = 0;       // height of the hips' underside [m]

  explicit Fitting(BodyBuild build) : body(below_waist(mannequin(build))) {
    waist = outline(body, kWaistHeight, kDirections);
    waist_girth = girth(waist);
    crotch = kWaistHeight;
    for (const BodyPart& part : body)
      if (part.bone == Bone::pelvis)
        crotch = std::min(crotch, part.shape.centre_a.y() - part.shape.radius_a);
    for (double height = kWaistHeight; height > crotch; height -= 0.01)
      hip_girth = std::max(hip_girth, girth(outline(body, height, kDirections)));
  }
};

void check_waist(const Fitting& fitting, double ease, int columns) {
  PLEAT_CHECK(columns >= 8 && columns % 2 == 0, "an even number of columns, at least 8");
  require("waist_ease_m", ease, 0, fitting.hip_girth - fitting.waist_girth,
          "so that the waist goes round the body and does not fall over the hips");
}

/// Distance of a quad from a body [m], the least at its corners and middles.
double quad_clearance(const Pattern& pattern, std::size_t quad, const std::vector<BodyPart>& body) {
  const auto corner = [&](std::size_t k) { return pattern.places[pattern.quads[quad][k]]; };
  double least = clearance(body, (corner(0) + corner(1) + corner(2) + corner(3)) / 4);
  for (std::size_t k = 0; k < 4; ++k) {
    least = std::min(least, clearance(body, corner(k)));
    least = std::min(least, clearance(body, (corner(k) + corner((k + 1) % 4)) / 2));
  }
  return least;
}

/// Refuses a measure when any quad from `begin` on is nearer to the body than `gap` [m].
void require_clear(const Pattern& pattern, std::size_t begin, const Fitting& fitting, double gap,
                   const char* measure, double value) {
  for (std::size_t q = begin; q < pattern.quads.size(); ++q) {
    const double distance = quad_clearance(pattern, q, fitting.body);
    if (distance >= gap) continue;
    throw InputError(
        std::string("/") + measure,
        formatted("expected a garment that stays %.1f mm off the body, got one at %.1f mm with %g",
                  1000 * gap, 1000 * distance, value));
  }
}

/// Half an ellipse that hangs between two points of equal height.
std::vector<Vec3> hanging_arc(const Vec3& front, const Vec3& back, double bottom) {
  constexpr int kPieces = 200;  // 1e-5 of its length too short
  const Vec3 middle = (front + back) / 2;
  std::vector<Vec3> arc;
  for (int i = 0; i <= kPieces; ++i) {
    const double a = kTwoPi / 2 * i / kPieces;
    arc.emplace_back(middle + std::cos(a) * (front - middle) -
                     Vec3(0, std::sin(a) * (middle.y() - bottom), 0));
  }
  return arc;
}

/// The tube around the hips, and the line between the legs from the fork's front to its back.
struct Hips {
  Ring waist;
  Ring fork;
  Ring line;  // open: its ends are the fork's
};

Ring line_between_legs(Pattern& pattern, const Ring& fork, double bottom) {
  const VertexId front = fork.front();
  const VertexId back = fork[fork.size() / 2];
  const std::vector<Vec3> arc = hanging_arc(pattern.places[front], pattern.places[back], bottom);
  const double length = length_of(arc);
  const double girth = girth_of(pattern, fork);
  const double edge = girth / static_cast<double>(fork.size());
  const int n_edges = std::max(2, static_cast<int>(std::lround(length / edge)));
  const std::vector<Vec3> points = evenly_spaced(arc, n_edges);
  Ring line;
  for (std::size_t i = 1; i < points.size(); ++i) {
    // v as round the left leg, which begins where the fork ends and comes here from the back.
    const double v = 1.5 * girth + length * (1 - static_cast<double>(i) / n_edges);
    line.push_back(pattern.add(points[i], pattern.coordinates[front].x(), v));
  }
  return line;
}

Hips add_hips(Pattern& pattern, const Fitting& fitting, const TrouserMeasures& measures) {
  Hips hips;
  hips.waist = add_ring(
      pattern, ring(fitting.waist, measures.waist_ease / kTwoPi, kWaistHeight, measures.columns),
      {}, 0);
  hips.fork = hips.waist;
  const double drop = kWaistHeight - fitting.crotch - kForkRise;
  for (const double share :
       row_ends(measures.columns, fitting.waist_girth, fitting.hip_girth, drop, kTrouserAspect)) {
    const double height = kWaistHeight - share * drop;
    const Outline body = outline(fitting.body, height, kDirections);
    const Ring below = add_ring(
        pattern, ring(body, measures.hip_ease / kTwoPi, height, measures.columns), hips.fork, 0);
    join(pattern, hips.fork, below);
    hips.fork = below;
  }
  hips.line = line_between_legs(pattern, hips.fork, fitting.crotch - kCrotchDrop);
  return hips;
}

/// Round the left leg: outside from front to back, then along the line between the legs.
Ring top_of_left_leg(const Hips& hips) {
  Ring leg(hips.fork.begin(),
           hips.fork.begin() + static_cast<std::ptrdiff_t>(hips.fork.size() / 2 + 1));
  leg.insert(leg.end(), hips.line.rbegin(), hips.line.rend());
  return leg;
}

/// Round the right leg: outside from back to front, then along the line between the legs.
Ring top_of_right_leg(const Hips& hips) {
  Ring leg(hips.fork.begin() + static_cast<std::ptrdiff_t>(hips.fork.size() / 2), hips.fork.end());
  leg.push_back(hips.fork.front());
  leg.insert(leg.end(), hips.line.begin(), hips.line.end());
  return leg;
}

/// A circle of n points around an ankle; `outermost` is the index, whole or half, of the one
/// farthest to its side.
std::vector<Vec3> hem_ring(const Vec3& ankle, double girth, double height, std::size_t n,
                           double outermost) {
  const double radius = girth / kTwoPi;
  const double outward = ankle.z() < 0 ? kTwoPi / 4 : -kTwoPi / 4;
  std::vector<Vec3> ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double a =
        outward + kTwoPi * (static_cast<double>(i) - outermost) / static_cast<double>(n);
    ring.emplace_back(ankle.x() + radius * std::cos(a), height, ankle.z() - radius * std::sin(a));
  }
  return ring;
}

/// One leg's rings below its uppermost one, straight down to the hem, which is returned.
Ring add_leg(Pattern& pattern, const Ring& top, Bone foot, const TrouserMeasures& measures,
             double hem_height, double v_begin) {
  const std::vector<Vec3> hem = hem_ring(standing_joint(foot), measures.ankle_opening, hem_height,
                                         top.size(), measures.columns / 4.0);
  double length = 0;  // mean of the columns
  for (std::size_t i = 0; i < top.size(); ++i)
    length += (hem[i] - pattern.places[top[i]]).norm() / static_cast<double>(top.size());
  Ring above = top;
  for (const double share : row_ends(static_cast<int>(top.size()), girth_of(pattern, top),
                                     measures.ankle_opening, length, kTrouserAspect)) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < top.size(); ++i)
      places.emplace_back(pattern.places[top[i]] + share * (hem[i] - pattern.places[top[i]]));
    const Ring below = add_ring(pattern, places, above, v_begin);
    join(pattern, above, below);
    above = below;
  }
  return above;
}

void check_trousers(const TrouserMeasures& measures, const Fitting& fitting) {
  check_waist(fitting, measures.waist_ease, measures.columns);
  constexpr double kFootHeight = 0.08;  // [m]
  require("inseam_m", measures.inseam, 0.1, fitting.crotch - kCrotchDrop - kFootHeight,
          "so that the legs end above the feet");
  require("ankle_opening_m", measures.ankle_opening, 0.1,
          kTwoPi * standing_joint(Bone::foot_right).z(), "so that two have room side by side");
}

}  // namespace

Garment skirt(const SkirtMeasures& measures, BodyBuild build) {
  const Fitting fitting(build);
  check_waist(fitting, measures.waist_ease, measures.columns);
  require("length_m", measures.length, 0.1, kWaistHeight, "so that the hem is above the floor");
  const double waist_girth = fitting.waist_girth + measures.waist_ease;
  constexpr double kMostFlare = 0.95;  // outward per length; a full circle, 1, lies flat
  require("hem_girth_m", measures.hem_girth, waist_girth,
          waist_girth + kMostFlare * kTwoPi * measures.length,
          "so that it widens downward and does not lie flat");
  const double flare = (measures.hem_girth - waist_girth) / (kTwoPi * measures.length);
  const double drop = measures.length * std::sqrt(1 - flare * flare);
  const auto places = [&](double share) {
    const double offset = measures.waist_ease / kTwoPi + share * flare * measures.length;
    return ring(fitting.waist, offset, kWaistHeight - share * drop, measures.columns);
  };
  Pattern pattern;
  const Ring waist = add_ring(pattern, places(0), {}, 0);
  Ring hem = waist;
  for (const double share :
       row_ends(measures.columns, waist_girth, measures.hem_girth, measures.length, 1)) {
    const Ring below = add_ring(pattern, places(share), hem, 0);
    join(pattern, hem, below);
    hem = below;
  }
  require_clear(pattern, waist.size(), fitting, kGap, "hem_girth_m", measures.hem_girth);
  require_clear(pattern, 0, fitting, 0, "waist_ease_m", measures.waist_ease);
  return garment(pattern, {group("waist", waist), group("hem", hem)});
}

Garment trousers(const TrouserMeasures& measures, BodyBuild build) {
  const Fitting fitting(build);
  check_trousers(measures, fitting);
  Pattern pattern;
  const Hips hips = add_hips(pattern, fitting, measures);
  const std::size_t n_hip_quads = pattern.quads.size();
  require_clear(pattern, hips.waist.size(), fitting, kGap, "hip_ease_m", measures.hip_ease);
  require_clear(pattern, 0, fitting, 0, "waist_ease_m", measures.waist_ease);
  const Ring top_left = top_of_left_leg(hips);
  const Ring top_right = top_of_right_leg(hips);
  const double v_left = girth_of(pattern, hips.fork);
  const double v_right = v_left + girth_of(pattern, top_left);
  const double hem_height = fitting.crotch - kCrotchDrop - measures.inseam;
  const Ring hem_left = add_leg(pattern, top_left, Bone::foot_left, measures, hem_height, v_left);
  const Ring hem_right =
      add_leg(pattern, top_right, Bone::foot_right, measures, hem_height, v_right);
  require_clear(pattern, n_hip_quads, fitting, kGap, "ankle_opening_m", measures.ankle_opening);
  return garment(pattern, {group("waist", hips.waist), group("hem_left", hem_left),
                           group("hem_right", hem_right)});
}

}  // namespace pleat
