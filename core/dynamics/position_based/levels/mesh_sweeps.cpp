#include "core/dynamics/position_based/levels/mesh_sweeps.h"

#include "core/dynamics/position_based/lanes/hanging_program.h"
#include "core/dynamics/position_based/lanes/lane_projections.h"

namespace pleat {
namespace {

class GatheredSweeps final : public MeshSweeps {
 public:
  GatheredSweeps(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h)
      : springs_(model, layout, law, h),
        bends_(model, layout, h),
        hanging_(model, layout, law, h) {}

  void refresh_pins(const float* inverse_masses) override {
    springs_.refresh_pins(inverse_masses);
    bends_.refresh_pins(inverse_masses);
  }

  void refresh_rest_lengths(const ClothModel& model) override {
    springs_.refresh_rest_lengths(model);
    hanging_.refresh_rest_lengths(model);
  }

  void sweep(GatheredVertices& vertices, const Relaxation& relaxation, bool is_first) override {
    if (relaxation.smoother == Smoother::none) return;
    const float* const begins = vertices.begins();
    float* const moves = vertices.moves();
    const float omega =
        relaxation.smoother == Smoother::sor ? static_cast<float>(relaxation.omega) : 1.0f;
    if (is_first) {
      bends_.first_sweep(begins, moves, omega);
      springs_.first_sweep(begins, moves, relaxation);
    } else {
      bends_.next_sweep(begins, moves, omega);
      springs_.next_sweep(begins, moves, relaxation);
    }
    if (hanging_.empty()) return;
    const LaneView& view = vertices.lanes();
    is_first ? hanging_.first_sweep(view) : hanging_.next_sweep(view);
  }

  int size() const override { return springs_.size() + bends_.size() + hanging_.size(); }
  GatheredSprings* springs() override { return &springs_; }
  GatheredBends* bends() override { return &bends_; }

  double squared_residual(GatheredVertices& vertices) override {
    const double of_hanging = hanging_.squared_residual(vertices.lanes());
    return of_hanging + springs_.squared_residual(vertices.begins(), vertices.moves()) +
           bends_.squared_residual(vertices.begins(), vertices.moves());
  }

  double squared_residual_before(GatheredVertices& vertices) override {
    const double of_hanging = hanging_.squared_residual_before_sweeps(vertices.lanes());
    return of_hanging +
           springs_.squared_residual_before_sweeps(vertices.begins(), vertices.moves()) +
           bends_.squared_residual_before_sweeps(vertices.begins(), vertices.moves());
  }

 private:
  GatheredSprings springs_;
  GatheredBends bends_;
  HangingProgram hanging_;
};

class LineSweeps final : public MeshSweeps {
 public:
  LineSweeps(const ClothModel& model, const LaneLayout& layout, SpringLaw law, double h)
      : lanes_(model, layout, law, h) {}

  void refresh_pins(const float*) override {}
  void refresh_rest_lengths(const ClothModel& model) override {
    lanes_.refresh_rest_lengths(model);
  }

  void sweep(GatheredVertices& vertices, const Relaxation& relaxation, bool is_first) override {
    if (relaxation.smoother != Smoother::none) lanes_.sweep(vertices.lanes(), is_first);
  }

  int size() const override { return lanes_.size(); }

  double squared_residual(GatheredVertices& vertices) override {
    return lanes_.squared_residual(vertices.lanes());
  }
  double squared_residual_before(GatheredVertices& vertices) override {
    return lanes_.squared_residual_before(vertices.lanes());
  }

 private:
  LaneProjections lanes_;
};

}  // namespace

std::unique_ptr<MeshSweeps> gathered_sweeps(const ClothModel& model, const LaneLayout& layout,
                                            SpringLaw law, double h) {
  return std::make_unique<GatheredSweeps>(model, layout, law, h);
}

std::unique_ptr<MeshSweeps> line_sweeps(const ClothModel& model, const LaneLayout& layout,
                                        SpringLaw law, double h) {
  return std::make_unique<LineSweeps>(model, layout, law, h);
}

}  // namespace pleat
