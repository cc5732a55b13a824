#pragma once

#include <vector>

#include "core/base/part_observer.h"
#include "core/linalg/solve_report.h"
#include "core/mesh/quad_mesh.h"
#include "core/model/cloth_model.h"
#include "core/model/state.h"
#include "core/model/stretch.h"

namespace pleat {

/// Cloth that is stepped through time, whether its mesh stays (Simulation) or follows its shape
/// (AdaptiveRun).
class MovingCloth {
 public:
  virtual ~MovingCloth() = default;

  /// One step of the scene's method; see Stepper::advance.
  virtual SolveReport step() = 0;
  virtual const State& state() const = 0;
  virtual const ClothModel& model() const = 0;
  /// The edges by which stretch is measured.
  virtual const std::vector<GaugeEdge>& gauge() const = 0;
  /// Null for cloth that is not of quads.
  virtual const QuadMesh* mesh() const = 0;
  virtual double time() const = 0;  ///< [s]
  /// Null ends it. An observer outlives the steps that it sees.
  virtual void observe(PartObserver* observer) = 0;
};

}  // namespace pleat
