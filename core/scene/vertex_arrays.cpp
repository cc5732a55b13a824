#include "core/scene/vertex_arrays.h"

#include "core/scene/scene.h"

namespace pleat {

VertexId read_vertex(const JsonReader& reader, std::int64_t n_vertices) {
  return VertexId(reader.integer(0, n_vertices - 1));
}

std::vector<VertexId> read_vertex_list(const JsonReader& reader, std::int64_t n_vertices) {
  std::vector<VertexId> vertices;
  for (const JsonReader& vertex : reader.elements())
    vertices.push_back(read_vertex(vertex, n_vertices));
  if (vertices.empty()) reader.fail("at least one vertex");
  return vertices;
}

Positions read_columns(const std::vector<JsonReader>& elements) {
  Positions columns(3, static_cast<Eigen::Index>(elements.size()));
  Eigen::Index column = 0;
  for (const JsonReader& element : elements) columns.col(column++) = element.vec3();
  return columns;
}

Positions read_positions(const JsonReader& reader) {
  const std::vector<JsonReader> elements = reader.elements();
  if (elements.empty() || static_cast<std::int64_t>(elements.size()) > kMaxVertices)
    reader.fail("1 to " + std::to_string(kMaxVertices) + " positions");
  return read_columns(elements);
}

Json json_columns(const Positions& columns) {
  Json json = Json::array();
  for (Eigen::Index column = 0; column < columns.cols(); ++column)
    json.push_back(json_vec3(columns.col(column)));
  return json;
}

}  // namespace pleat
