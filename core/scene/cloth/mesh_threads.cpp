#include "core/scene/cloth/mesh_threads.h"

#include <algorithm>

#include "core/base/check.h"

namespace pleat {
namespace {

enum class RestShape { positions, texture };
constexpr std::array<Word<RestShape>, 2> kRestShapes{
    {{"positions", RestShape::positions}, {"texture", RestShape::texture}}};

/// Height over length; files often carry six digits.
constexpr double kSlimmest = 1e-6;

/// Twice the area of a triangle in the plane, positive when it is wound to the left.
double doubled_area(const CornerTexture& corners) {
  const Eigen::Vector2d a = corners.col(1) - corners.col(0);
  const Eigen::Vector2d b = corners.col(2) - corners.col(0);
  return a.x() * b.y() - a.y() * b.x();
}

bool has_area(const CornerTexture& corners) {
  const double longest = std::max({(corners.col(1) - corners.col(0)).squaredNorm(),
                                   (corners.col(2) - corners.col(1)).squaredNorm(),
                                   (corners.col(0) - corners.col(2)).squaredNorm()});
  return std::abs(doubled_area(corners)) > kSlimmest * longest;
}

/// The texture is x(s, t) = x0 + s S + t T in the triangle: its sides give S, the direction of s.
/// Zero when the texture has no area.
Vec3 texture_direction(const CornerTexture& texture, const Corners& x) {
  if (!has_area(texture)) return Vec3::Zero();
  const double t_of_a = texture(1, 1) - texture(1, 0);
  const double t_of_b = texture(1, 2) - texture(1, 0);
  return in_plane((t_of_b * (x[1] - x[0]) - t_of_a * (x[2] - x[0])) / doubled_area(texture), x);
}

/// Zero where neither texture nor vector says it.
Vec3 warp_direction(const std::optional<CornerTexture>& texture, const std::optional<Vec3>& vector,
                    const Corners& x) {
  Vec3 along = texture ? texture_direction(*texture, x) : Vec3(0, 0, 0);
  if (!along.isZero(0) || !vector) return along;
  const Vec3 nearest = in_plane(*vector, x);
  return nearest.isZero(0) ? in_plane(x[1] - x[0], x) : nearest;
}

}  // namespace

Corners corners_of(const TriangleMesh& mesh, const Triangle& t) {
  const Positions& x = mesh.rest_positions;
  return {x.col(t[0]), x.col(t[1]), x.col(t[2])};
}

Vec3 in_plane(const Vec3& direction, const Corners& x) {
  const Vec3 nearly = direction_in_plane(direction, x[0], x[1], x[2]);
  return direction_in_plane(nearly, x[0], x[1], x[2]);
}

void fill_warp_directions(TriangleMesh& mesh, const CornerTextures& textures,
                          const std::optional<Vec3>& vector, const TrianglePlace& place) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    mesh.warp_directions.push_back(
        warp_direction(textures[f], vector, corners_of(mesh, mesh.triangles[f])));
    if (mesh.warp_directions.back().isZero(0))
      throw InputError(place(f),
                       "expected texture coordinates with an area, or \"warp_direction\" in the "
                       "scene, to tell how the threads run, got neither");
  }
}

void check_cut(const CornerTexture& corners, const std::string& place) {
  if (!has_area(corners))
    throw InputError(place,
                     "expected a triangle with an area in the flat pattern, got one without");
  if (doubled_area(corners) < 0)
    throw InputError(place,
                     "expected a triangle wound alike in the mesh and in the flat pattern, got one "
                     "turned over there");
}

std::vector<CornerTexture> texture_pattern(const CornerTextures& textures, double scale,
                                           const TrianglePlace& place) {
  std::vector<CornerTexture> pattern;
  for (std::size_t f = 0; f < textures.size(); ++f) {
    if (!textures[f])
      throw InputError(place(f),
                       "expected texture coordinates, of which \"rest\": \"texture\" makes the "
                       "flat pattern, got none");
    pattern.push_back(scale * *textures[f]);
    check_cut(pattern.back(), place(f));
  }
  return pattern;
}

RestChoice read_rest(const JsonReader& reader) {
  RestChoice choice;
  if (const auto at = reader.find("rest"))
    choice.is_texture = at->word(kRestShapes) == RestShape::texture;
  const auto scale = reader.find("texture_scale_m");
  if (scale && !choice.is_texture) scale->fail("no such key without \"rest\": \"texture\"");
  if (scale) choice.scale = scale->number(kPositive);
  if (const auto warp = reader.find("warp_direction"); warp && choice.is_texture)
    warp->fail("no such key with \"rest\": \"texture\", which says how the threads run");
  return choice;
}

std::optional<Vec3> read_warp_vector(const JsonReader& reader, const std::optional<Vec3>& usual) {
  const auto at = reader.find("warp_direction");
  return at ? at->direction() : usual;
}

}  // namespace pleat
