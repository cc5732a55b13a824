#include "core/hard_cases/case_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/contact/body_depth.h"
#include "core/error/self_crossings.h"
#include "core/model/elasticity.h"
#include "core/model/momentum.h"
#include "core/model/stretch.h"
#include "core/run/run_watch.h"

namespace pleat {
namespace {

double largest_distance(const Positions& a, const Positions& b) {
  return (a - b).colwise().norm().maxCoeff();
}

/// A measure that is the largest of what it saw.
class LargestMeasure : public CaseMeasure {
 public:
  void update(const Simulation& simulation, const SolveReport&) override {
    const double seen = measure(simulation);
    if (!(seen <= largest_)) largest_ = seen;  // NaN too, and it stays
  }
  double value() const override { return largest_; }

 protected:
  virtual double measure(const Simulation& simulation) = 0;

 private:
  double largest_ = 0;
};

/// The largest of a plain function of the cloth's state.
class LargestOf final : public LargestMeasure {
 public:
  explicit LargestOf(std::function<double(const Simulation&)> measure)
      : measure_(std::move(measure)) {}

 private:
  double measure(const Simulation& simulation) override { return measure_(simulation); }

  std::function<double(const Simulation&)> measure_;
};

/// Value of a function of the state when it was last seen.
class LastOf final : public CaseMeasure {
 public:
  explicit LastOf(double (*measure)(const Simulation&)) : measure_(measure) {}
  void update(const Simulation& simulation, const SolveReport&) override {
    last_ = measure_(simulation);
  }
  double value() const override { return last_; }

 private:
  double (*measure_)(const Simulation&);
  double last_ = 0;
};

/// How many warnings of some kinds a run raises.
class Warnings final : public CaseMeasure {
 public:
  using Selection = bool (*)(const RunWarning&);

  Warnings(const Simulation& start, Selection counts) : watch_(start), counts_(counts) {}
  void update(const Simulation& simulation, const SolveReport& step) override {
    if (simulation.n_steps() > 0) watch_.check(simulation, step);
  }
  double value() const override {
    return static_cast<double>(
        std::count_if(watch_.warnings().begin(), watch_.warnings().end(), counts_));
  }
  std::string detail() const override {
    std::string text;
    for (const RunWarning& warning : watch_.warnings())
      if (counts_(warning)) text += (text.empty() ? "" : "; ") + sentence(warning);
    return text;
  }

 private:
  RunWatch watch_;
  Selection counts_;
};

CaseCheck no_warnings(const char* what, Warnings::Selection counts) {
  return {what, 0, [counts](const Simulation& start, double) {
            return std::make_unique<Warnings>(start, counts);
          }};
}

class Unrest final : public LargestMeasure {
 public:
  Unrest(double start, double step) : start_(start - step / 2) {}

 private:
  double measure(const Simulation& simulation) override {
    if (simulation.time() < start_) return 0;
    const Positions& positions = simulation.state().positions;
    if (first_.cols() == 0) first_ = positions;
    return largest_distance(positions, first_);
  }

  double start_;     // [s]
  Positions first_;  // positions at that time [m]
};

class EnergyGrowth final : public CaseMeasure {
 public:
  explicit EnergyGrowth(double start) : start_(start) {}
  void update(const Simulation& simulation, const SolveReport&) override {
    const double energy = total_energy(simulation.model(), simulation.state());
    if (simulation.n_steps() == 0) first_ = least_ = energy;
    least_ = std::min(least_, energy);
    if (simulation.time() < start_) return;
    recent_least_ = std::min(recent_least_, energy);
    growth_ = std::max(growth_, energy - recent_least_);
  }
  double value() const override { return growth_ > 0 ? growth_ / (first_ - least_) : 0; }

 private:
  double start_;      // time from which it counts [s]
  double first_ = 0;  // [J]
  double least_ = 0;
  double recent_least_ = std::numeric_limits<double>::infinity();
  double growth_ = 0;
};

/// Vertex at rest at the mirror image of each one.
std::vector<Eigen::Index> mirror_images(const Positions& rest, double diagonal) {
  constexpr double kTolerance = 1e-9;  // share of the diagonal
  std::vector<Eigen::Index> images;
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    const Vec3 image(-rest(0, i), rest(1, i), rest(2, i));
    Eigen::Index nearest = 0;
    const double distance = (rest.colwise() - image).colwise().norm().minCoeff(&nearest);
    PLEAT_CHECK(distance <= kTolerance * diagonal, "symmetric cloth has each vertex's image");
    images.push_back(nearest);
  }
  return images;
}

class Asymmetry final : public LargestMeasure {
 public:
  explicit Asymmetry(const Simulation& start)
      : diagonal_(start.scene().cloth->rest_diagonal()),
        images_(mirror_images(start.rest_positions(), diagonal_)) {}

 private:
  double measure(const Simulation& simulation) override {
    const Positions& x = simulation.state().positions;
    double largest = 0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Vec3 image = x.col(images_[static_cast<std::size_t>(i)]);
      largest = std::max(largest, (x.col(i) - Vec3(-image.x(), image.y(), image.z())).norm());
    }
    return largest / diagonal_;
  }

  double diagonal_;  // [m]
  std::vector<Eigen::Index> images_;
};

class VelocityJump final : public LargestMeasure {
 private:
  double measure(const Simulation& simulation) override {
    const Positions& now = simulation.state().velocities;
    const Eigen::Index shared = std::min(now.cols(), last_.cols());
    const double jump =
        shared == 0 ? 0
                    : (now.leftCols(shared) - last_.leftCols(shared)).colwise().norm().maxCoeff();
    last_ = now;
    return jump;
  }

  Positions last_;  // [m/s]
};

double largest_stretch(const Simulation& simulation) {
  return stretch(simulation.gauge(), simulation.state().positions).largest;
}

double depth_in_solids(const Simulation& simulation) {
  const ClothModel& model = simulation.model();
  const Positions& now = simulation.state().positions;
  double depth = model.contact ? model.contact->penetration(now, simulation.time()).depth : 0;
  if (model.meets_bodies())
    depth = std::max(depth, BodyDepth(model.self_contact->bodies).at(now, simulation.time()).depth);
  return depth;
}

/// Largest |now - first| / scale of a vector.
std::unique_ptr<CaseMeasure> largest_change(const std::function<Vec3(const Simulation&)>& vector,
                                            const Simulation& start, double scale) {
  return std::make_unique<LargestOf>(
      [vector, first = vector(start), scale](const Simulation& simulation) {
        return (vector(simulation) - first).norm() / scale;
      });
}

/// Places of the vertices relative to that of the first at rest, in rest diagonals.
Positions in_own_size(const Simulation& simulation) {
  const Vec3 origin = simulation.rest_positions().col(0);
  return (simulation.state().positions.colwise() - origin) /
         simulation.scene().cloth->rest_diagonal();
}

double sag(const Simulation& simulation) {
  const auto heights = simulation.state().positions.row(1);
  const auto rest = simulation.rest_positions().row(1);
  return (heights.maxCoeff() - heights.minCoeff()) - (rest.maxCoeff() - rest.minCoeff());
}

}  // namespace

CaseCheck no_nonsense() {
  return no_warnings("signs of nonsense",
                     [](const RunWarning& warning) { return warning.is_nonsense(); });
}

CaseCheck speeds_explained() {
  return no_warnings("speeds that nothing explains", [](const RunWarning& warning) {
    return warning.kind == RunWarning::Kind::speed;
  });
}

CaseCheck stays_within(double distance) {
  return {"distance from the origin [m]", distance, [](const Simulation&, double) {
            return std::make_unique<LargestOf>([](const Simulation& simulation) {
              return simulation.state().positions.colwise().norm().maxCoeff();
            });
          }};
}

CaseCheck strain_at_most(double strain) {
  return {"largest strain", strain,
          [](const Simulation&, double) { return std::make_unique<LargestOf>(largest_stretch); }};
}

CaseCheck end_strain_at_most(double strain) {
  return {"largest strain at the end", strain,
          [](const Simulation&, double) { return std::make_unique<LastOf>(largest_stretch); },
          true};
}

CaseCheck rests(double window, double distance) {
  return {"move since " + std::to_string(std::lround(window)) + " s before the end [m]", distance,
          [window](const Simulation& start, double duration) {
            return std::make_unique<Unrest>(duration - window, start.scene().method.step);
          },
          true};
}

CaseCheck energy_grows_at_most(double share) {
  return {"energy regained in the second half, of what was lost", share,
          [](const Simulation&, double duration) {
            return std::make_unique<EnergyGrowth>(duration / 2);
          }};
}

CaseCheck stays_symmetric(double share) {
  return {"asymmetry, of the diagonal", share,
          [](const Simulation& start, double) { return std::make_unique<Asymmetry>(start); }};
}

CaseCheck momentum_kept(double share) {
  return {"change of the momentum", share, [](const Simulation& start, double) {
            const double speed = start.state().velocities.colwise().norm().maxCoeff();
            return largest_change(
                [](const Simulation& s) { return momentum(s.model(), s.state()); }, start,
                speed * start.model().masses.sum());
          }};
}

CaseCheck angular_momentum_kept(double share) {
  return {"change of the angular momentum", share, [](const Simulation& start, double) {
            return largest_change(
                [](const Simulation& s) { return angular_momentum(s.model(), s.state()); }, start,
                angular_momentum(start.model(), start.state()).norm());
          }};
}

CaseCheck tears() {
  return {"left whole", 0,
          [](const Simulation&, double) {
            return std::make_unique<LastOf>([](const Simulation& simulation) {
              return simulation.tear_origins().empty() ? 1.0 : 0.0;
            });
          },
          true};
}

CaseCheck mass_kept(double share) {
  return {"change of the mass", share, [](const Simulation& start, double) {
            return std::make_unique<LargestOf>(
                [first = start.model().masses.sum()](const Simulation& simulation) {
                  return std::abs(simulation.model().masses.sum() / first - 1);
                });
          }};
}

CaseCheck no_crossings() {
  return {"edges of the cloth that go through it", 0, [](const Simulation& start, double) {
            const auto crossings = std::make_shared<SelfCrossings>(
                start.triangles(), start.rest_positions(), start.model().hanging);
            return std::make_unique<LargestOf>([crossings](const Simulation& simulation) {
              return static_cast<double>(crossings->count(simulation.state().positions));
            });
          }};
}

CaseCheck outside_solids(double depth) {
  return {"depth in a solid at the end [m]", depth,
          [](const Simulation&, double) { return std::make_unique<LastOf>(depth_in_solids); }};
}

CaseCheck velocity_jumps_at_most(double speed) {
  return {"change of a velocity in a step [m/s]", speed,
          [](const Simulation&, double) { return std::make_unique<VelocityJump>(); }};
}

VariantCheck variants_agree(double share) {
  return {"distance of the variants, of the diagonal", share,
          [](std::span<const std::unique_ptr<Simulation>> ends) {
            const Positions first = in_own_size(*ends.front());
            double largest = 0;
            for (const auto& end : ends)
              largest = std::max(largest, largest_distance(in_own_size(*end), first));
            return largest;
          }};
}

VariantCheck sags_agree(double share) {
  return {"difference of the variants' sags", share,
          [](std::span<const std::unique_ptr<Simulation>> ends) {
            const double first = sag(*ends.front());
            double largest = 0;
            for (const auto& end : ends)
              largest = std::max(largest, std::abs(sag(*end) / first - 1));
            return largest;
          },
          true};
}

}  // namespace pleat
