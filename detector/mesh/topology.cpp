#include "detector/mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "detector/mesh/for_all.h"

namespace assay::detector {
namespace {

// The work on a corner and on a triangle, in box tests.
constexpr std::uint64_t work_of_corner = 2, work_of_triangle = 3 * work_of_corner;

// Lists the triangles at each vertex, ascending.
bool find_triangles_of_vertices(Topology& mesh, std::size_t vertex_count, PacedStop& pace) {
  const auto vertices = [&](std::size_t t) -> const auto& { return mesh.triangles[t]; };
  return list_by_row(mesh.triangles.size(), vertex_count, vertices, mesh.vertex_triangles, pace);
}

// A triangle's use of an edge, in the list of the edge's lower vertex: the higher vertex, the
// opposite corner (3 times the triangle, plus the place in it), whether the triangle passes the
// edge in descending direction and, once the list is sorted, whether this is the edge's first use.
// Corners have 31 bits, because meshes are limited for that (mesh_checks.h).
using EdgeUse = std::uint64_t;

namespace edge_use {
constexpr int descending_bits = 1, vertex_shift = 32, first_shift = 63;
constexpr EdgeUse of(std::int32_t higher, std::size_t corner, bool descends) {
  return static_cast<EdgeUse>(higher) << vertex_shift |
         static_cast<EdgeUse>(corner) << descending_bits | static_cast<EdgeUse>(descends);
}
constexpr bool descends(EdgeUse use) { return use & 1; }
constexpr bool is_first(EdgeUse use) { return use >> first_shift; }
constexpr auto corner(EdgeUse use) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(use) >> descending_bits);
}
}  // namespace edge_use

// The edges from some vertices to higher ones. All of their uses are in the triangles around these
// vertices, so only the few uses at each vertex are sorted. Edges are numbered as they come.
class EdgesOfVertices {
 public:
  EdgesOfVertices(Topology& mesh, std::int32_t begin, std::int32_t end) : mesh_(mesh) {
    const auto& around = mesh.vertex_triangles;
    uses_.reserve(at(around.starts[at(end)] - around.starts[at(begin)]));
    for (auto v = begin; v < end; ++v) collect(v, around.row(v));
  }

  // Numbers these edges and their uses from `edge` and `use` on, and sets both to the next free
  // numbers.
  void begin_at(std::size_t& edge, std::size_t& use) {
    first_edge_ = static_cast<std::int32_t>(std::exchange(edge, edge + count_));
    first_use_ = static_cast<std::int32_t>(std::exchange(use, use + uses_.size()));
  }

  void write() {
    auto place = first_use_, edge = first_edge_ - 1;
    std::int32_t surplus = 0;
    const auto end_edge = [&] {
      if (surplus != 0) unmatched.push_back({edge, surplus});
      surplus = 0;
    };
    for (const auto use : uses_) {
      const auto corner = edge_use::corner(use), t = corner / 3, i = corner % 3;
      if (edge_use::is_first(use)) {
        end_edge();
        ++edge;
        const auto& corners = mesh_.triangles[at(t)];
        const auto u = corners[at(i == 2 ? 0 : i + 1)], v = corners[at(i == 0 ? 2 : i - 1)];
        mesh_.edges[at(edge)] = {std::min(u, v), std::max(u, v)};
        mesh_.edge_triangles.starts[at(edge)] = place;
      }
      surplus += edge_use::descends(use) ? -1 : 1;
      mesh_.edge_triangles.items[at(place++)] = t;
      mesh_.triangle_edges[at(t)][at(i)] = edge;
    }
    end_edge();
  }

  std::vector<UnmatchedEdge> unmatched;
  bool may_repeat_triangles = false;

 private:
  void collect(std::int32_t v, std::span<const std::int32_t> around) {
    const auto first = static_cast<std::ptrdiff_t>(uses_.size());
    for (const auto t : around) {
      const auto& corners = mesh_.triangles[at(t)];
      const std::size_t i = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
      const std::size_t next = i == 2 ? 0 : i + 1, last = i == 0 ? 2 : i - 1;
      if (corners[next] > v) uses_.push_back(edge_use::of(corners[next], 3 * at(t) + last, false));
      if (corners[last] > v) uses_.push_back(edge_use::of(corners[last], 3 * at(t) + next, true));
    }
    std::sort(uses_.begin() + first, uses_.end());
    EdgeUse before = 0;  // no edge has vertex 0 for its higher one
    for (auto use = uses_.begin() + first; use != uses_.end(); ++use) {
      const EdgeUse higher = *use >> edge_use::vertex_shift;
      if (higher == std::exchange(before, higher)) {
        may_repeat_triangles |= !edge_use::is_first(use[-1]) || opposite(*use) == opposite(use[-1]);
        continue;
      }
      *use |= EdgeUse{1} << edge_use::first_shift;
      ++count_;
    }
  }

  std::int32_t opposite(EdgeUse use) const {
    const auto corner = at(edge_use::corner(use));
    return mesh_.triangles[corner / 3][corner % 3];
  }

  Topology& mesh_;
  std::vector<EdgeUse> uses_;
  std::size_t count_ = 0;
  std::int32_t first_edge_ = 0, first_use_ = 0;
};

// Makes the edges, in pieces, so that the uses of a piece are still in the fastest cache when it is
// written. The workers share a few pieces at a time.
bool make_edges(Topology& mesh, std::size_t vertex_count, PacedStop& pace) {
  constexpr std::size_t of_piece = 512, pieces_of_worker = 8;
  constexpr std::uint64_t work_of_vertex = 2 * work_of_triangle;
  const std::size_t at_once =
      of_piece * (has_workers(&pace) ? pieces_of_worker * pace.workers()->count() : 1);
  const std::size_t uses = 3 * mesh.triangles.size();
  mesh.triangle_edges.resize(mesh.triangles.size());
  mesh.edge_triangles.items.resize(uses);
  mesh.edges.reserve(uses / 2 + vertex_count / 16);  // a closed mesh has half as many
  mesh.edge_triangles.starts.reserve(uses / 2 + vertex_count / 16 + 1);
  std::vector<std::optional<EdgesOfVertices>> pieces(at_once / of_piece);
  std::size_t edges = 0, placed = 0;
  for (std::size_t first = 0; first < vertex_count; first += at_once) {
    const std::size_t count = std::min(at_once, vertex_count - first);
    const auto in_pieces = [&](auto body) {
      return for_all_pieces(count, of_piece, work_of_vertex, &pace,
                            [&](std::size_t begin, std::size_t end, std::size_t) {
                              body(pieces[begin / of_piece], begin, end);
                            });
    };
    if (!in_pieces([&](auto& piece, std::size_t begin, std::size_t end) {
          piece.emplace(mesh, static_cast<std::int32_t>(first + begin),
                        static_cast<std::int32_t>(first + end));
        })) {
      return false;
    }
    const auto used = std::span(pieces).first((count + of_piece - 1) / of_piece);
    for (auto& piece : used) piece->begin_at(edges, placed);
    mesh.edges.resize(edges);
    mesh.edge_triangles.starts.resize(edges + 1);
    if (!in_pieces([](auto& piece, std::size_t, std::size_t) { piece->write(); })) return false;
    for (const auto& piece : used) {
      mesh.unmatched.insert(mesh.unmatched.end(), piece->unmatched.begin(), piece->unmatched.end());
      mesh.may_repeat_triangles |= piece->may_repeat_triangles;
    }
  }
  mesh.edge_triangles.starts[edges] = static_cast<std::int32_t>(uses);
  return true;
}

std::int32_t root_of(LargeArray<std::int32_t>& parent, std::int32_t v) {
  while (parent[at(v)] != v) {
    parent[at(v)] = parent[at(parent[at(v)])];
    v = parent[at(v)];
  }
  return v;
}

// Makes the only component, which is the usual case: nothing has to be looked up. number: 0 for
// each of its `vertices` vertices.
bool make_only_component(Topology& mesh, const LargeArray<std::int32_t>& number,
                         std::size_t vertices, PacedStop& pace) {
  auto& all = mesh.components.emplace_back();
  all.triangles.resize(mesh.triangles.size());
  all.vertices.reserve(vertices);
  const auto take_triangle = [&](std::size_t t) {
    all.triangles[t] = static_cast<std::int32_t>(t);
  };
  const auto take_vertex = [&](std::size_t v) {
    if (number[v] == 0) all.vertices.push_back(static_cast<std::int32_t>(v));
  };
  return for_each_paced(all.triangles.size(), work_of_corner, pace, take_triangle) &&
         for_each_paced(number.size(), work_of_corner, pace, take_vertex);
}

bool make_components(Topology& mesh, std::size_t vertex_count, PacedStop& pace) {
  LargeArray<std::int32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto join = [&](std::size_t t) {
    const auto& corners = mesh.triangles[t];
    for (std::size_t corner = 1; corner < 3; ++corner) {
      if (parent[at(corners[0])] == parent[at(corners[corner])]) continue;  // the usual case
      const auto a = root_of(parent, corners[0]), b = root_of(parent, corners[corner]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  };
  if (!for_each_paced(mesh.triangles.size(), work_of_triangle, pace, join)) return false;
  // Components are numbered by lowest vertex; vertices of no triangle belong to none.
  LargeArray<std::int32_t> number(vertex_count, -1);
  struct Size {
    std::size_t vertices = 0, triangles = 0;
  };
  std::vector<Size> sizes;
  const auto number_vertex = [&](std::size_t v) {
    const auto vertex = static_cast<std::int32_t>(v);
    if (mesh.vertex_triangles.row(vertex).empty()) return;
    const auto root = root_of(parent, vertex);  // the lowest, so it is numbered before the others
    if (root == vertex) {
      number[v] = static_cast<std::int32_t>(sizes.size());
      sizes.emplace_back();
    }
    number[v] = number[at(root)];
    ++sizes[at(number[v])].vertices;
  };
  if (!for_each_paced(vertex_count, work_of_triangle, pace, number_vertex)) return false;
  mesh.component_of_triangle.assign(mesh.triangles.size(), 0);
  if (sizes.size() == 1) return make_only_component(mesh, number, sizes[0].vertices, pace);
  const auto number_triangle = [&](std::size_t t) {
    const auto c = number[at(mesh.triangles[t][0])];
    mesh.component_of_triangle[t] = c;
    ++sizes[at(c)].triangles;
  };
  if (!for_each_paced(mesh.triangles.size(), work_of_triangle, pace, number_triangle)) return false;
  mesh.components.reserve(sizes.size());
  const auto add_component = [&](std::size_t c) {
    auto& component = mesh.components.emplace_back();
    component.vertices.reserve(sizes[c].vertices);
    component.triangles.reserve(sizes[c].triangles);
  };
  const auto take_vertex = [&](std::size_t v) {
    if (number[v] < 0) return;
    mesh.components[at(number[v])].vertices.push_back(static_cast<std::int32_t>(v));
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

void find_cycles(Topology& mesh) {
  for (auto& component : mesh.components) component.is_cycle = true;
  for (const auto& [edge, surplus] : mesh.unmatched) {
    const auto t = mesh.edge_triangles.row(edge).front();
    mesh.components[at(mesh.component_of_triangle[at(t)])].is_cycle = false;
  }
}

}  // namespace

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
  // Each function needs the results of those before it.
  if (for_all_paced(mesh.triangles.size(), work_of_corner, pace, copy) &&
      find_triangles_of_vertices(mesh, vertices, pace) && make_edges(mesh, vertices, pace) &&
      make_components(mesh, vertices, pace)) {
    find_cycles(mesh);
  }
  return mesh;
}

}  // namespace assay::detector
