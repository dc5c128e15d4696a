#include "properties/worker/plugin/query_case.h"

#include "properties/numbering.h"

namespace assay::properties {
namespace {

constexpr const char* query_option = "query";
constexpr const char* vertex_face_word = "vertex-face";
constexpr const char* edge_edge_word = "edge-edge";
constexpr int vertices_of_a_query = 4;

Triangles triangles_of_queries() {
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 3, 2;
  return triangles;
}

}  // namespace

Feature features_of(const FourPoints& query) {
  const auto kind = query.first_group == 1 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
  return {kind, {0, 1, 2, 3, -1}};
}

const char* query_word(const FourPoints& query) {
  return query.first_group == 1 ? vertex_face_word : edge_edge_word;
}

Case case_of_query(const FourPoints& query, std::string id) {
  Case c;
  c.id = std::move(id);
  c.triangles = triangles_of_queries();
  c.options[query_option] = query_word(query);
  std::vector<Point> from, to;
  for (const auto& [t0, t1] : query.points) from.push_back(t0), to.push_back(t1);
  c.frames = {as_rows<Positions>(from), as_rows<Positions>(to)};
  return c;
}

std::string query_word(const Case& c) {
  const auto word = c.options.find(query_option);
  return word == c.options.end() ? "" : word->second;
}

void say_query(Case& c, const std::string& word) {
  if (!word.empty()) c.options[query_option] = word;
}

bool says_query(const Case& c) { return c.options.contains(query_option); }

std::optional<FourPoints> query_of(const Case& c) {
  const std::string word = query_word(c);
  const bool is_vertex_face = word == vertex_face_word;
  if (!is_vertex_face && word != edge_edge_word) return std::nullopt;
  const Triangles triangles = triangles_of_queries();
  if (c.triangles.rows() != triangles.rows() || c.triangles != triangles) return std::nullopt;
  const auto steps = steps_of(c);
  if (steps.size() != 1) return std::nullopt;
  const auto &x_t0 = start_of(c, steps[0]), &x_t1 = end_of(c, steps[0]);
  if (x_t0.rows() != vertices_of_a_query) return std::nullopt;
  FourPoints query;
  query.first_group = is_vertex_face ? 1 : 2;
  for (int v = 0; v < vertices_of_a_query; ++v)
    query.points[static_cast<std::size_t>(v)] = SteppedMesh{x_t0, x_t1}.path(v);
  return query;
}

}  // namespace assay::properties
