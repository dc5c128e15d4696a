// Moves of a mesh: of its triangles, and of their connections.
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "oracle/mesh/mesh_features.h"
#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "properties/search/moves.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using Row = Eigen::RowVector3d;

// Returns whether the mesh may be changed: a relation and ghosts speak of its numbers.
bool is_plain(const Case& c) { return !c.counted && !c.ghosts; }

// Edits a triangle: changes a corner, doubles it in its place, flips it, or drops it.
void edit_mesh(Random& random, Candidate& child, const MoveContext&) {
  if (!is_plain(child.c)) return;
  auto triangles = triangles_of(child.c);
  const int kind = random.below(6);
  auto& one = one_of(random, triangles);
  Case edited = child.c;
  if (kind == 0) {
    std::swap(one[1], one[2]);
    edited = with_triangles(child.c, triangles);
  } else if (kind == 1) {
    for (auto& t : triangles) std::swap(t[1], t[2]);
    edited = with_triangles(child.c, triangles);
  } else if (kind == 2 && triangles.size() > 2) {
    std::vector<std::uint8_t> is_kept(triangles.size(), 1);
    one_of(random, is_kept) = 0;
    edited = keep_triangles(child.c, is_kept);
  } else if (kind == 3) {
    edited = close_loops(child.c, static_cast<std::size_t>(random.below(3)));
  } else if (kind == 4) {  // a seam: the triangle once more, of vertices in the same places
    add_mesh(edited, Triangles{{0, 1, 2}},
             [&](std::size_t f) { return Positions(child.c.frames[f](one, Eigen::all)); });
    edited = with_triangles(edited, triangles_of(edited));
  } else {
    Numbers target = in_order(vertex_count(child.c));
    const auto a = random.below(static_cast<int>(target.size()));
    const auto b = random.below(static_cast<int>(target.size()));
    target[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    edited = merge_vertices(child.c, target);
  }
  if (edited.triangles.rows() == 0 || !is_valid(edited)) return;
  child.c = std::move(edited);
  child.focus.reset();
}

// Puts another mesh beside this one, or into it.
void unite(Random& random, Candidate& child, const MoveContext& context) {
  constexpr Eigen::Index most_triangles = 60;
  if (!context.other || !is_plain(child.c) || !is_plain(context.other->c)) return;
  const Case& other = context.other->c;
  if (says_query(other) || child.c.triangles.rows() + other.triangles.rows() > most_triangles)
    return;
  auto& c = child.c;
  const double own = greatest_of(c), its = greatest_of(other);
  if (!(own > 0) || !(its > 0) || own > 1e290 || its > 1e290) return;
  const int away = random.one_in(2) ? 0 : random.between(-1, 2);
  const double size = std::ldexp(1.0, std::ilogb(own) - std::ilogb(its));
  const auto axis = random.below(3);
  add_mesh(c, other.triangles, [&](std::size_t f) {
    Positions positions = size * other.frames[std::min(f, other.frames.size() - 1)];
    positions.col(axis).array() += away * own;
    return positions;
  });
  c.view.reset();
  c.expected = {};
  if (!is_valid(c)) child = *context.other;
}

void renumber(Random& random, Candidate& child, const MoveContext&) {
  if (!is_plain(child.c)) return;
  auto triangles = shuffled(random, triangles_of(child.c));
  begin_anywhere(random, triangles);
  auto edited = with_triangles(child.c, triangles);
  if (edited.frames.front().rows() != child.c.frames.front().rows()) return;
  child.c = std::move(edited);
  child.focus.reset();  // it names triangles
}

// Adds two triangles between an edge of each triangle in focus. Then the two are of one component,
// or joined once more, and the mesh has other loops.
void bridge(Random& random, Candidate& child, const MoveContext&) {
  auto& c = child.c;
  if (!is_plain(c) || !child.focus || c.triangles.rows() < 2) return;
  const auto count = static_cast<int>(c.triangles.rows());
  const auto [a, b] = pair_in_focus(c, *child.focus);
  const auto loops = oracle::unmatched_edges(c.triangles);
  const std::set<oracle::DirectedEdge> open(loops.begin(), loops.end());
  const auto edge_of = [&](int t) {
    oracle::DirectedEdge edge{};
    const int first = random.below(3);
    for (int k = first; k < first + 3; ++k) {
      edge = {c.triangles(t, k % 3), c.triangles(t, (k + 1) % 3)};
      if (open.contains(edge)) break;
    }
    return edge;
  };
  const auto [u, v] = edge_of(a);
  const auto [x, y] = edge_of(b);
  Case united = c;
  united.triangles.conservativeResize(count + 2, 3);
  united.triangles.row(count) << v, u, y;
  united.triangles.row(count + 1) << v, y, x;
  if (is_valid(united)) c = std::move(united);
}

constexpr Move of_meshes[] = {
    {"edit", "a triangle is flipped, dropped or doubled, two vertices are merged", MoveKind::mesh,
     2, edit_mesh},
    {"unite", "another mesh beside this one", MoveKind::mesh, 2, unite},
    {"renumber", "triangles in another order", MoveKind::mesh, 1, renumber},
    {"nest", "a copy of the mesh inside the mesh", MoveKind::mesh, 1, nest},
    {"bridge", "two new triangles join the two triangles in focus", MoveKind::mesh, 2, bridge},
};

}  // namespace

std::span<const Move> mesh_moves() { return of_meshes; }

void nest(Random& random, Candidate& child, const MoveContext&) {
  constexpr Eigen::Index most_triangles = 24;
  const auto count = child.c.triangles.rows();
  if (!is_plain(child.c) || count > most_triangles) return;
  Case c = child.c;
  const int triangle = random.below(static_cast<int>(count)), corner = random.below(3);
  const auto vertex = c.triangles(triangle, corner);
  const auto also_held = random.one_in(2) ? c.triangles(triangle, (corner + 1) % 3) : vertex;
  const auto vertices = static_cast<std::int32_t>(vertex_count(c));
  constexpr double shares[] = {0.5, 0.25, 0.75, -0.5, -1};
  const double share = one_of(random, shares);
  for (auto& frame : c.frames) {
    const Row middle = frame.colwise().mean();
    frame.conservativeResize(2 * vertices, 3);
    for (std::int32_t v = 0; v < vertices; ++v)
      frame.row(vertices + v) = frame.row(v) + share * (middle - Row(frame.row(v)));
  }
  auto triangles = triangles_of(c);
  for (Eigen::Index t = 0; t < count; ++t) {
    auto copy = triangles[static_cast<std::size_t>(t)];
    for (auto& v : copy) v += v == vertex || v == also_held ? 0 : vertices;
    triangles.push_back(copy);
  }
  auto nested = with_triangles(c, triangles);
  if (!is_valid(nested)) return;
  child.c = std::move(nested);
  child.focus.reset();
}

}  // namespace assay::properties
