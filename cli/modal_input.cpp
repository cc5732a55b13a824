#include "cli/modal_input.h"

#include "cli/mesh_input.h"
#include "core/base/check.h"
#include "core/files/json_text.h"
#include "core/modal/key_faces.h"

namespace pleat {
namespace {

constexpr int kMostModes = 1000;

}  // namespace

KeySurfaces take_keys(Arguments& arguments) {
  KeySurfaces keys;
  std::string file = arguments.word("an OBJ file");
  keys.mesh = read_mesh(file);
  keys.positions.push_back(keys.mesh.positions);
  keys.files.emplace_back(file);
  while (arguments.has_words()) {
    file = arguments.word("an OBJ file");
    const ObjMesh mesh = read_mesh(file);
    try {
      check_key_faces(keys.mesh.positions.cols(), keys.mesh.triangles, mesh.positions.cols(),
                      mesh.triangles);
    } catch (const InputError& error) {
      throw InputError(file, error.what());
    }
    keys.positions.push_back(mesh.positions);
    keys.files.emplace_back(file);
  }
  return keys;
}

std::optional<int> take_mode_count(Arguments& arguments) {
  return arguments.whole_number("--modes", 1, kMostModes);
}

ModalOptions take_volume_options(Arguments& arguments) {
  ModalOptions options;
  if (const auto kind = arguments.text("--volume")) {
    if (*kind == "lattice")
      options.volume = VolumeKind::lattice;
    else if (*kind == "shell")
      options.volume = VolumeKind::shell;
    else
      throw InputError("--volume", "expected lattice or shell, got " + cut(*kind));
  }
  if (const auto size = arguments.text("--size"))
    options.size = parse_positive_number(*size, "--size");
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
  if (const auto beyond = arguments.text("--detail-beyond"))
    options.detail_beyond = parse_number_from_zero(*beyond, "--detail-beyond");
  return options;
}

}  // namespace pleat
