// Garments in motion for a page, on any of their meshes. Calls are as in bindings.cpp; a view dies
// when memory grows.
#include <emscripten/bind.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/check.h"
#include "core/error/error_norms.h"
#include "core/error/self_crossings.h"
#include "core/error/surface_distance.h"
#include "core/figure/mannequin.h"
#include "core/figure/moving_body.h"
#include "core/model/stretch.h"
#include "core/refinement/fit_monitor.h"
#include "wasm/arrays.h"
#include "wasm/envelope.h"
#include "wasm/handed_over.h"
#include "wasm/page_run.h"
#include "wasm/quad_arrays.h"

namespace {

using emscripten::val;
using pleat::guarded;
using pleat::json_triple;
using pleat::positions_in;
using pleat::view_of;

val json_cone(const pleat::RoundedCone& cone) {
  val entry = val::object();
  entry.set("a_m", json_triple(cone.centre_a));
  entry.set("b_m", json_triple(cone.centre_b));
  entry.set("radius_a_m", cone.radius_a);
  entry.set("radius_b_m", cone.radius_b);
  entry.set("across", json_triple(cone.across));
  entry.set("half_width_a_m", cone.half_width_a);
  entry.set("half_width_b_m", cone.half_width_b);
  return entry;
}

bool is_arm(pleat::Bone bone) {
  using pleat::Bone;
  return bone == Bone::upper_arm_right || bone == Bone::upper_arm_left ||
         bone == Bone::forearm_right || bone == Bone::forearm_left;
}

/// A garment, or a sheet, on one of its meshes: stepped, or put where a record has it.
class GarmentRun {
 public:
  explicit GarmentRun(std::string fabrics_json) : fabrics_json_(std::move(fabrics_json)) {}

  std::string load(const std::string& scene_text, const val& files) {
    return guarded([&](val& envelope) {
      const pleat::Scene scene = pleat::read_scene_with(scene_text, files, fabrics_json_);
      auto fresh = std::make_unique<pleat::Simulation>(scene);
      if (fresh->mesh() == nullptr)
        throw pleat::InputError("/cloth", "expected a sheet or a garment, got other cloth");
      take(std::move(fresh));
      envelope.set("name", scene.name);
      envelope.set("caption", scene.caption);
      envelope.set("fabric", scene.fabric.name);
      envelope.set("n_vertices", mesh().n_vertices());
      envelope.set("n_faces", arrays_->faces.size() / pleat::kNumbersPerFace);
      envelope.set("n_base_faces", mesh().n_base_faces());
      envelope.set("n_hanging", arrays_->hanging.size());
      envelope.set("step_s", scene.method.step);
      envelope.set("duration_s", scene.duration);
      envelope.set("has_monitor", monitor_.has_value());
    });
  }

  std::string reset() {
    return guarded([&](val&) {
      run_.reset();
      begin();
    });
  }

  int step(int n) {
    return run_.step(n, [this] { show(running().state().positions, running().time()); });
  }

  /// Shows a frame that was computed elsewhere; the next step goes on from where steps had come.
  std::string put(const val& places, double time) {
    return guarded([&](val&) {
      const pleat::Positions x = positions_in(places);
      check_places(x, mesh());
      show(x, time);
    });
  }

  /// Shows what this mesh could show of a shape of a uniform mesh that is as fine or finer.
  std::string put_sample(const val& fine_places, int fine_level, double time) {
    return guarded([&](val&) {
      const pleat::Positions fine = positions_in(fine_places);
      check_places(fine, fine_mesh(fine_level));
      show(sample_->of(fine), time);
    });
  }

  std::string status() const {
    return guarded([&](val& envelope) { run_.put_status(envelope); });
  }

  /// Wall time of the steps, in parts, since the last load or reset.
  std::string costs() const {
    return guarded([&](val& envelope) { run_.put_costs(envelope); });
  }

  /// What the steps since the last load or reset show that the scene cannot explain.
  std::string warnings() const {
    return guarded([&](val& envelope) { run_.put_warnings(envelope); });
  }

  /// The shown frame is the next one that the plan's monitor sees.
  std::string look() {
    return guarded([&](val& envelope) {
      if (!monitor_)
        throw pleat::InputError("/refinement", "expected a plan with limits, got none");
      const pleat::FitReport fit = monitor_->look(shown_);
      envelope.set("share", fit.share);
      envelope.set("worst_share", fit.worst_share);
      envelope.set("n_in_a_row", fit.n_in_a_row);
      envelope.set("n_frames", fit.n_frames);
      envelope.set("fires", fit.fires);
      envelope.set("first_fired", fit.first_fired ? val(*fit.first_fired) : val::null());
    });
  }

  /// How far the shown frame is from one of the same cloth on a uniform mesh that is as fine or
  /// finer: its vertices' places. Each of its material points is sought on this mesh.
  std::string compare(const val& fine_places, int fine_level) {
    return guarded([&](val& envelope) {
      const pleat::Positions fine = positions_in(fine_places);
      const pleat::QuadMesh& reference = fine_mesh(fine_level);
      check_places(fine, reference);
      const pleat::Positions own = pleat::on_finer_mesh(shown_, mesh(), reference);
      envelope.set("rms_m", pleat::position_error(own, fine, fine_areas_));
      const Eigen::VectorXf distances =
          (shown_ - sample_->of(fine)).colwise().norm().cast<float>().transpose();
      distances_.assign(distances.data(), distances.data() + distances.size());
    });
  }

  /// How far the shown surface is from that one, whatever slid along it.
  std::string compare_surface(const val& fine_places, int fine_level) {
    return guarded([&](val& envelope) {
      const auto error =
          pleat::surface_error(running().triangles(), shown_, fine_mesh(fine_level).triangles(),
                               positions_in(fine_places));
      envelope.set("rms_m", error.rms);
      envelope.set("percentile_95_m", error.percentile_95);
    });
  }

  /// Faults of the shown frame: vertices inside of solids, and where the cloth passes through
  /// itself.
  std::string faults() {
    return guarded([&](val& envelope) {
      pleat::Penetration inside;
      if (const auto& contact = running().model().contact)
        inside = contact->penetration(shown_, time_);
      envelope.set("n_inside", inside.n_inside);
      envelope.set("deepest_m", inside.depth);
      if (!crossings_)
        crossings_.emplace(running().triangles(), running().rest_positions(),
                           running().model().hanging);
      envelope.set("n_crossings", static_cast<double>(crossings_->count(shown_)));
    });
  }

  /// The figure at the shown time, whether the cloth meets all of it or not, but for arms, which
  /// would hang through a skirt; and where its pelvis is.
  std::string solids() const {
    return guarded([&](val& envelope) {
      val list = val::array();
      for (const pleat::BodyPart& part : parts_) {
        const auto shape = pleat::placed(part.shape, body_->pose(part.bone, time_));
        list.call<void>("push", json_cone(std::get<pleat::RoundedCone>(shape)));
      }
      envelope.set("cones", list);
      envelope.set("pelvis_m",
                   body_ ? json_triple(body_->joint(pleat::Bone::pelvis, time_)) : val::null());
    });
  }

  double time() const { return time_; }
  val positions() const { return view_of(positions_); }
  val triangles() const { return array(&pleat::QuadArrays::triangles); }
  val triangle_faces() const { return array(&pleat::QuadArrays::triangle_faces); }
  val edges() const { return array(&pleat::QuadArrays::edges); }
  val hanging() const { return array(&pleat::QuadArrays::hanging); }
  val parents() const { return array(&pleat::QuadArrays::parents); }
  val faces() const { return array(&pleat::QuadArrays::faces); }

  /// The curvature of the shown frame at each vertex [1/m].
  val curvature() {
    curvatures_.clear();
    if (curvature_) {
      const Eigen::VectorXd values = curvature_->of(shown_);
      curvatures_.assign(values.data(), values.data() + values.size());
    }
    return view_of(curvatures_);
  }

  /// How far each vertex is from the same point of what was last compared with [m].
  val distances() const { return view_of(distances_); }

 private:
  template <class Number>
  val array(const std::vector<Number> pleat::QuadArrays::*part) const {
    return arrays_ ? view_of((*arrays_).*part) : view_of(std::vector<Number>{});
  }

  static void check_places(const pleat::Positions& places, const pleat::QuadMesh& mesh) {
    if (places.cols() != mesh.n_vertices() || !places.allFinite())
      throw pleat::InputError("", "expected a finite place for each of " +
                                      std::to_string(mesh.n_vertices()) + " vertices, got " +
                                      std::to_string(places.cols()) + " places");
  }

  pleat::Simulation& running() const { return run_.running(); }
  const pleat::QuadMesh& mesh() const { return *running().mesh(); }

  void take(std::unique_ptr<pleat::Simulation> fresh) {
    run_.take(std::move(fresh));
    const pleat::Scene& scene = running().scene();
    arrays_ = pleat::quad_arrays(mesh());
    curvature_.emplace(mesh());
    fine_.reset();
    crossings_.reset();
    body_ = scene.figure ? std::make_shared<const pleat::MovingBody>(scene.figure->motion,
                                                                     scene.figure->playback)
                         : nullptr;
    parts_.clear();
    if (scene.figure)
      for (const pleat::BodyPart& part : pleat::mannequin(scene.figure->build))
        if (!is_arm(part.bone)) parts_.push_back(part);
    begin();
  }

  void begin() {
    const pleat::Scene& scene = running().scene();
    monitor_.reset();
    if (scene.plan && !scene.plan->curvature_limits.empty()) monitor_.emplace(mesh(), *scene.plan);
    distances_.clear();
    show(running().state().positions, running().time());
  }

  void show(const pleat::Positions& x, double time) {
    shown_ = x;
    time_ = time;
    positions_.assign(x.data(), x.data() + x.size());
  }

  const pleat::QuadMesh& fine_mesh(int level) {
    if (fine_ && fine_level_ == level) return *fine_;
    if (level < 0 || level > pleat::kMaxLevel)
      throw pleat::InputError("level", "expected one from 0 to " +
                                           std::to_string(pleat::kMaxLevel) + ", got " +
                                           std::to_string(level));
    fine_ = pleat::base_quads(running().scene());
    fine_->refine_uniformly(level);
    fine_level_ = level;
    fine_areas_ = fine_->vertex_areas();
    sample_.emplace(mesh(), *fine_);
    return *fine_;
  }

  std::string fabrics_json_;
  pleat::PageRun run_;
  std::shared_ptr<const pleat::MovingBody> body_;
  std::vector<pleat::BodyPart> parts_;  // of it that are drawn
  std::optional<pleat::QuadArrays> arrays_;
  std::optional<pleat::VertexCurvature> curvature_;
  std::optional<pleat::FitMonitor> monitor_;
  std::optional<pleat::SelfCrossings> crossings_;
  std::optional<pleat::QuadMesh> fine_;
  int fine_level_ = 0;
  Eigen::VectorXd fine_areas_;
  std::optional<pleat::MeshSample> sample_;  // of the fine mesh
  pleat::Positions shown_;                   // [m]
  double time_ = 0;                          // of what is shown [s]
  std::vector<float> positions_;
  std::vector<float> curvatures_;
  std::vector<float> distances_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(refinement) {
  emscripten::class_<GarmentRun>("GarmentRun")
      .constructor<std::string>()
      .function("load", &GarmentRun::load)
      .function("reset", &GarmentRun::reset)
      .function("step", &GarmentRun::step)
      .function("put", &GarmentRun::put)
      .function("putSample", &GarmentRun::put_sample)
      .function("status", &GarmentRun::status)
      .function("costs", &GarmentRun::costs)
      .function("warnings", &GarmentRun::warnings)
      .function("look", &GarmentRun::look)
      .function("compare", &GarmentRun::compare)
      .function("compareSurface", &GarmentRun::compare_surface)
      .function("faults", &GarmentRun::faults)
      .function("solids", &GarmentRun::solids)
      .function("time", &GarmentRun::time)
      .function("positions", &GarmentRun::positions)
      .function("triangles", &GarmentRun::triangles)
      .function("triangleFaces", &GarmentRun::triangle_faces)
      .function("edges", &GarmentRun::edges)
      .function("hanging", &GarmentRun::hanging)
      .function("faces", &GarmentRun::faces)
      .function("parents", &GarmentRun::parents)
      .function("curvature", &GarmentRun::curvature)
      .function("distances", &GarmentRun::distances);
}
