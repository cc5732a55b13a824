// Garments in motion for a page, on any of their meshes. Calls are as in bindings.cpp; a view dies
// when memory grows.
#include <emscripten/bind.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/body/mannequin.h"
#include "core/body/moving_body.h"
#include "core/error/error_norms.h"
#include "core/error/fold_spectrum.h"
#include "core/error/mesh_sampling.h"
#include "core/error/self_crossings.h"
#include "core/error/surface_distance.h"
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

  /// Takes the scene that frames are compared with from now on: the same cloth on its fine mesh.
  std::string hold_against(const std::string& scene_text, const val& files) {
    return guarded([&](val&) {
      const pleat::Scene scene = pleat::read_scene_with(scene_text, files, fabrics_json_);
      std::optional<pleat::QuadMesh> fine = pleat::base_quads(scene);
      if (!fine)
        throw pleat::InputError("/cloth", "expected a sheet or a garment, got other cloth");
      fine->refine_uniformly(scene.level);
      reference_.emplace(mesh(), *fine);
    });
  }

  /// Shows what this mesh could show of a shape of the fine one.
  std::string put_sample(const val& fine_places, double time) {
    return guarded(
        [&](val&) { show(reference().sampling.sampled(fine_positions(fine_places)), time); });
  }

  std::string status() const {
    return guarded([&](val& envelope) { run_.put_status(envelope); });
  }

  /// Wall time of the steps, in parts, since the last load or reset.
  std::string costs() const {
    return guarded([&](val& envelope) { run_.put_costs(envelope); });
  }

  /// Signs in the steps since the last load or reset that the scene cannot explain.
  std::string warnings() const {
    return guarded([&](val& envelope) { run_.put_warnings(envelope); });
  }

  /// The shown frame is the next one that the plan's monitor sees.
  std::string add_shown_frame() {
    return guarded([&](val& envelope) {
      if (!monitor_)
        throw pleat::InputError("/refinement", "expected a plan with limits, got none");
      const pleat::FitReport fit = monitor_->add_frame(shown_);
      envelope.set("share", fit.share);
      envelope.set("worst_share", fit.worst_share);
      envelope.set("n_in_a_row", fit.n_in_a_row);
      envelope.set("n_frames", fit.n_frames);
      envelope.set("fires", fit.fires);
      envelope.set("first_fired", fit.first_fired ? val(*fit.first_fired) : val::null());
    });
  }

  /// How far the shown frame is from the fine mesh's vertices at these places, at the same points
  /// of the cloth; and what this mesh loses of that shape by its faces alone.
  std::string compare(const val& fine_places) {
    return guarded([&](val& envelope) {
      const pleat::Positions fine = fine_positions(fine_places);
      const pleat::MeshSampling& sampling = reference().sampling;
      const pleat::Positions own = sampling.shown(shown_);
      envelope.set("rms_m", pleat::position_error(own, fine, reference().areas));
      const pleat::Positions sampled = sampling.sampled(fine);
      const pleat::SamplingError lost = sampling.error(fine, sampled);
      envelope.set("lost_m", lost.distance);
      envelope.set("lost_normals_rad", lost.normal_angle);
      const Eigen::VectorXf distances =
          (shown_ - sampled).colwise().norm().cast<float>().transpose();
      distances_.assign(distances.data(), distances.data() + distances.size());
    });
  }

  /// How far the shown surface is from that one, whatever slid along it.
  std::string compare_surface(const val& fine_places) {
    return guarded([&](val& envelope) {
      const pleat::Positions fine = fine_positions(fine_places);
      const auto error =
          pleat::surface_error(running().triangles(), shown_, reference().mesh.triangles(), fine);
      envelope.set("rms_m", error.rms);
      envelope.set("percentile_95_m", error.percentile_95);
    });
  }

  /// The folds of the shown frame count from now on, until the next reset.
  std::string add_folds() {
    return guarded([&](val&) {
      if (!folds_)
        folds_.emplace(mesh().triangle_mesh(),
                       pleat::garment_rings(reference().mesh.triangle_mesh()));
      folds_->add(shown_);
      const Eigen::MatrixXd amplitudes = folds_->amplitudes();
      fold_amplitudes_.assign(amplitudes.data(), amplitudes.data() + amplitudes.size());
    });
  }

  /// How far folds stand out, by their number around each ring, over what was added [m].
  val folds() const { return view_of(fold_amplitudes_); }

  /// How differently two runs are folded, of which these are `folds`.
  std::string compare_folds(const val& folds_a, const val& folds_b) {
    return guarded([&](val& envelope) {
      const Eigen::MatrixXd a = by_ring(folds_a);
      const Eigen::MatrixXd b = by_ring(folds_b);
      if (a.size() == 0 || a.cols() != b.cols())
        throw pleat::InputError("folds", "expected those of two runs of one garment");
      envelope.set("distance_m", pleat::fold_distance(a, b));
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

  /// The body at the shown time, whether the cloth meets all of it or not, but for arms, which
  /// would hang through a skirt; and where its pelvis is.
  std::string solids() const {
    return guarded([&](val& envelope) {
      val list = val::array();
      for (const pleat::BodyPart& part : parts_) {
        const pleat::Pose pose = body_->pose(part.bone, time_);
        list.call<void>("push", json_cone(pleat::placed(part.shape, pose)));
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
  /// A fine mesh, and how shapes of it are shown on this one.
  struct Reference {
    Reference(const pleat::QuadMesh& own, const pleat::QuadMesh& fine)
        : mesh(fine), areas(fine.vertex_areas()), sampling(own, fine) {}

    pleat::QuadMesh mesh;
    Eigen::VectorXd areas;  // areas of its vertices at rest [m^2]
    pleat::MeshSampling sampling;
  };

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

  static Eigen::MatrixXd by_ring(const val& folds) {
    const auto amplitudes = emscripten::convertJSArrayToNumberVector<double>(folds);
    constexpr Eigen::Index n = pleat::FoldAmplitudes::RowsAtCompileTime;
    return Eigen::Map<const Eigen::MatrixXd>(amplitudes.data(), n,
                                             static_cast<Eigen::Index>(amplitudes.size()) / n);
  }

  pleat::Simulation& running() const { return run_.running(); }
  const pleat::QuadMesh& mesh() const { return *running().mesh(); }

  void take(std::unique_ptr<pleat::Simulation> fresh) {
    run_.take(std::move(fresh));
    const pleat::Scene& scene = running().scene();
    arrays_ = pleat::quad_arrays(mesh());
    curvature_.emplace(mesh());
    reference_.reset();
    crossings_.reset();
    body_ = scene.body ? std::make_shared<const pleat::MovingBody>(scene.body->motion,
                                                                   scene.body->playback)
                       : nullptr;
    parts_.clear();
    if (scene.body)
      for (const pleat::BodyPart& part : pleat::mannequin(scene.body->build))
        if (!is_arm(part.bone)) parts_.push_back(part);
    begin();
  }

  void begin() {
    const pleat::Scene& scene = running().scene();
    monitor_.reset();
    if (scene.plan && !scene.plan->curvature_limits.empty()) monitor_.emplace(mesh(), *scene.plan);
    distances_.clear();
    folds_.reset();
    fold_amplitudes_.clear();
    show(running().state().positions, running().time());
  }

  void show(const pleat::Positions& x, double time) {
    shown_ = x;
    time_ = time;
    positions_.assign(x.data(), x.data() + x.size());
  }

  const Reference& reference() const {
    if (!reference_)
      throw pleat::InputError("", "expected a fine mesh to hold frames against, got none");
    return *reference_;
  }

  pleat::Positions fine_positions(const val& places) const {
    pleat::Positions fine = positions_in(places);
    check_places(fine, reference().mesh);
    return fine;
  }

  std::string fabrics_json_;
  pleat::PageRun run_;
  std::shared_ptr<const pleat::MovingBody> body_;
  std::vector<pleat::BodyPart> parts_;  // parts of the body that are drawn
  std::optional<pleat::QuadArrays> arrays_;
  std::optional<pleat::VertexCurvature> curvature_;
  std::optional<pleat::FitMonitor> monitor_;
  std::optional<pleat::SelfCrossings> crossings_;
  std::optional<Reference> reference_;
  std::optional<pleat::FoldSpectrum> folds_;
  pleat::Positions shown_;  // [m]
  double time_ = 0;         // time of the shown positions [s]
  std::vector<float> positions_;
  std::vector<float> curvatures_;
  std::vector<float> distances_;
  std::vector<double> fold_amplitudes_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(refinement) {
  emscripten::class_<GarmentRun>("GarmentRun")
      .constructor<std::string>()
      .function("load", &GarmentRun::load)
      .function("reset", &GarmentRun::reset)
      .function("step", &GarmentRun::step)
      .function("put", &GarmentRun::put)
      .function("holdAgainst", &GarmentRun::hold_against)
      .function("putSample", &GarmentRun::put_sample)
      .function("status", &GarmentRun::status)
      .function("costs", &GarmentRun::costs)
      .function("warnings", &GarmentRun::warnings)
      .function("addShownFrame", &GarmentRun::add_shown_frame)
      .function("compare", &GarmentRun::compare)
      .function("compareSurface", &GarmentRun::compare_surface)
      .function("addFolds", &GarmentRun::add_folds)
      .function("folds", &GarmentRun::folds)
      .function("compareFolds", &GarmentRun::compare_folds)
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
