#include "detector/mesh/mesh_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

// Infinities and not-a-numbers have an exponent of all ones. Adding one to such an exponent, and
// to no other, carries into the place of the sign. The loop has no branch, so it is as fast as
// memory.
bool all_finite(const double* values, std::size_t count) {
  constexpr std::uint64_t exponent = 0x7ff0'0000'0000'0000, one = 0x0010'0000'0000'0000;
  std::uint64_t carries = 0;
  for (std::size_t i = 0; i < count; ++i) {
    carries |= (std::bit_cast<std::uint64_t>(values[i]) & exponent) + one;
  }
  return carries >> 63 == 0;
}

std::string at_triangle(Eigen::Index t) { return "triangle " + std::to_string(t); }

Problem stopped_at_checks() { return {InputError::stopped, "stopped while the mesh was checked"}; }

}  // namespace

std::optional<Problem> check_triangles(const TrianglesView& triangles, Eigen::Index vertex_count) {
  PacedStop pace(never_stops);
  auto problem = check_corners(triangles, vertex_count);
  return problem ? problem : check_repeated(triangles, vertex_count, pace);
}

std::optional<Problem> check_corners(const TrianglesView& triangles, Eigen::Index vertex_count) {
  if (triangles.rows() == 0) return Problem{InputError::no_triangles, "the mesh has no triangles"};
  if (triangles.rows() > most_triangles || vertex_count > most_vertices) {
    return Problem{InputError::mesh_too_large,
                   "the mesh has " + std::to_string(triangles.rows()) + " triangles and " +
                       std::to_string(vertex_count) + " vertices; the limits are " +
                       std::to_string(most_triangles) + " and " + std::to_string(most_vertices)};
  }
  std::optional<Eigen::Index> repeated;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::int32_t v = triangles(t, corner);
      if (v < 0 || v >= vertex_count) {
        return Problem{InputError::index_out_of_range,
                       at_triangle(t) + " names vertex " + std::to_string(v) +
                           ", but the mesh has " + std::to_string(vertex_count) + " vertices"};
      }
    }
    const auto a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    if (!repeated && (a == b || b == c || c == a)) repeated = t;
  }
  if (!repeated) return std::nullopt;
  return Problem{InputError::repeated_index, at_triangle(*repeated) + " names a vertex twice"};
}

// Compares triangles with the same lowest vertex, because those with the same three vertices have
// that.
std::optional<Problem> check_repeated(const TrianglesView& triangles, Eigen::Index vertex_count,
                                      PacedStop& pace) {
  const auto vertices = static_cast<std::size_t>(vertex_count);
  const auto lowest_of = [&](std::size_t i) {
    const auto t = static_cast<Eigen::Index>(i);
    return std::array{std::min({triangles(t, 0), triangles(t, 1), triangles(t, 2)})};
  };
  Incidence of_vertex;
  if (!list_by_row(static_cast<std::size_t>(triangles.rows()), vertices, lowest_of, of_vertex,
                   pace))
    return stopped_at_checks();
  std::vector<std::array<std::int32_t, 3>> others;  // the two other vertices, and the triangle
  for (std::int32_t v = 0; at(v) < vertices; ++v) {
    const auto row = of_vertex.row(v);
    if (row.size() < 2) continue;
    others.clear();
    for (const auto t : row) {
      const auto a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
      const auto highest = std::max({a, b, c});
      others.push_back({a ^ b ^ c ^ v ^ highest, highest, t});
    }
    std::sort(others.begin(), others.end());
    const auto same = std::adjacent_find(
        others.begin(), others.end(),
        [](const auto& p, const auto& q) { return p[0] == q[0] && p[1] == q[1]; });
    if (same != others.end()) {
      return Problem{InputError::same_vertices_twice, "triangles " + std::to_string(same[0][2]) +
                                                          " and " + std::to_string(same[1][2]) +
                                                          " have the same three vertices"};
    }
  }
  return std::nullopt;
}

std::optional<Problem> check_positions(const PositionsView& positions, Eigen::Index vertex_count) {
  if (positions.rows() != vertex_count) {
    return Problem{InputError::wrong_frame_size,
                   "positions have " + std::to_string(positions.rows()) +
                       " rows, but the mesh has " + std::to_string(vertex_count) + " vertices"};
  }
  const bool packed = positions.outerStride() == 3;
  if (packed && all_finite(positions.data(), static_cast<std::size_t>(positions.size()))) {
    return std::nullopt;
  }
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(positions(v, axis))) {
        return Problem{InputError::non_finite_coordinate,
                       "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
      }
    }
  }
  return std::nullopt;
}

namespace {

Problem wrong_relation(std::string message) {
  return {InputError::wrong_relation, std::move(message)};
}

Problem out_of_range(const char* name, std::int32_t index, Eigen::Index count) {
  return {InputError::index_out_of_range, std::string(name) + " " + std::to_string(index) +
                                              "; valid numbers are 0 to " +
                                              std::to_string(count - 1)};
}

std::optional<Problem> check_bodies(const CountedPairs& counted, const TrianglesView& triangles,
                                    Eigen::Index vertex_count) {
  const auto& body = counted.body;
  if (!body.empty() && static_cast<Eigen::Index>(body.size()) != vertex_count) {
    return Problem{InputError::wrong_frame_size,
                   "bodies are given for " + std::to_string(body.size()) +
                       " vertices, but the mesh has " + std::to_string(vertex_count) + " vertices"};
  }
  std::int32_t bodies = 1;
  for (const auto b : body) {
    if (b < 0 || b >= vertex_count) return out_of_range("a vertex is in body", b, vertex_count);
    bodies = std::max(bodies, b + 1);
  }
  for (const auto& pair : counted.apart) {
    for (const auto b : pair) {
      if (b < 0 || b >= bodies) return out_of_range("a pair of bodies names body", b, bodies);
    }
  }
  for (Eigen::Index t = 0; !body.empty() && t < triangles.rows(); ++t) {
    const auto a = body[at(triangles(t, 0))];
    if (a == body[at(triangles(t, 1))] && a == body[at(triangles(t, 2))]) continue;
    return Problem{InputError::triangle_of_two_bodies, at_triangle(t) + " belongs to two bodies"};
  }
  return std::nullopt;
}

std::optional<Problem> check_rest(const CountedPairs& counted, Eigen::Index vertex_count) {
  if (!std::isfinite(counted.rest_distance) || counted.rest_distance < 0)
    return wrong_relation("`rest_distance` is negative or not finite");
  const bool may_be_empty = counted.rest_distance == 0;
  if (counted.rest.empty() && may_be_empty) return std::nullopt;
  if (static_cast<Eigen::Index>(counted.rest.size()) != vertex_count) {
    return Problem{InputError::wrong_frame_size,
                   "places at rest are given for " + std::to_string(counted.rest.size()) +
                       " vertices, but the mesh has " + std::to_string(vertex_count) + " vertices"};
  }
  for (std::size_t v = 0; v < counted.rest.size(); ++v) {
    const Point& x = counted.rest[v];
    if (std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); })) continue;
    return Problem{InputError::non_finite_coordinate,
                   "vertex " + std::to_string(v) + " has a coordinate at rest that is not finite"};
  }
  return std::nullopt;
}

using SortedEdge = std::array<std::int32_t, 2>;

SortedEdge sorted_edge(std::int32_t u, std::int32_t v) { return {std::min(u, v), std::max(u, v)}; }

std::optional<Problem> check_edge_pairs(const std::vector<TwoEdges>& pairs,
                                        const TrianglesView& triangles, Eigen::Index vertex_count) {
  if (pairs.empty()) return std::nullopt;
  std::vector<SortedEdge> edges;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k)
      edges.push_back(sorted_edge(triangles(t, k), triangles(t, (k + 1) % 3)));
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& pair : pairs) {
    for (const auto& [u, v] : {pair.a, pair.b}) {
      for (const auto end : {u, v}) {
        if (end < 0 || end >= vertex_count)
          return out_of_range("a pair of edges names vertex", end, vertex_count);
      }
      if (std::binary_search(edges.begin(), edges.end(), sorted_edge(u, v))) continue;
      return wrong_relation("a pair of edges names the edge of vertices " + std::to_string(u) +
                            " and " + std::to_string(v) + ", but the mesh has no such edge");
    }
  }
  return std::nullopt;
}

std::optional<Problem> check_lists(const CountedPairs& counted, const TrianglesView& triangles,
                                   Eigen::Index vertex_count) {
  const bool of_features = counted.level == CountedLevel::features;
  const bool lists_triangles = !counted.triangle_pairs.empty(),
             lists_features = !counted.vertex_faces.empty() || !counted.edge_pairs.empty();
  if (of_features ? lists_triangles : lists_features) {
    return wrong_relation(of_features ? "triangle pairs are listed, but `level` is `features`"
                                      : "feature pairs are listed, but `level` is `triangles`");
  }
  for (const auto& [a, b] : counted.triangle_pairs) {
    for (const auto t : {a, b}) {
      if (t < 0 || t >= triangles.rows())
        return out_of_range("a pair of triangles names triangle", t, triangles.rows());
    }
    if (a == b) return wrong_relation(at_triangle(a) + " is paired with itself");
  }
  for (const auto& [v, face] : counted.vertex_faces) {
    if (v < 0 || v >= vertex_count) return out_of_range("a pair names vertex", v, vertex_count);
    if (face < 0 || face >= triangles.rows())
      return out_of_range("a pair names triangle", face, triangles.rows());
  }
  return check_edge_pairs(counted.edge_pairs, triangles, vertex_count);
}

}  // namespace

std::optional<Problem> check_counted_pairs(const CountedPairs& counted,
                                           const TrianglesView& triangles,
                                           Eigen::Index vertex_count) {
  if (auto problem = check_bodies(counted, triangles, vertex_count)) return problem;
  if (counted.rings < 0) return wrong_relation("the number of rings is negative");
  if (auto problem = check_rest(counted, vertex_count)) return problem;
  return check_lists(counted, triangles, vertex_count);
}

}  // namespace assay::detector
