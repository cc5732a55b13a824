#include "native-tests/support/small_scene.h"

#include <algorithm>

namespace pleat {
namespace fs = std::filesystem;

const char* const kSmallScene = R"({
  "name": "small sheet",
  "cloth": {"sheet": {"columns": 2, "rows": 2, "warp_direction": [0, 0, 1]}},
  "fabric": {"name": "fine cotton"},
  "pins": [{"part": "upper_edge"}],
  "method": {"step_s": 0.02, "solver": "eigen"},
  "record": {"every_s": 0.04, "format": "binary"},
  "duration_s": 0.2
})";

// Drag grows with the square of the speed, which the explicit method's stability bound does not
// cover: in dense enough air each step throws the triangle back faster than it came.
const char* const kWildScene = R"({
  "cloth": {"particles": {
    "positions_m": [[0, 0, 0], [1, 0, 0], [0, 0, 1]],
    "velocities_m_per_s": [[0, 1, 0], [0, 1, 0], [0, 1, 0]],
    "masses_kg": [0.1, 0.1, 0.1],
    "springs": [{"a": 0, "b": 1, "stiffness_n_per_m": 1}],
    "triangles": [[0, 1, 2]]}},
  "method": {"stepper": "explicit", "step_s": 0.016666666666666666, "substeps": 1},
  "world": {"air": {"density_kg_per_m3": 10000}},
  "duration_s": 1,
  "record": {"every_s": 0.01, "format": "binary"}
})";

std::string scene_with(const std::string& from, const std::string& to) {
  std::string text = kSmallScene;
  return text.replace(text.find(from), from.size(), to);
}

SmallScene::SmallScene(const std::string& text) { write(file, text); }

Ending SmallScene::run(std::vector<std::string> words) const {
  words.insert(words.begin() + 1, file);
  return pleat_command(folder, words);
}

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) texts[entry.path().string()] = text_of(entry.path());
  return texts;
}

std::ptrdiff_t n_lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace pleat
