// Deformed cloth for a page. Calls are as in bindings.cpp; a view dies when memory grows.
#include <emscripten/bind.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/deform/deform_settling.h"
#include "core/deform/deform_solver.h"
#include "core/scene/cloth/mesh_cloth.h"
#include "core/scene/deform/deform_scene.h"
#include "core/scene/format/scene_file.h"
#include "core/scene/vertex_place.h"
#include "wasm/arrays.h"
#include "wasm/envelope.h"

namespace {

using emscripten::val;
using pleat::DeformSolver;
using pleat::guarded;
using pleat::json_array;
using pleat::json_value;
using pleat::positions_in;
using pleat::VertexId;
using pleat::view_of;

/// Result of a step after a hand moved.
enum class Progress { moved = 0, ended = 1 };

/// Progress of a pane on its way to the least energy.
enum class Way { from_here = 0, between = 1, from_rest = 2, done = 3 };

val json_ids(const std::vector<VertexId>& vertices) {
  std::vector<double> ids;
  for (const VertexId v : vertices) ids.push_back(v.value);
  return json_array(ids);
}

val json_places(const pleat::Positions& places) {
  return json_array(std::vector<double>(places.data(), places.data() + places.size()));
}

/// Weights, measures or terms.
template <class Numbers>
val json_terms(const Numbers& numbers) {
  val result = val::object();
  result.set("recovery", numbers.recovery);
  result.set("stretch", numbers.stretch);
  result.set("bending", numbers.bending);
  return result;
}

val json_step(const pleat::DeformStep& step) {
  val result = val::object();
  result.set("energy", step.energy);
  result.set("terms", json_terms(step.terms));
  result.set("relative_step", step.relative_step);
  result.set("linearised", step.linearised);
  return result;
}

val json_handle(const pleat::DeformHandle& handle) {
  val result = val::object();
  result.set("name", handle.name);
  result.set("vertices", json_ids(handle.vertices));
  result.set("places_m", json_places(handle.targets));
  return result;
}

val json_group(const pleat::VertexGroup& group) {
  val result = val::object();
  result.set("name", group.name);
  result.set("vertices", json_ids(group.vertices));
  return result;
}

val json_ranges(const pleat::FittedWeights& fit) {
  val result = val::object();
  for (const auto& [name, value] : pleat::kMeasures)
    result.set(std::string(name),
               json_array(std::vector<double>{fit.measured_low.*value, fit.measured_high.*value}));
  return result;
}

template <class Element, class Json>
val json_list(const std::vector<Element>& elements, Json&& json) {
  val list = val::array();
  for (const Element& element : elements) list.call<void>("push", json(element));
  return list;
}

template <class Numbers>
Numbers three_numbers(const val& numbers) {
  return {numbers["recovery"].as<double>(), numbers["stretch"].as<double>(),
          numbers["bending"].as<double>()};
}

/// One cloth in several panes, each with weights of its own.
class Deformation {
 public:
  explicit Deformation(std::string fabrics_json)
      : fabrics_(pleat::read_fabrics(fabrics_json)), fit_(fabrics_.fabrics) {}

  /// Takes another cloth, without panes yet. A bad text leaves the present one.
  std::string open(const std::string& scene_text, const std::string& obj_text) {
    return guarded([&](val& envelope) {
      const auto file = [&](const std::string&) { return obj_text; };
      auto scene = pleat::read_deform_scene(scene_text, fabrics_, file);
      panes_.clear();
      scene_ = std::move(scene);
      triangles_.clear();
      for (const pleat::Triangle& t : scene_->mesh.triangles)
        for (const VertexId v : t) triangles_.push_back(static_cast<std::uint32_t>(v.value));
      const pleat::Positions& rest = scene_->mesh.rest_positions;
      envelope.set("name", scene_->name);
      envelope.set("caption", scene_->caption);
      envelope.set("n_vertices", scene_->mesh.n_vertices());
      envelope.set("n_triangles", scene_->mesh.triangles.size());
      envelope.set("rest_m", json_places(rest));
      envelope.set("grasp_m", pleat::usual_grasp(rest));
      envelope.set("groups", json_list(scene_->groups, json_group));
      envelope.set("pins", json_ids(scene_->pins));
      envelope.set("handles", json_list(scene_->handles, json_handle));
      envelope.set("fabric", scene_->fabric);
      envelope.set("skipped", scene_->remark);
    });
  }

  /// One pane for each of these weights. Those that are there keep their shape while the form of
  /// the energy stays; the others start at rest with nothing held.
  std::string show(const std::string& panes_text) {
    return guarded([&](val& envelope) {
      const val wanted = json_value(panes_text);
      const auto form = wanted["form"].as<std::string>() == "published"
                            ? pleat::EnergyForm::published
                            : pleat::EnergyForm::consistent;
      std::vector<pleat::DeformWeights> weights;
      for (const val& pane : emscripten::vecFromJSArray<val>(wanted["weights"])) {
        weights.push_back(three_numbers<pleat::DeformWeights>(pane));
        check(weights.back(), held_, places_);
      }
      if (form != scene_->form) panes_.clear();
      scene_->form = form;
      val fresh = val::array();
      while (panes_.size() > weights.size()) panes_.pop_back();
      for (std::size_t p = 0; p < weights.size(); ++p) {
        const bool is_fresh = p >= panes_.size();
        fresh.call<void>("push", is_fresh);
        if (is_fresh)
          panes_.push_back(std::make_unique<Pane>(DeformSolver(cloth().mesh, form, weights[p])));
        else
          panes_[p]->set_weights(weights[p]);
      }
      envelope.set("fresh", fresh);
    });
  }

  /// Holds these vertices, ascending, at these places [m] in all panes. Each pane takes it up in
  /// `follow`.
  std::string hold(const val& vertices, const val& places) {
    return guarded([&](val&) {
      std::vector<VertexId> held;
      for (const int v : emscripten::convertJSArrayToNumberVector<int>(vertices))
        held.emplace_back(v);
      const pleat::Positions at = positions_in(places);
      for (const auto& pane : panes_) check(pane->solver.weights(), held, at);
      held_ = std::move(held);
      places_ = at;
    });
  }

  /// Moves what is held, in the order of `hold` [m].
  void move_held(const val& places) {
    const pleat::Positions at = positions_in(places);
    if (at.cols() == places_.cols() && at.allFinite()) places_ = at;
  }

  /// The pane follows what holds it, in bounded time.
  std::string follow(int pane) {
    return guarded([&](val&) { held_as_all(pane).follow(places_); });
  }

  /// One step after the hand, with the factor at hand.
  int step(int pane) {
    try {
      DeformSolver& solver = at(pane).solver;
      const bool moves = solver.step(pleat::Linearise::never).ok() && !solver.converged();
      return static_cast<int>(moves ? Progress::moved : Progress::ended);
    } catch (const std::exception&) {
      return static_cast<int>(Progress::ended);
    }
  }

  /// The pane goes back to rest and comes from there to where it is held.
  std::string restart(int pane) {
    return guarded([&](val&) { held_as_all(pane).restart(places_); });
  }

  /// The pane is to find its least energy, by `settle`.
  std::string begin_settling(int pane, bool tries_rest) {
    return guarded([&](val&) {
      using Ways = pleat::DeformSettling::Ways;
      at(pane).end_settling();
      at(pane).settling.emplace(at(pane).solver,
                                tries_rest ? Ways::from_here_and_rest : Ways::from_here);
    });
  }

  /// One step towards it; one of Way.
  int settle(int pane) {
    try {
      auto& settling = at(pane).settling;
      if (settling) settling->step();
      Way way = Way::from_here;
      if (!settling || settling->done())
        way = Way::done;
      else if (settling->is_between())
        way = Way::between;
      else if (settling->is_on_trial())
        way = Way::from_rest;
      return static_cast<int>(way);
    } catch (const std::exception&) {
      return static_cast<int>(Way::done);
    }
  }

  std::string report(int pane) {
    return guarded([&](val& envelope) {
      const DeformSolver& solver = at(pane).solver;
      const pleat::DeformTerms terms = solver.terms();
      envelope.set("weights", json_terms(solver.weights()));
      envelope.set("energy", terms.weighted(solver.weights()));
      envelope.set("terms", json_terms(terms));
      envelope.set("converged", solver.converged());
      envelope.set("steps", json_list(solver.steps(), json_step));
    });
  }

  /// Weights for measurements of a visitor's own.
  std::string fit_measures(const std::string& measures_text) {
    return guarded([&](val& envelope) {
      const pleat::FittedWeights fit =
          fit_.fit(three_numbers<pleat::GeometricMeasures>(json_value(measures_text)));
      envelope.set("weights", json_terms(fit.weights));
      envelope.set("normalised", json_terms(fit.normalised));
      envelope.set("leave_one_out_error", json_terms(fit.leave_one_out_error));
      envelope.set("measured_range", json_ranges(fit));
      envelope.set("clamped",
                   json_array(std::vector<std::string>(fit.clamped.begin(), fit.clamped.end())));
      envelope.set("nearest", fabrics_.fabrics[fit.nearest].name);
    });
  }

  /// The section "cloth" of a scene in motion, with what is held as the group "held".
  std::string cloth_section() const {
    return guarded([&](val& envelope) {
      pleat::Scene scene;
      pleat::MeshCloth mesh;
      mesh.mesh = cloth().mesh;
      mesh.textures = cloth().textures;
      if (!held_.empty()) mesh.groups.push_back({"held", held_});
      scene.cloth = std::move(mesh);
      envelope.set("cloth", json_value(pleat::write_scene(scene))["cloth"]);
    });
  }

  val triangles() const { return view_of(triangles_); }
  val positions(int pane) {
    const pleat::Positions& x = at(pane).solver.positions();
    frame_.assign(x.data(), x.data() + x.size());
    return view_of(frame_);
  }
  /// Positions of the shape that counts, also while the way from rest is under way.
  val exact_positions(int pane) {
    at(pane).end_settling();
    return view_of(at(pane).solver.positions());
  }

 private:
  struct Pane {
    explicit Pane(DeformSolver with) : solver(std::move(with)) {}

    /// Drops a way from rest that is under way; called before anything else moves the solver.
    void end_settling() {
      if (settling) settling->end_trial();
      settling.reset();
    }

    void set_weights(const pleat::DeformWeights& weights) {
      end_settling();
      solver.set_weights(weights);
    }

    DeformSolver solver;
    std::optional<pleat::DeformSettling> settling;
  };

  const pleat::DeformScene& cloth() const {
    if (!scene_) throw pleat::InputError("", "expected an open cloth, got none");
    return *scene_;
  }

  Pane& at(int pane) {
    PLEAT_CHECK(pane >= 0 && pane < static_cast<int>(panes_.size()), "a pane that is shown");
    return *panes_[static_cast<std::size_t>(pane)];
  }

  /// Throws InputError where there is no one shape of least energy.
  void check(const pleat::DeformWeights& weights, const std::vector<VertexId>& held,
             const pleat::Positions& places) const {
    pleat::DeformScene scene = cloth();
    scene.pins.clear();
    scene.handles.clear();
    if (!held.empty()) scene.handles.push_back({"held", held, places});
    scene.fabric_weights = weights;
    scene.terms = {};
    check_deform_scene(scene);
  }

  DeformSolver& held_as_all(int pane) {
    at(pane).end_settling();
    DeformSolver& solver = at(pane).solver;
    if (solver.held() != held_) solver.hold(held_);
    return solver;
  }

  pleat::FabricLibrary fabrics_;
  pleat::MeasureFit fit_;
  std::optional<pleat::DeformScene> scene_;
  std::vector<std::unique_ptr<Pane>> panes_;
  std::vector<VertexId> held_;
  pleat::Positions places_;  // places of the held vertices [m]
  std::vector<float> frame_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(deform) {
  emscripten::class_<Deformation>("Deformation")
      .constructor<std::string>()
      .function("open", &Deformation::open)
      .function("show", &Deformation::show)
      .function("hold", &Deformation::hold)
      .function("moveHeld", &Deformation::move_held)
      .function("follow", &Deformation::follow)
      .function("step", &Deformation::step)
      .function("restart", &Deformation::restart)
      .function("beginSettling", &Deformation::begin_settling)
      .function("settle", &Deformation::settle)
      .function("report", &Deformation::report)
      .function("fitMeasures", &Deformation::fit_measures)
      .function("clothSection", &Deformation::cloth_section)
      .function("triangles", &Deformation::triangles)
      .function("positions", &Deformation::positions)
      .function("exactPositions", &Deformation::exact_positions);
}
