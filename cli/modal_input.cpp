#include "cli/modal_input.h"

#include "cli/source.h"
#include "core/modal/key_faces.h"

namespace pleat {
namespace {

constexpr int kMostModes = 1000;

}  // namespace

KeySurfaces take_keys(Arguments& arguments) {
  KeySurfaces keys;
  do {
    const std::string file = arguments.word("an OBJ file");
    ObjMesh mesh = read_mesh(file);
    if (keys.files.empty()) keys.mesh = mesh;
    with_source_named(Source{file}, [&] {
      check_key_faces(keys.mesh.positions.cols(), keys.mesh.triangles, mesh.positions.cols(),
                      mesh.triangles);
    });
    keys.positions.push_back(std::move(mesh.positions));
    keys.files.emplace_back(file);
  } while (arguments.has_words());
  return keys;
}

std::optional<int> take_mode_count(Arguments& arguments) {
  return arguments.whole_number("--modes", 1, kMostModes);
}

ModalOptions take_volume_options(Arguments& arguments) {
  ModalOptions options;
  options.volume = arguments.choice(
      "--volume", options.volume, {{"lattice", VolumeKind::lattice}, {"shell", VolumeKind::shell}});
  options.size = arguments.number("--size").value_or(options.size);
  return options;
}

ModalOptions take_completion_options(Arguments& arguments) {
  ModalOptions options = take_volume_options(arguments);
  options.n_modes = take_mode_count(arguments).value_or(options.n_modes);
  options.n_functions = arguments.whole_number("--functions", kAffineFunctions, kMostModes)
                            .value_or(options.n_functions);
  options.n_clusters =
      arguments.whole_number("--clusters", 1, kMostModes).value_or(options.n_clusters);
  options.exact_keys = arguments.flag("--exact-keys");
  options.detail_beyond =
      arguments.number("--detail-beyond", Numbers::not_negative).value_or(options.detail_beyond);
  return options;
}

}  // namespace pleat
