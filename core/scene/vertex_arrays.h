#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/files/json_reader.h"

namespace pleat {

/// A vertex by its number, below `n_vertices`.
VertexId read_vertex(const JsonReader& reader, std::int64_t n_vertices);

/// `n` different vertices.
template <std::size_t n>
std::array<VertexId, n> read_vertices(const JsonReader& reader, std::int64_t n_vertices) {
  std::array<VertexId, n> vertices;
  const std::vector<JsonReader> elements = reader.elements(n);
  for (std::size_t k = 0; k < n; ++k) {
    vertices[k] = read_vertex(elements[k], n_vertices);
    for (std::size_t other = 0; other < k; ++other)
      if (vertices[other] == vertices[k]) reader.fail(std::to_string(n) + " different vertices");
  }
  return vertices;
}

/// Reads at least one vertex, in the order of the file.
std::vector<VertexId> read_vertex_list(const JsonReader& reader, std::int64_t n_vertices);

/// 1 to kMaxVertices positions [m].
Positions read_positions(const JsonReader& reader);

/// One column for each vector.
Positions read_columns(const std::vector<JsonReader>& elements);
Json json_columns(const Positions& columns);

template <class Vertices>
Json json_vertices(const Vertices& vertices) {
  Json json = Json::array();
  for (const VertexId vertex : vertices) json.push_back(vertex.value);
  return json;
}

}  // namespace pleat
