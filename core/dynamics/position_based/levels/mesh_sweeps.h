#pragma once

#include <memory>

#include "core/dynamics/method_options.h"
#include "core/dynamics/position_based/lane_layout.h"
#include "core/dynamics/position_based/levels/gathered_bends.h"
#include "core/dynamics/position_based/levels/gathered_springs.h"
#include "core/dynamics/position_based/levels/gathered_vertices.h"
#include "core/dynamics/position_based/spring_law.h"
#include "core/model/cloth_model.h"

namespace pleat {

/// The constraints of the cloth's own mesh, the finest level of a cycle.
class MeshSweeps {
 public:
  virtual ~MeshSweeps() = default;

  /// Takes over pins that changed in number or vertex.
  virtual void refresh_pins(const float* inverse_masses) = 0;
  /// Takes over changed rest lengths. Allocates nothing.
  virtual void refresh_rest_lengths(const ClothModel& model) = 0;

  /// Projects each constraint once, unless the smoother is none. Allocates nothing after the first
  /// call.
  ///
  /// is_first  starts from multipliers of zero
  virtual void sweep(GatheredVertices& vertices, const Relaxation& relaxation, bool is_first) = 0;

  /// How many constraints there are.
  virtual int size() const = 0;
  /// Springs that are projected one by one, whose errors can be asked for; null where they are not.
  virtual GatheredSprings* springs() { return nullptr; }

  /// Bending elements beside them.
  virtual GatheredBends* bends() { return nullptr; }

  /// See Projections.
  virtual double squared_residual(GatheredVertices& vertices) = 0;
  virtual double squared_residual_before(GatheredVertices& vertices) = 0;
};

/// On any mesh, one constraint after the other: sets that share no vertex, four at a time.
std::unique_ptr<MeshSweeps> gathered_sweeps(const ClothModel& model, const LaneLayout& layout,
                                            SpringLaw law, double h);

/// On a grid, as `xpbd` does: lines of springs at once. Knows no other smoother.
std::unique_ptr<MeshSweeps> line_sweeps(const ClothModel& model, const LaneLayout& layout,
                                        SpringLaw law, double h);

}  // namespace pleat
