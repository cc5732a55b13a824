#include <algorithm>

#include "core/base/check.h"
#include "core/files/obj_file.h"
#include "core/scene/format/start_section.h"

namespace pleat {
namespace {

std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// The faces tell a file of this cloth from one of as many vertices in another order. A quad may be
/// cut along either diagonal.
void expect_faces_of(const Scene& scene, int level, const ObjMesh& mesh) {
  const RestCloth cloth = scene.cloth->at_rest(level);
  const std::vector<Triangle> known =
      sorted(cloth.quads ? cloth.quads->crossed_triangles() : cloth.mesh.triangles);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle face = sorted({mesh.triangles[f]}).front();
    if (!std::binary_search(known.begin(), known.end(), face))
      throw InputError(
          "line " + std::to_string(mesh.lines[f]),
          "expected a face of this cloth, got one of vertices that have none together");
  }
}

}  // namespace

// JSON begins with a brace, OBJ never.
StartState read_start_or_obj(const JsonReader& reader, const FileSource& files,
                             const Scene& scene) {
  if (!reader.is_text() || !files) return read_start(reader, files, scene);
  std::optional<StartState> start;
  read_named_file(reader, files, [&](const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || text[first] != '{') {
      const ObjMesh mesh = read_obj(text);
      start = of_this_cloth("", {mesh.positions, {}, 0}, scene);
      expect_faces_of(scene, start->level, mesh);
    }
    return 0;
  });
  return start ? *std::move(start) : read_start(reader, files, scene);
}

}  // namespace pleat
