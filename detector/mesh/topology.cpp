#include "detector/mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "detector/mesh/for_all.h"
#include "detector/mesh/sort_by_key.h"

namespace assay::detector {
namespace {

// The work on a corner and on a triangle, in box tests.
constexpr std::uint64_t work_of_corner = 2, work_of_triangle = 3 * work_of_corner;

// Lists that are sorted by row, item after item: row_of(i) is the row of the item in place i, and
// ascends. Sets where each row starts.
template <class RowOf>
bool set_starts(std::size_t rows, std::size_t items, RowOf row_of,
                std::vector<std::int32_t>& starts, PacedStop& pace) {
  starts.resize(rows + 1);
  const auto fill = [&](std::size_t from, std::size_t to, std::size_t place) {
    for (; from < to; ++from) starts[from] = static_cast<std::int32_t>(place);
  };
  const auto start = [&](std::size_t i) { fill(i == 0 ? 0 : row_of(i - 1) + 1, row_of(i) + 1, i); };
  if (!for_all_paced(items, 1, pace, start)) return false;
  fill(items == 0 ? 0 : row_of(items - 1) + 1, rows + 1, items);
  return true;
}

// The triangles at each vertex, ascending.
bool find_triangles_of_vertices(Topology& mesh, std::size_t vertex_count, PacedStop& pace) {
  auto &starts = mesh.vertex_triangles.starts, &items = mesh.vertex_triangles.items;
  const auto vertex = [&](std::int32_t corner) {
    return mesh.triangles[at(corner / 3)][at(corner % 3)];
  };
  items.resize(3 * mesh.triangles.size());
  std::vector<std::int32_t> room;
  const auto number = [&](std::size_t i) { items[i] = static_cast<std::int32_t>(i); };
  return for_all_paced(items.size(), 1, pace, number) &&
         sort_by_key(items, room, vertex_count, vertex, &pace) &&
         set_starts(
             vertex_count, items.size(), [&](std::size_t i) { return at(vertex(items[i])); },
             starts, pace) &&
         for_all_paced(items.size(), 1, pace, [&](std::size_t i) { items[i] /= 3; });
}

// An edge of a triangle. Its corner fits into 31 bits, because meshes are limited for that
// (mesh_checks.h).
struct EdgeUse {
  std::array<std::int32_t, 2> edge;  // ascending
  std::int32_t corner;               // opposite to it: 3 times the triangle, and its place there
};

bool make_edges(Topology& mesh, std::size_t vertex_count, PacedStop& pace) {
  std::vector<EdgeUse> uses(3 * mesh.triangles.size()), room;
  const auto use = [&](std::size_t t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto u = mesh.triangles[t][(corner + 1) % 3];
      const auto v = mesh.triangles[t][(corner + 2) % 3];
      uses[3 * t + corner] = {{std::min(u, v), std::max(u, v)},
                              static_cast<std::int32_t>(3 * t + corner)};
    }
  };
  if (!for_all_paced(mesh.triangles.size(), work_of_triangle, pace, use)) return false;
  for (const std::size_t end : {1, 0}) {
    const auto vertex = [end](const EdgeUse& of) { return of.edge[end]; };
    if (!sort_by_key(uses, room, vertex_count, vertex, &pace)) return false;
  }
  room = {};
  const auto is_new = [&](std::size_t i) {
    return i == 0 || uses[i].edge[0] != uses[i - 1].edge[0] ||
           uses[i].edge[1] != uses[i - 1].edge[1];
  };
  // Each piece numbers its edges from where those before it end.
  constexpr std::size_t of_piece = 4096;
  std::vector<std::size_t> first((uses.size() + of_piece - 1) / of_piece, 0);
  const auto count = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) first[begin / of_piece] += is_new(i);
  };
  if (!for_all_pieces(uses.size(), of_piece, 1, &pace, count)) return false;
  std::size_t edges = 0;
  for (auto& of_piece_before : first) edges += std::exchange(of_piece_before, edges);
  mesh.edges.resize(edges);
  mesh.triangle_edges.resize(mesh.triangles.size());
  mesh.edge_triangles.items.resize(uses.size());
  mesh.edge_triangles.starts.resize(edges + 1);
  mesh.edge_triangles.starts[edges] = static_cast<std::int32_t>(uses.size());
  return for_all_pieces(uses.size(), of_piece, work_of_corner, &pace,
                        [&](std::size_t begin, std::size_t end, std::size_t) {
                          std::size_t next = first[begin / of_piece];
                          for (std::size_t i = begin; i < end; ++i) {
                            if (is_new(i)) {
                              mesh.edges[next] = uses[i].edge;
                              mesh.edge_triangles.starts[next++] = static_cast<std::int32_t>(i);
                            }
                            const auto corner = uses[i].corner;
                            mesh.edge_triangles.items[i] = corner / 3;
                            mesh.triangle_edges[at(corner / 3)][at(corner % 3)] =
                                static_cast<std::int32_t>(next) - 1;
                          }
                        });
}

std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t v) {
  while (parent[at(v)] != v) {
    parent[at(v)] = parent[at(parent[at(v)])];
    v = parent[at(v)];
  }
  return v;
}

bool make_components(Topology& mesh, std::size_t vertex_count, PacedStop& pace) {
  std::vector<std::int32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto join = [&](std::size_t t) {
    const auto& corners = mesh.triangles[t];
    for (std::size_t corner = 1; corner < 3; ++corner) {
      const auto a = root_of(parent, corners[0]), b = root_of(parent, corners[corner]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  };
  if (!for_each_paced(mesh.triangles.size(), work_of_triangle, pace, join)) return false;
  // Components are numbered by lowest vertex; vertices of no triangle belong to none.
  std::vector<std::int32_t> number(vertex_count, -1);
  struct Size {
    std::size_t vertices = 0, triangles = 0;
  };
  std::vector<Size> sizes;
  const auto row = [&](std::size_t v) {
    return mesh.vertex_triangles.row(static_cast<std::int32_t>(v));
  };
  const auto root = [&](std::int32_t v) { return at(root_of(parent, v)); };
  const auto number_vertex = [&](std::size_t v) {
    if (row(v).empty()) return;
    auto& c = number[root(static_cast<std::int32_t>(v))];
    if (c < 0) {
      c = static_cast<std::int32_t>(sizes.size());
      sizes.emplace_back();
    }
    ++sizes[at(c)].vertices;
  };
  if (!for_each_paced(vertex_count, work_of_triangle, pace, number_vertex)) return false;
  mesh.component_of_triangle.resize(mesh.triangles.size());
  const auto number_triangle = [&](std::size_t t) {
    mesh.component_of_triangle[t] = number[root(mesh.triangles[t][0])];
    ++sizes[at(mesh.component_of_triangle[t])].triangles;
  };
  if (!for_each_paced(mesh.triangles.size(), work_of_triangle, pace, number_triangle)) return false;
  mesh.components.reserve(sizes.size());
  const auto add_component = [&](std::size_t c) {
    auto& component = mesh.components.emplace_back();
    component.vertices.reserve(sizes[c].vertices);
    component.triangles.reserve(sizes[c].triangles);
  };
  const auto take_vertex = [&](std::size_t v) {
    if (row(v).empty()) return;
    const auto c = number[root(static_cast<std::int32_t>(v))];
    mesh.components[at(c)].vertices.push_back(static_cast<std::int32_t>(v));
  };
  const auto take_triangle = [&](std::size_t t) {
    mesh.components[at(mesh.component_of_triangle[t])].triangles.push_back(
        static_cast<std::int32_t>(t));
  };
  constexpr std::uint64_t work_of_room = 5;
  return for_each_paced(sizes.size(), work_of_room, pace, add_component) &&
         for_each_paced(vertex_count, work_of_triangle, pace, take_vertex) &&
         for_each_paced(mesh.triangles.size(), work_of_triangle, pace, take_triangle);
}

bool find_cycles(Topology& mesh, PacedStop& pace) {
  std::vector<std::int32_t> surplus;
  if (!count_surplus(mesh, surplus, pace)) return false;
  for (auto& component : mesh.components) component.is_cycle = true;
  return for_each_paced(surplus.size(), 1, pace, [&](std::size_t e) {
    if (surplus[e] == 0) return;
    const auto t = mesh.edge_triangles.row(static_cast<std::int32_t>(e)).front();
    mesh.components[at(mesh.component_of_triangle[at(t)])].is_cycle = false;
  });
}

}  // namespace

bool count_surplus(const Topology& mesh, std::vector<std::int32_t>& surplus, PacedStop& pace) {
  surplus.assign(mesh.edges.size(), 0);
  return for_each_paced(mesh.triangles.size(), work_of_triangle, pace, [&](std::size_t t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto u = mesh.triangles[t][(corner + 1) % 3];
      const auto v = mesh.triangles[t][(corner + 2) % 3];
      surplus[at(mesh.triangle_edges[t][corner])] += u < v ? 1 : -1;
    }
  });
}

Topology make_topology(const TrianglesView& triangles, Eigen::Index vertex_count) {
  PacedStop pace(never_stops);
  return make_topology(triangles, vertex_count, pace);
}

Topology make_topology(const TrianglesView& triangles, Eigen::Index vertex_count, PacedStop& pace) {
  Topology mesh;
  const auto vertices = static_cast<std::size_t>(vertex_count);
  mesh.triangles.resize(static_cast<std::size_t>(triangles.rows()));
  const auto copy = [&](std::size_t i) {
    const auto t = static_cast<Eigen::Index>(i);
    mesh.triangles[i] = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
  };
  // Each function needs what those before it have made.
  if (for_all_paced(mesh.triangles.size(), work_of_corner, pace, copy) &&
      make_edges(mesh, vertices, pace) && find_triangles_of_vertices(mesh, vertices, pace) &&
      make_components(mesh, vertices, pace)) {
    find_cycles(mesh, pace);
  }
  return mesh;
}

}  // namespace assay::detector
