// Modes and key shapes for a page. Calls are as in bindings.cpp; a view dies when memory grows.
#include <emscripten/bind.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/files/fabric_file.h"
#include "core/files/obj_file.h"
#include "core/modal/box_surface.h"
#include "core/modal/cloth_modes.h"
#include "core/modal/frame_measures.h"
#include "core/modal/key_completion.h"
#include "core/modal/key_faces.h"
#include "core/modal/shown_modes.h"
#include "core/run/simulation.h"
#include "core/scene/format/scene_file.h"
#include "core/sweep/completion_cost.h"
#include "wasm/arrays.h"
#include "wasm/envelope.h"

namespace {

using emscripten::val;
using pleat::guarded;
using pleat::InputError;
using pleat::json_array;
using pleat::json_value;
using pleat::Positions;
using pleat::positions_in;
using pleat::view_of;

template <class Numbers>
val json_numbers(const Numbers& numbers) {
  return json_array(std::vector<double>(numbers.data(), numbers.data() + numbers.size()));
}

pleat::ModalOptions options_in(const val& wanted) {
  pleat::ModalOptions options;
  options.n_modes = wanted["modes"].as<int>();
  if (wanted.hasOwnProperty("size_m")) options.size = wanted["size_m"].as<double>();
  const auto volume = wanted["volume"].as<std::string>();
  if (volume == "lattice") options.volume = pleat::VolumeKind::lattice;
  if (volume == "shell") options.volume = pleat::VolumeKind::shell;
  return options;
}

/// One surface, or one cloth of a scene, its modes and its key shapes.
class ModalStudy {
 public:
  explicit ModalStudy(std::string fabrics_json) : fabrics_json_(std::move(fabrics_json)) {}

  /// A closed box: {"sides_m": [x, y, z], "cells": n}.
  std::string open_box(const std::string& box_text) {
    return guarded([&](val& envelope) {
      const val wanted = json_value(box_text);
      const pleat::Vec3 sides(wanted["sides_m"][0].as<double>(), wanted["sides_m"][1].as<double>(),
                              wanted["sides_m"][2].as<double>());
      pleat::BoxSurface box = pleat::box_surface(sides, wanted["cells"].as<int>());
      take(std::move(box.positions), box.triangles, envelope);
    });
  }

  std::string open_obj(const std::string& obj_text) {
    return guarded([&](val& envelope) {
      const pleat::ObjMesh mesh = pleat::read_obj(obj_text);
      take(mesh.positions, mesh.triangles, envelope);
      envelope.set("skipped", pleat::skipped_sentence(mesh.skipped));
    });
  }

  /// A key shape of the present surface, from a file of its own.
  std::string read_key(const std::string& obj_text) {
    return guarded([&](val&) {
      const pleat::ObjMesh mesh = pleat::read_obj(obj_text);
      pleat::check_key_faces(shape_.cols(), triangles_, mesh.positions.cols(), mesh.triangles);
      key_ = mesh.positions;
    });
  }

  /// The cloth of a scene, where it begins.
  std::string open_scene(const std::string& scene_text) {
    return guarded([&](val& envelope) {
      const pleat::Scene scene = pleat::read_scene(scene_text, pleat::read_fabrics(fabrics_json_));
      auto run = std::make_unique<pleat::Simulation>(scene);
      take(run->rest_positions(), run->triangles(), envelope);
      run_ = std::move(run);
      std::vector<double> pins;
      for (const pleat::Pin& pin : run_->model().pins) pins.push_back(pin.vertex.value);
      envelope.set("pins", json_array(pins));
      envelope.set("step_s", scene.method.step);
    });
  }

  /// So many steps of the scene. The shape is the one that it has come to.
  std::string run(int steps) {
    return guarded([&](val& envelope) {
      pleat::Simulation& running = simulation();
      for (int s = 0; s < steps; ++s) {
        const pleat::SolveReport report = running.step();
        if (report.ends_run()) throw InputError("", "the cloth's run ended: " + report.message);
      }
      shape_ = running.state().positions;
      envelope.set("time_s", running.time());
      envelope.set("speed_m_per_s", running.state().velocities.colwise().norm().maxCoeff());
    });
  }

  /// Modes about the present shape: {"energy": "volume" | "surface" | "cloth", "count", "volume",
  /// "size_m"}.
  std::string find_modes(const std::string& wanted_text) {
    return guarded([&](val& envelope) {
      const val wanted = json_value(wanted_text);
      const auto energy = wanted["energy"].as<std::string>();
      const int count = wanted["modes"].as<int>();
      pleat::SurfaceModes found;
      if (energy == "cloth")
        found = pleat::whole_surface_modes(cloth_modes(count));
      else if (energy == "surface")
        found = pleat::surface_modes(shape_, triangles_, count);
      else
        found = pleat::volume_surface_modes(shape_, triangles_, options_in(wanted));
      moves_ = found.moves.cast<float>();
      envelope.set("stiffness", json_numbers(found.stiffness));
      envelope.set("rigid", found.n_rigid);
      envelope.set("tets", found.n_tets);
    });
  }

  /// Prepares frames between key shapes, which `places` [m] has one after the other: {"keys": n,
  /// "modes", "volume", "size_m"}.
  std::string complete(const val& places, const std::string& wanted_text) {
    return guarded([&](val& envelope) {
      const val wanted = json_value(wanted_text);
      const Positions all = positions_in(places);
      const auto n_keys = wanted["keys"].as<Eigen::Index>();
      if (n_keys < 0 || all.cols() != n_keys * shape_.cols())
        throw InputError("", "expected a place for each vertex of each key");
      frames_.clear();
      std::vector<Positions> keys;
      for (Eigen::Index k = 0; k < n_keys; ++k)
        keys.emplace_back(all.middleCols(k * shape_.cols(), shape_.cols()));
      completion_ = std::make_unique<pleat::KeyCompletion>(keys, triangles_, options_in(wanted));
      put_volume(envelope);
    });
  }

  /// Another shape for a key; modes and space stay.
  std::string replace_key(int index, const val& places) {
    return guarded([&](val&) {
      const pleat::SolveReport report = completed().replace_key(index, positions_in(places));
      if (report.ends_run()) throw InputError("", "the key's volume: " + report.message);
    });
  }

  /// The frames, at least the keys, and their curves.
  std::string fill_in(int count) {
    return guarded([&](val& envelope) {
      frames_ = completed().frames(count);
      const auto measures = pleat::frame_measures(completed(), frames_);
      const auto straight = pleat::linear_measures(completed(), frames_);
      val frames = val::array();
      filled_.resize(3, shape_.cols() * static_cast<Eigen::Index>(frames_.size()));
      for (std::size_t f = 0; f < frames_.size(); ++f) {
        filled_.middleCols(static_cast<Eigen::Index>(f) * shape_.cols(), shape_.cols()) =
            completed().surface(frames_[f]);
        val frame = val::object();
        frame.set("time", frames_[f].time);
        frame.set("left", frames_[f].left);
        frame.set("share_of_next", frames_[f].share_of_next);
        frame.set("unequal_halves", measures[f].unequal_halves);
        frame.set("volume_m3", measures[f].volume);
        frame.set("straight_volume_m3", straight[f].volume);
        frame.set("strain", measures[f].strain);
        frame.set("straight_strain", straight[f].strain);
        frames.call<void>("push", frame);
      }
      envelope.set("frames", frames);
    });
  }

  /// How much of the filled-in motion is in the first modes of the first key's volume.
  std::string volume_shares() {
    return guarded([&](val& envelope) {
      envelope.set("shares", json_numbers(pleat::volume_motion_shares(completed(), frames_)));
    });
  }

  /// How much of a cloth's motion through these shapes, one after the other [m], is in the first
  /// modes of its own stiffness about the present shape.
  std::string cloth_shares(const val& places, int count) {
    return guarded([&](val& envelope) {
      const Positions all = positions_in(places);
      std::vector<Positions> frames;
      for (Eigen::Index at = 0; at + shape_.cols() <= all.cols(); at += shape_.cols())
        frames.emplace_back(all.middleCols(at, shape_.cols()));
      envelope.set("shares", json_numbers(pleat::motion_shares(
                                 cloth_modes(count), simulation().model().masses, shape_, frames)));
    });
  }

  val triangles() const { return view_of(corners_); }
  /// The shape that modes are about.
  val shape() const { return view_of(shape_); }
  /// The shape that readKey found.
  val key() const { return view_of(key_); }
  /// Moves of each mode beside the rigid ones; its farthest vertex moves by 1.
  val moves() const { return view_of(moves_); }
  /// Surfaces of all frames, one after the other.
  val filled() const { return view_of(filled_); }

 private:
  void take(Positions positions, const std::vector<pleat::Triangle>& triangles, val& envelope) {
    run_.reset();
    completion_.reset();
    frames_.clear();
    shape_ = std::move(positions);
    triangles_ = triangles;
    corners_.clear();
    for (const pleat::Triangle& t : triangles_)
      for (const pleat::VertexId v : t) corners_.push_back(static_cast<std::uint32_t>(v.value));
    envelope.set("n_vertices", shape_.cols());
    envelope.set("n_triangles", triangles_.size());
    envelope.set("closed", pleat::is_closed(triangles_));
  }

  pleat::Simulation& simulation() const {
    if (!run_) throw InputError("", "expected the cloth of a scene, which this is not");
    return *run_;
  }

  pleat::KeyCompletion& completed() const {
    if (!completion_) throw InputError("", "expected key shapes, got none yet");
    return *completion_;
  }

  pleat::Modes cloth_modes(int count) const {
    pleat::Modes modes;
    const pleat::SolveReport report =
        pleat::cloth_modes(simulation().model(), shape_, {}, count, modes);
    if (report.ends_run()) throw InputError("", "the cloth's modes: " + report.message);
    return modes;
  }

  void put_volume(val& envelope) const {
    int n_tets = 0;
    for (const pleat::ModalBody& body : completed().bodies())
      n_tets += static_cast<int>(body.carrying().volume.tets.size());
    envelope.set("tets", n_tets);
    envelope.set("bodies", completed().bodies().size());
  }

  std::string fabrics_json_;
  std::unique_ptr<pleat::Simulation> run_;
  Positions shape_;
  std::vector<pleat::Triangle> triangles_;
  std::vector<std::uint32_t> corners_;
  Positions key_;
  Eigen::MatrixXf moves_;  // 3 n x modes
  std::unique_ptr<pleat::KeyCompletion> completion_;
  std::vector<pleat::KeyCompletion::Frame> frames_;
  Positions filled_;
};

/// Cost here of so many frames between keys, OBJ texts of one mesh, with the usual options; told
/// with the keys of `pleat bench inbetween`.
std::string completion_cost(const val& obj_texts, int n_frames) {
  return guarded([&](val& envelope) {
    std::vector<Positions> keys;
    std::vector<pleat::Triangle> triangles;
    for (const auto& text : emscripten::vecFromJSArray<std::string>(obj_texts)) {
      const pleat::ObjMesh mesh = pleat::read_obj(text);
      keys.push_back(mesh.positions);
      triangles = mesh.triangles;
    }
    const pleat::CompletionCost cost = pleat::completion_cost(keys, triangles, {}, n_frames);
    envelope.set("n_vertices", keys.front().cols());
    envelope.set("n_volume_vertices", cost.n_volume_vertices);
    envelope.set("n_keys", keys.size());
    envelope.set("precompute_ms", cost.precompute_ms);
    envelope.set("middles_ms", cost.middles_ms);
    envelope.set("middle_ms", cost.middles_ms / std::max(1, cost.n_middles));
    envelope.set("surfaces_ms", cost.surfaces_ms);
    envelope.set("unconverged", cost.n_unconverged);
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(modal) {
  emscripten::function("completionCost", &completion_cost);
  emscripten::class_<ModalStudy>("ModalStudy")
      .constructor<std::string>()
      .function("openBox", &ModalStudy::open_box)
      .function("openObj", &ModalStudy::open_obj)
      .function("readKey", &ModalStudy::read_key)
      .function("openScene", &ModalStudy::open_scene)
      .function("run", &ModalStudy::run)
      .function("findModes", &ModalStudy::find_modes)
      .function("complete", &ModalStudy::complete)
      .function("replaceKey", &ModalStudy::replace_key)
      .function("fillIn", &ModalStudy::fill_in)
      .function("volumeShares", &ModalStudy::volume_shares)
      .function("clothShares", &ModalStudy::cloth_shares)
      .function("triangles", &ModalStudy::triangles)
      .function("shape", &ModalStudy::shape)
      .function("key", &ModalStudy::key)
      .function("moves", &ModalStudy::moves)
      .function("filled", &ModalStudy::filled);
}
