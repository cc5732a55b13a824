// Scenes and a running simulation for a page. Cold calls take and return JSON text in an envelope
// (envelope.h); hot calls return numbers and views. A view of memory dies when memory grows: take
// it anew after each call.
#include <emscripten/bind.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/dynamics/implicit/stepper_imex.h"
#include "core/dynamics/stepper_table.h"
#include "core/files/obj_file.h"
#include "core/hierarchy/mesh_hierarchy.h"
#include "core/linalg/make_linear_solver.h"
#include "core/mesh/mesh_fault.h"
#include "core/model/stretch.h"
#include "core/reference/reference_track.h"
#include "core/run/response_study.h"
#include "core/run/run_ledger.h"
#include "core/scene/cloth/mesh_cloth.h"
#include "core/scene/format/method_section.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/format/solid_section.h"
#include "core/scene/format/surface_section.h"
#include "wasm/arrays.h"
#include "wasm/envelope.h"
#include "wasm/page_run.h"

namespace {

using emscripten::val;
using pleat::guarded;
using pleat::json_array;
using pleat::json_triple;
using pleat::json_value;
using pleat::positions_in;
using pleat::view_of;

/// A scene that the motion view can draw: it has no body.
pleat::Scene shown_scene(const std::string& scene_text, const std::string& fabrics_json,
                         const pleat::FileSource& files = {}) {
  pleat::Scene scene = pleat::read_scene(scene_text, pleat::read_fabrics(fabrics_json), files);
  if (scene.body)
    throw pleat::InputError("/figure",
                            "expected no figure, as this view shows none; pleat run takes it");
  return scene;
}

val summary(const pleat::Simulation& simulation) {
  const pleat::ClothModel& model = simulation.model();
  const pleat::BuildReport report = pleat::build_report(model, simulation.scene().model);
  val result = val::object();
  result.set("n_vertices", model.n_vertices());
  result.set("n_springs", model.springs.size());
  result.set("n_bends", model.bends.size());
  result.set("n_triangles", simulation.triangles().size());
  result.set("step_s", simulation.scene().method.step);
  result.set("substeps", simulation.substeps());
  result.set("built", json_array(report.built));
  result.set("left_out", json_array(report.left_out));
  std::vector<std::string> notes;
  if (!pleat::is_available(pleat::SolverKind::cholmod))
    notes.emplace_back(
        "CHOLMOD's source could not be had when this module was built; Eigen's Cholesky serves.");
  result.set("notes", json_array(notes));
  return result;
}

/// The fabric library as text, read on every use: cold, and one string instead of a second copy of
/// its types.
class Scene {
 public:
  explicit Scene(std::string fabrics_json) : fabrics_json_(std::move(fabrics_json)) {}

  std::string fabrics() const {
    return guarded([&](val& envelope) {
      pleat::read_fabrics(fabrics_json_);
      const val library = json_value(fabrics_json_);
      envelope.set("fabrics", library["fabrics"]);
      envelope.set("sources", library["meta"]["sources"]);
    });
  }

  /// The words and marks by which a page shows each stepper, and the details that they read.
  std::string steppers() const {
    return guarded([](val& envelope) {
      envelope.set("steppers", json_value(pleat::json_steppers(pleat::standard_steppers()).dump()));
      envelope.set("details", json_value(pleat::json_method_details().dump()));
    });
  }

  std::string parse(const std::string& scene_text) const {
    return guarded([&](val& envelope) {
      const pleat::Scene scene = shown_scene(scene_text, fabrics_json_);
      envelope.set("scene", json_value(pleat::write_scene(scene)));
      envelope.set("summary", summary(pleat::Simulation(scene)));
    });
  }

  /// The scene from first contact on, at rest and bouncing.
  std::string study_response(const std::string& scene_text, double window) const {
    return guarded([&](val& envelope) {
      const pleat::Scene scene = shown_scene(scene_text, fabrics_json_);
      const pleat::ResponseStudy study = pleat::study_response(scene, window);
      envelope.set("first_contact_s", study.first_contact);
      envelope.set("substep_s", study.substep);
      const auto set_run = [&](const char* name, const pleat::ResponseRun& run) {
        val json = val::object();
        json.set("normal_velocities_m_per_s", json_array(run.normal_velocities));
        json.set("rms_normal_velocity_m_per_s", run.rms_normal_velocity);
        json.set("n_touched", run.n_touched);
        json.set("contact_share", run.contact_share);
        envelope.set(name, json);
      };
      set_run("resting", study.resting);
      set_run("uniform", study.uniform);
    });
  }

  /// The mesh of an OBJ file, written out, with what a page says of it. `mesh_text` is the section
  /// "mesh" of a scene that names the file.
  std::string read_obj(const std::string& obj_text, const std::string& mesh_text) const {
    return guarded([&](val& envelope) {
      const auto file = [&](const std::string&) { return obj_text; };
      const pleat::Scene scene =
          shown_scene("{\"cloth\": {\"mesh\": " + mesh_text + "}}", fabrics_json_, file);
      const auto& cloth = *scene.cloth.as<pleat::MeshCloth>();
      const pleat::Positions& x = cloth.mesh.rest_positions;
      envelope.set("cloth", json_value(pleat::write_scene(scene))["cloth"]);
      std::vector<std::string> names;
      for (const pleat::VertexGroup& group : cloth.groups) names.push_back(group.name);
      envelope.set("groups", json_array(names));
      envelope.set("n_vertices", cloth.mesh.n_vertices());
      envelope.set("n_triangles", cloth.mesh.triangles.size());
      envelope.set("low_m", json_triple(x.rowwise().minCoeff()));
      envelope.set("high_m", json_triple(x.rowwise().maxCoeff()));
      envelope.set("skipped", cloth.skipped);
      const auto textures = pleat::read_obj(obj_text).textures;
      envelope.set("needs_direction",
                   std::any_of(textures.begin(), textures.end(),
                               [](const auto& texture) { return !texture.has_value(); }));
    });
  }

 private:
  std::string fabrics_json_;
};

class Simulation {
 public:
  explicit Simulation(std::string fabrics_json) : fabrics_json_(std::move(fabrics_json)) {}

  std::string load(const std::string& scene_text) {
    return guarded([&](val& envelope) {
      take(build(scene_text));
      envelope.set("summary", summary(running()));
    });
  }

  /// Loads a scene and carries the run over. Torn cloth starts whole instead.
  std::string carry_over(const std::string& scene_text) {
    return guarded([&](val& envelope) {
      auto fresh = build(scene_text);
      if (running().tear_origins().empty()) fresh->carry_over(running());
      take(std::move(fresh));
      envelope.set("summary", summary(running()));
    });
  }

  /// Starts from these places, now and at each reset.
  std::string start_from(const val& places) {
    return guarded([&](val&) {
      run_.start_from(positions_in(places));
      begin_ledger();
      frame();
    });
  }

  std::string reset() {
    return guarded([&](val&) {
      run_.reset();
      begin_ledger();
      frame();
    });
  }

  int step(int n) {
    if (!ledger_) return run_.step(n, [this] { frame(); });
    int status = run_.step(0, [this] { frame(); });
    for (int i = 0; i < n && status == 0; ++i)
      status = run_.step(1, [this] {
        ledger_->record_step();
        frame();
      });
    return status;
  }

  /// Accounts for energy from now on, and anew from each start.
  void open_ledger() {
    wants_ledger_ = true;
    begin_ledger();
  }
  void close_ledger() {
    wants_ledger_ = false;
    begin_ledger();
  }

  std::string status() const {
    return guarded([&](val& envelope) { run_.put_status(envelope); });
  }

  std::string numbers() {
    return guarded([&](val& envelope) {
      const pleat::Stretch stretch = pleat::stretch(running().gauge(), running().state().positions);
      envelope.set("time_s", running().time());
      envelope.set("step", static_cast<double>(running().n_steps()));
      envelope.set("largest_stretch", stretch.largest);
      envelope.set("rms_stretch", stretch.rms);
      envelope.set("residual", run_.report().relative_residual);
      envelope.set("iterations", run_.report().iterations);
      const bool is_held = running().is_grabbed();
      envelope.set("asked_stretch", is_held ? val(running().asked_stretch()) : val::null());
      run_.put_costs(envelope);
      run_.put_warnings(envelope);
      envelope.set("reference", matches_ ? compare() : val::null());
    });
  }

  /// Takes the bytes of a reference, against which `numbers` and `distances` compare while the
  /// loaded scene is what it is of.
  std::string set_reference(const std::string& bytes) {
    return guarded([&](val& envelope) {
      reference_.emplace(pleat::read_reference(bytes));
      match();
      envelope.set("matches", matches_);
      envelope.set("description", reference_->label().description);
      envelope.set("end_s", reference_->end());
    });
  }

  std::string colliders() {
    return guarded([&](val& envelope) {
      val list = val::array();
      for (const pleat::Collider& collider : running().scene().colliders) {
        const auto shape = pleat::ContactPass::placed(collider, running().time());
        val entry = json_value(pleat::json_solid(shape).dump());
        entry.set("shape", std::string(pleat::word_for(shape)));
        list.call<void>("push", entry);
      }
      int n_surfaces = 0;
      for (const pleat::SurfaceSolid& solid : running().scene().surface_solids) {
        const pleat::Pose pose = solid.motion.pose(running().time());
        val entry = val::object();
        if (const auto* box = std::get_if<pleat::BoxSolid>(&solid.shape)) {
          entry = json_value(pleat::json_shape({placed(*box, pose), {}}).dump());
        } else {
          entry.set("offset_m", json_value(pleat::json_vec3(pose.translation).dump()));
          entry.set("surface", n_surfaces++);
        }
        entry.set("shape", std::string(pleat::word_for(solid)));
        list.call<void>("push", entry);
      }
      envelope.set("colliders", list);
    });
  }

  /// Meshes among the colliders, at time 0.
  std::string surfaces() {
    return guarded([&](val& envelope) {
      val list = val::array();
      for (const pleat::SurfaceSolid& solid : running().scene().surface_solids)
        if (std::holds_alternative<pleat::MeshSolid>(solid.shape))
          list.call<void>("push", json_value(pleat::json_shape(solid).dump()));
      envelope.set("surfaces", list);
    });
  }

  std::string grab(int vertex) {
    return guarded([&](val&) { running().grab(pleat::VertexId(vertex)); });
  }
  void move_grab(double x, double y, double z) {
    if (run_.is_loaded() && running().is_grabbed()) running().move_grab({x, y, z});
  }
  void release_grab() { run_.release_grab(); }

  val positions() const { return view_of(positions_); }
  val triangles() const { return view_of(triangles_); }
  val stretch() {
    if (!run_.is_loaded()) return view_of(kNoFloats);
    return view_of(strain_map_->update(running().state().positions));
  }
  /// Empty without a reference for the scene at its time.
  val distances() {
    if (!matches_ || !reference_->distance(running())) return view_of(kNoFloats);
    return view_of(reference_->distances());
  }
  /// Time [s]; energy of motion, elastic, and by height above that at the start of the account;
  /// works of damping (with inner friction), air, contact (with cloth's own), pins and tears;
  /// drift; energy of motion and elastic at the start [J]. Empty without an account.
  val energies() {
    if (!ledger_) return view_of(kNoDoubles);
    const pleat::EnergyLedger& account = ledger_->account();
    const pleat::EnergyParts& first = account.first_parts();
    const pleat::EnergyParts& now = account.parts();
    const pleat::EnergyLedger::Works& works = account.works();
    energies_ = {running().time(),
                 now.kinetic,
                 now.elastic,
                 now.gravity - first.gravity,
                 works.damping + works.bend_friction,
                 works.air,
                 works.contact + works.cloth_contact,
                 works.pins,
                 works.tears,
                 account.drift(),
                 first.kinetic + first.elastic};
    return view_of(energies_);
  }
  /// Two vertices a spring.
  val spring_ends() {
    spring_ends_.clear();
    if (run_.is_loaded())
      for (const pleat::Spring& spring : running().model().springs)
        for (const pleat::VertexId v : {spring.a, spring.b})
          spring_ends_.push_back(static_cast<std::uint32_t>(v.value));
    return view_of(spring_ends_);
  }
  /// 1 for each spring that is taken implicitly, 0 for others; empty where all are taken alike.
  val implicit_springs() const {
    if (!run_.is_loaded()) return view_of(kNoDoubles);
    return view_of(running().stepper().implicit_springs());
  }
  /// The substeps that imex would take of a step [s] when it is given so many and shall have such a
  /// share of the springs explicit, and the share that is implicit then, as the cloth is held now.
  std::string implicit_share(double step, int substeps, double explicit_share) const {
    return guarded([&](val& envelope) {
      pleat::MethodOptions method = pleat::steppers::kImex.usual_method();
      method.step = step;
      method.substeps = substeps;
      method.explicit_share = explicit_share;
      const pleat::ClothModel& model = running().model();
      const int taken = pleat::imex_substeps(model, method);
      envelope.set("substeps", taken);
      envelope.set("share", 1 - pleat::explicit_share(model, step / taken));
    });
  }
  /// Makes the levels coarser than the mesh that a stepper with such settings makes of it, whatever
  /// stepper runs: `level_vertices` and `level_edges` tell them until the mesh is another one.
  std::string make_levels(const std::string& selection, int n_coarser, double ratio) {
    return guarded([&](val& envelope) {
      pleat::TriangleMesh mesh;
      mesh.rest_positions = running().rest_positions();
      mesh.triangles = running().triangles();
      if (const auto fault = pleat::mesh_fault(mesh.rest_positions, mesh.triangles, 0))
        throw pleat::InputError("/cloth", fault->sentence);
      std::vector<bool> is_pinned(static_cast<std::size_t>(mesh.n_vertices()), false);
      for (const pleat::Pin& pin : running().own_pins()) is_pinned[pin.vertex] = true;
      pleat::HierarchyOptions options;
      options.n_coarser = n_coarser;
      options.ratio = ratio;
      const auto& names = pleat::kLevelSelectionNames;
      const auto* const name = std::find(names.begin(), names.end(), selection);
      if (name == names.end()) throw pleat::InputError("selection", "expected quadrics or thinned");
      options.selection = static_cast<pleat::LevelSelection>(name - names.begin());
      hierarchy_ = pleat::mesh_hierarchy(mesh, is_pinned, options);
      envelope.set("n_coarser", hierarchy_.levels.size() - 1);
      envelope.set("shortage", hierarchy_.shortage);
    });
  }
  /// The vertices of a level, ascending; 0 is the mesh. Empty where there is no such level.
  val level_vertices(std::size_t level) {
    level_ids_.clear();
    for (const pleat::VertexId v : level_at(level).vertices)
      level_ids_.push_back(static_cast<std::uint32_t>(v.value));
    return view_of(level_ids_);
  }
  /// Two vertices of the mesh for each edge of a level.
  val level_edges(std::size_t level) {
    const pleat::MeshLevel& mesh = level_at(level);
    level_ids_.clear();
    for (const pleat::LevelEdge& edge : mesh.edges)
      for (const pleat::VertexId v : {edge.a, edge.b})
        level_ids_.push_back(static_cast<std::uint32_t>(mesh.vertices[v].value));
    return view_of(level_ids_);
  }
  val exact_positions() const {
    return run_.is_loaded() ? view_of(running().state().positions) : view_of(kNoDoubles);
  }
  val masses() const {
    return run_.is_loaded() ? view_of(running().model().masses) : view_of(kNoDoubles);
  }

 private:
  static inline const std::vector<float> kNoFloats;
  static inline const std::vector<double> kNoDoubles;
  static inline const pleat::MeshLevel kNoLevel;

  pleat::Simulation& running() const { return run_.running(); }

  const pleat::MeshLevel& level_at(std::size_t level) const {
    return level < hierarchy_.levels.size() ? hierarchy_.levels[level] : kNoLevel;
  }

  std::unique_ptr<pleat::Simulation> build(const std::string& scene_text) const {
    return std::make_unique<pleat::Simulation>(shown_scene(scene_text, fabrics_json_));
  }

  /// The old simulation goes only now that the new one stands: a bad scene leaves the page's state
  /// as it was.
  void take(std::unique_ptr<pleat::Simulation> fresh) {
    run_.take(std::move(fresh));
    begin_ledger();
    match();
    take_mesh();
    frame();
  }

  void take_mesh() {
    topology_ = running().topology();
    hierarchy_ = {};
    strain_map_.emplace(running().gauge(), running().model().n_vertices());
    triangles_.clear();
    for (const pleat::Triangle& t : running().triangles())
      for (const pleat::VertexId v : t) triangles_.push_back(static_cast<std::uint32_t>(v.value));
  }

  void begin_ledger() {
    ledger_.reset();
    if (wants_ledger_ && run_.is_loaded()) ledger_.emplace(running());
  }

  void match() {
    matches_ = reference_ && run_.is_loaded() && reference_->is_of(running().scene());
  }

  /// The reference is that of the loaded scene.
  val compare() {
    const auto distance = reference_->distance(running());
    val result = val::object();
    result.set("distance_m", distance ? val(distance->rms) : val::null());
    result.set("uncertainty_m", distance ? val(distance->uncertainty) : val::null());
    result.set("end_s", reference_->end());
    result.set("description", reference_->label().description);
    result.set("disturbed", running().is_disturbed());
    return result;
  }

  void frame() {
    if (topology_ != running().topology()) take_mesh();
    const pleat::Positions& x = running().state().positions;
    positions_.assign(x.data(), x.data() + x.size());
  }

  std::string fabrics_json_;
  pleat::PageRun run_;
  bool wants_ledger_ = false;
  std::optional<pleat::RunLedger> ledger_;
  std::array<double, 11> energies_{};
  std::optional<pleat::StrainMap> strain_map_;
  std::int64_t topology_ = 0;  // topology of the strain map and the triangles
  std::optional<pleat::ReferenceTrack> reference_;
  bool matches_ = false;          // it is of the loaded scene
  std::vector<float> positions_;  // 3 per vertex [m]
  std::vector<std::uint32_t> triangles_;
  std::vector<std::uint32_t> spring_ends_;
  pleat::MeshHierarchy hierarchy_;
  std::vector<std::uint32_t> level_ids_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(pleat) {
  emscripten::class_<Scene>("Scene")
      .constructor<std::string>()
      .function("fabrics", &Scene::fabrics)
      .function("steppers", &Scene::steppers)
      .function("parse", &Scene::parse)
      .function("studyResponse", &Scene::study_response)
      .function("readObj", &Scene::read_obj);
  emscripten::class_<Simulation>("Simulation")
      .constructor<std::string>()
      .function("load", &Simulation::load)
      .function("carryOver", &Simulation::carry_over)
      .function("startFrom", &Simulation::start_from)
      .function("reset", &Simulation::reset)
      .function("step", &Simulation::step)
      .function("status", &Simulation::status)
      .function("numbers", &Simulation::numbers)
      .function("setReference", &Simulation::set_reference)
      .function("colliders", &Simulation::colliders)
      .function("surfaces", &Simulation::surfaces)
      .function("grab", &Simulation::grab)
      .function("moveGrab", &Simulation::move_grab)
      .function("releaseGrab", &Simulation::release_grab)
      .function("positions", &Simulation::positions)
      .function("exactPositions", &Simulation::exact_positions)
      .function("masses", &Simulation::masses)
      .function("stretch", &Simulation::stretch)
      .function("distances", &Simulation::distances)
      .function("triangles", &Simulation::triangles)
      .function("openLedger", &Simulation::open_ledger)
      .function("closeLedger", &Simulation::close_ledger)
      .function("energies", &Simulation::energies)
      .function("springEnds", &Simulation::spring_ends)
      .function("implicitSprings", &Simulation::implicit_springs)
      .function("implicitShare", &Simulation::implicit_share)
      .function("makeLevels", &Simulation::make_levels)
      .function("levelVertices", &Simulation::level_vertices)
      .function("levelEdges", &Simulation::level_edges);
}
