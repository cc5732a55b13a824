#include "core/reference/closed_forms.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/check.h"

namespace pleat {
namespace {

constexpr double kRightAngle = 1.5707963267948966;

// The heavy elastica. With arc length t from the tip in units of L and the angle p from straight
// down, the moment's balance is p'' = (w L^3/B) t sin p, with p' = 0 at the tip and p = pi/2 at the
// clamp. Going from the tip to the clamp p grows, so that shooting is well posed; Taylor series
// of sin p and cos p follow from s' = c p', c' = -s p'.

constexpr int kOrder = 18;
// At this phase per step the next term is below 1e-15: the nearest pole is 1.8 away.
constexpr double kLargestPhase = 0.25;
constexpr int kFewestSteps = 8;

using Series = std::array<double, kOrder + 1>;

double value(const Series& series, double t) {
  double sum = 0;
  for (int k = kOrder; k >= 0; --k) sum = sum * t + series[k];
  return sum;
}

double slope(const Series& series, double t) {
  double sum = 0;
  for (int k = kOrder; k > 0; --k) sum = sum * t + k * series[k];
  return sum;
}

/// Series about the arc length `start`, in units of the strip's length.
struct ElasticaPiece {
  double start = 0;
  Series angle{};   // angle from straight down [rad]
  Series across{};  // distance from the tip
  Series up{};      // height over the tip
};

/// Fills the series from their first terms, two of the angle's and one of each other.
void expand(double load, ElasticaPiece& piece) {
  Series sine{std::sin(piece.angle[0])};
  Series cosine{std::cos(piece.angle[0])};
  for (int k = 0; k < kOrder; ++k) {
    if (k + 2 <= kOrder)
      piece.angle[k + 2] =
          load * (piece.start * sine[k] + (k > 0 ? sine[k - 1] : 0)) / ((k + 1) * (k + 2));
    double sine_sum = 0;
    double cosine_sum = 0;
    for (int j = 0; j <= k; ++j) {
      sine_sum += (j + 1) * piece.angle[j + 1] * cosine[k - j];
      cosine_sum -= (j + 1) * piece.angle[j + 1] * sine[k - j];
    }
    sine[k + 1] = sine_sum / (k + 1);
    cosine[k + 1] = cosine_sum / (k + 1);
    piece.across[k + 1] = sine[k] / (k + 1);
    piece.up[k + 1] = cosine[k] / (k + 1);
  }
}

/// Pieces from the tip to the clamp, or to where the angle passes the right angle.
std::vector<ElasticaPiece> shoot(double load, double tip_angle, int n_steps) {
  const double step = 1.0 / n_steps;
  std::vector<ElasticaPiece> pieces;
  ElasticaPiece next;
  next.angle[0] = tip_angle;
  while (static_cast<int>(pieces.size()) < n_steps && next.angle[0] <= kRightAngle) {
    expand(load, next);
    pieces.push_back(next);
    const ElasticaPiece& last = pieces.back();
    next = {};
    next.start = static_cast<double>(pieces.size()) / n_steps;
    next.angle[0] = value(last.angle, step);
    next.angle[1] = slope(last.angle, step);
    next.across[0] = value(last.across, step);
    next.up[0] = value(last.up, step);
  }
  return pieces;
}

/// The angle at the tip by bisection of its logarithm: as long as p <= pi/2, p at the clamp grows
/// with p at the tip. The bracket comes from p'' <= load t p, whose growth rate p'/p stays below
/// sqrt(load t).
double tip_angle(double load, int n_steps) {
  constexpr int kBisections = 60;
  double high = std::log(kRightAngle);
  double low = high - 2.0 / 3 * std::sqrt(load);
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    const std::vector<ElasticaPiece> pieces = shoot(load, std::exp(middle), n_steps);
    const bool falls_short = static_cast<int>(pieces.size()) == n_steps &&
                             value(pieces.back().angle, 1.0 / n_steps) < kRightAngle;
    (falls_short ? low : high) = middle;
  }
  return std::min(std::exp(low), kRightAngle);
}

// The elastic catenary. The support holds the rope with the force (H, V), sideways and up; at the
// unstretched length s the tension is the vector (H, V - w s), of length T, and the rope's
// direction there is that vector's. The place of the far end is the gradient of a convex function
// of (H, V), so that Newton's method with shorter steps where it must cannot go astray.

/// Sideways and down.
struct EndPlace {
  Eigen::Vector2d place;     // [m]
  Eigen::Matrix2d per_pull;  // [m/N]
};

/// x = H (s/EA + [asinh(V/H) - asinh(q/H)]/w),  z = s (V + q) (1/(2 EA) + 1/(T_V + T_q)),
/// q = V - w s.
Eigen::Vector2d rope_place(const Rope& rope, const Eigen::Vector2d& pull, double s) {
  const double h = pull.x();
  const double v = pull.y();
  const double q = v - rope.weight * s;
  const double turn = std::asinh(v / h) - std::asinh(q / h);
  return {h * (rope.compliance * s + turn / rope.weight),
          s * (v + q) * (rope.compliance / 2 + 1 / (std::hypot(h, v) + std::hypot(h, q)))};
}

EndPlace rope_end(const Rope& rope, const Eigen::Vector2d& pull) {
  const double h = pull.x();
  const double v = pull.y();
  const double q = v - rope.weight * rope.length;
  const double sine_v = v / std::hypot(h, v);
  const double sine_q = q / std::hypot(h, q);
  const double cosine_v = h / std::hypot(h, v);
  const double cosine_q = h / std::hypot(h, q);
  const double turn = std::asinh(v / h) - std::asinh(q / h);
  const double stretch = rope.compliance * rope.length;
  EndPlace end;
  end.place = rope_place(rope, pull, rope.length);
  end.per_pull(0, 0) = stretch + (turn - (sine_v - sine_q)) / rope.weight;
  end.per_pull(0, 1) = (cosine_v - cosine_q) / rope.weight;
  end.per_pull(1, 0) = end.per_pull(0, 1);
  end.per_pull(1, 1) = stretch + (sine_v - sine_q) / rope.weight;
  return end;
}

EndPlace chain_end(std::span<const ChainLink> links, Eigen::Vector2d pull) {
  EndPlace end{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  for (const ChainLink& link : links) {
    const double tension = pull.norm();
    const Eigen::Vector2d direction = pull / tension;
    end.place += link.length * direction + pull / link.stiffness;
    end.per_pull +=
        link.length / tension * (Eigen::Matrix2d::Identity() - direction * direction.transpose()) +
        Eigen::Matrix2d::Identity() / link.stiffness;
    pull.y() -= link.weight;
  }
  return end;
}

/// The pull of a rope that is not very taut, as if it were inextensible and shallow; of a taut one
/// the right order.
Eigen::Vector2d first_pull(double length, double weight, const Eigen::Vector2d& far_support) {
  constexpr double kTautSag = 0.2;
  const double span = far_support.x();
  const double slack = (length * length - far_support.y() * far_support.y()) / (span * span) - 1;
  const double sag = slack > 0 ? std::max(std::sqrt(3 * slack), 1e-3) : kTautSag;
  return {weight * span / (2 * sag), weight / 2 * (length + far_support.y() / std::tanh(sag))};
}

/// The pull at which `end_of` is at the far support.
template <class EndOf>
std::optional<Eigen::Vector2d> solve_pull(const EndOf& end_of, const Eigen::Vector2d& far_support,
                                          double scale, Eigen::Vector2d pull) {
  constexpr int kMostSteps = 200;
  constexpr double kTolerance = 1e-12;      // share of the scale
  constexpr double kSmallestShare = 1e-10;  // share of a Newton step
  EndPlace end = end_of(pull);
  Eigen::Vector2d miss = end.place - far_support;
  for (int i = 0; i < kMostSteps && miss.norm() > kTolerance * scale; ++i) {
    const Eigen::Vector2d step = -(end.per_pull.inverse() * miss);
    double share = 1;
    Eigen::Vector2d tried_miss;
    do {
      end = end_of(pull + share * step);
      tried_miss = end.place - far_support;
      share /= 2;
    } while (!(tried_miss.norm() < miss.norm()) && share > kSmallestShare);
    pull += 2 * share * step;
    miss = tried_miss;
  }
  if (!(miss.norm() <= kTolerance * scale)) return std::nullopt;
  return pull;
}

/// Nodes of the chain held by `pull` at its first support.
Eigen::Matrix2Xd chain_nodes(std::span<const ChainLink> links, Eigen::Vector2d pull) {
  Eigen::Matrix2Xd nodes(2, links.size() + 1);
  nodes.col(0).setZero();
  for (std::size_t i = 0; i < links.size(); ++i) {
    const double stretched = links[i].length / pull.norm() + 1 / links[i].stiffness;
    nodes.col(i + 1) = nodes.col(i) + stretched * pull;
    pull.y() -= links[i].weight;
  }
  return nodes;
}

/// Stretch F of the law N = F K (F^2 - 1)/2 from N/K >= 0: the largest root of F^3 - F = 2 N/K.
double green_stretch(double relative_force) {
  const double cosine = 3 * std::sqrt(3.0) * relative_force;
  const double root =
      cosine <= 1 ? std::cos(std::acos(cosine) / 3) : std::cosh(std::acosh(cosine) / 3);
  return 2 / std::sqrt(3.0) * root;
}

}  // namespace

Eigen::Matrix2Xd heavy_elastica(const Cantilever& strip, std::span<const double> arc_lengths) {
  PLEAT_CHECK(strip.length > 0 && strip.weight >= 0 && strip.rigidity > 0,
              "a strip has a length and a rigidity");
  const double load = strip.load();
  PLEAT_CHECK(load <= kMaxCantileverLoad, "a strip's load is in range");
  const int n_steps = kFewestSteps + static_cast<int>(std::sqrt(load) / kLargestPhase);
  const std::vector<ElasticaPiece> pieces = shoot(load, tip_angle(load, n_steps), n_steps);
  const auto place = [&](double from_tip) {
    const auto at = std::min(static_cast<std::size_t>(from_tip * n_steps), pieces.size() - 1);
    const double t = from_tip - pieces[at].start;
    return Eigen::Vector2d(value(pieces[at].across, t), value(pieces[at].up, t));
  };
  const Eigen::Vector2d clamp = place(1);
  Eigen::Matrix2Xd shape(2, arc_lengths.size());
  for (std::size_t i = 0; i < arc_lengths.size(); ++i) {
    const double share = arc_lengths[i] / strip.length;
    PLEAT_CHECK(share >= 0 && share <= 1, "an arc length lies on the strip");
    shape.col(i) = strip.length * (clamp - place(1 - share));
  }
  return shape;
}

std::optional<Eigen::Matrix2Xd> catenary(const Rope& rope, const Eigen::Vector2d& far_support,
                                         std::span<const double> arc_lengths) {
  PLEAT_CHECK(rope.length > 0 && rope.weight > 0 && rope.compliance >= 0,
              "a rope has a length and a weight");
  PLEAT_CHECK(far_support.x() > 0, "the far support is not above or below the first");
  PLEAT_CHECK(rope.compliance > 0 || rope.length > far_support.norm(),
              "an inextensible rope reaches its far support");
  const auto end_of = [&rope](const Eigen::Vector2d& pull) { return rope_end(rope, pull); };
  const double scale = std::max(rope.length, far_support.norm());
  const std::optional<Eigen::Vector2d> pull =
      solve_pull(end_of, far_support, scale, first_pull(rope.length, rope.weight, far_support));
  if (!pull) return std::nullopt;
  Eigen::Matrix2Xd shape(2, arc_lengths.size());
  for (std::size_t i = 0; i < arc_lengths.size(); ++i) {
    PLEAT_CHECK(arc_lengths[i] >= 0 && arc_lengths[i] <= rope.length,
                "an arc length lies on the rope");
    shape.col(i) = rope_place(rope, *pull, arc_lengths[i]);
  }
  return shape;
}

std::optional<Eigen::Matrix2Xd> chain_between_supports(std::span<const ChainLink> links,
                                                       const Eigen::Vector2d& far_support) {
  PLEAT_CHECK(far_support.x() > 0, "the far support is not above or below the first");
  double length = 0;
  double weight = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    length += links[i].length;
    if (i + 1 < links.size()) weight += links[i].weight;
  }
  PLEAT_CHECK(weight > 0, "a chain has a weight between its supports");
  const double scale = std::max(length, far_support.norm());
  const auto end_of = [links](const Eigen::Vector2d& pull) { return chain_end(links, pull); };
  const std::optional<Eigen::Vector2d> pull =
      solve_pull(end_of, far_support, scale, first_pull(scale, weight / scale, far_support));
  if (!pull) return std::nullopt;
  return chain_nodes(links, *pull);
}

Eigen::VectorXd hanging_chain(std::span<const ChainLink> links) {
  double weight = 0;
  for (const ChainLink& link : links) weight += link.weight;
  Eigen::VectorXd depths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(links.size()) + 1);
  for (std::size_t i = 0; i < links.size(); ++i) {
    depths[i + 1] = depths[i] + links[i].length + weight / links[i].stiffness;
    weight -= links[i].weight;
  }
  return depths;
}

// Hooke: F = 1 + w (L - u)/K, integrated. Green: with F_0 and F_u from the cubic, the integral of
// F du over du = -K/(2 w) (3 F^2 - 1) dF is K/(2 w) [3/4 F^4 - F^2/2], and
// (F_0 - F_u)(F_0^2 + F_0 F_u + F_u^2 - 1) = 2 w u/K divides the small difference out.
double hanging_depth(const HangingStrip& strip, double rest_depth) {
  PLEAT_CHECK(strip.length > 0 && strip.weight >= 0 && strip.stiffness > 0,
              "a strip has a length and a stiffness");
  PLEAT_CHECK(rest_depth >= 0 && rest_depth <= strip.length, "a rest depth lies on the strip");
  const double u = rest_depth;
  const double load = strip.weight / strip.stiffness;
  if (strip.law == StretchLaw::hooke) return u + load * u * (strip.length - u / 2);
  const double f0 = green_stretch(load * strip.length);
  const double fu = green_stretch(load * (strip.length - u));
  return u * (f0 + fu) * (0.75 * (f0 * f0 + fu * fu) - 0.5) / (f0 * f0 + f0 * fu + fu * fu - 1);
}

}  // namespace pleat
