// Moves of a mesh: its steps, its triangles, its view primitive.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "properties/reducer/case_edits.h"
#include "properties/search/degeneracy.h"
#include "properties/search/moves.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using detector::FourPoints;

// More steps: back again, on, or the same once more; or a step that is looked at and not taken.
constexpr std::size_t most_frames = 6;
void more_steps(Random& random, Candidate& made, const MoveContext&) {
  auto& c = made.c;
  if (c.frames.size() >= most_frames || c.counted || c.ghosts) return;
  const auto last = static_cast<std::int32_t>(c.frames.size()) - 1;
  auto script = corpus::steps_of(c);
  const bool by_script = !c.script.empty();
  switch (random.below(5)) {
    case 0: {
      const auto to = static_cast<std::int32_t>(random.below(last + 1));
      c.frames.push_back(c.frames[detector::at(to)]);
      break;
    }
    case 1: {
      const detector::Positions way =
          c.frames[detector::at(last)] - c.frames[detector::at(last > 0 ? last - 1 : 0)];
      c.frames.push_back(c.frames.back() + (random.one_in(2) ? 1.0 : -0.5) * way);
      break;
    }
    case 2: {  // it begins elsewhere
      detector::Positions before = c.frames.front();
      const double amount = std::ldexp(greatest_of(c), -random.between(1, 4));
      for (Eigen::Index v = 0; v < before.rows(); ++v) {
        const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
        before.row(v) += amount * Eigen::RowVector3d(x, y, z);
      }
      c.frames.insert(c.frames.begin(), before);
      for (auto& step : script) {
        ++step.from;
        ++step.to;
      }
      script.insert(script.begin(), {0, 1, true});
      if (by_script) c.script = script;
      made.focus.reset();
      c.view.reset();
      return;
    }
    case 3: {
      auto& step = one_of(random, script);
      step.commit = !step.commit;
      c.script = script;
      return;
    }
    default: {
      const auto again = one_of(random, script);
      c.script = script;
      c.script.push_back(again);
      return;
    }
  }
  if (by_script) c.script.push_back({last, last + 1, true});
  c.view.reset();
}

// Whether the mesh may be changed: a relation and ghosts speak of its numbers.
bool is_plain(const corpus::Case& c) { return !c.counted && !c.ghosts; }

// A triangle becomes another one, a corner at a time; or is doubled in its place, flipped, dropped.
void edit_mesh(Random& random, Candidate& made, const MoveContext&) {
  if (!is_plain(made.c)) return;
  auto triangles = triangles_of(made.c);
  const int kind = random.below(6);
  auto& one = one_of(random, triangles);
  corpus::Case edited = made.c;
  if (kind == 0) {
    std::swap(one[1], one[2]);
    edited = with_triangles(made.c, triangles);
  } else if (kind == 1) {
    for (auto& t : triangles) std::swap(t[1], t[2]);
    edited = with_triangles(made.c, triangles);
  } else if (kind == 2 && triangles.size() > 2) {
    std::vector<std::uint8_t> kept(triangles.size(), 1);
    one_of(random, kept) = 0;
    edited = keep_triangles(made.c, kept);
  } else if (kind == 3) {
    edited = close_loops(made.c, static_cast<std::size_t>(random.below(3)));
  } else if (kind == 4) {  // a seam: the triangle once more, of vertices in the same places
    const auto first = static_cast<std::int32_t>(vertex_count(edited));
    for (auto& frame : edited.frames) {
      frame.conservativeResize(first + 3, 3);
      for (int k = 0; k < 3; ++k)
        frame.row(first + k) = frame.row(one[static_cast<std::size_t>(k)]).eval();
    }
    triangles.push_back({first, first + 1, first + 2});
    edited = with_triangles(edited, triangles);
  } else {
    std::vector<std::int32_t> target(vertex_count(made.c));
    for (std::size_t v = 0; v < target.size(); ++v) target[v] = static_cast<std::int32_t>(v);
    const auto a = random.below(static_cast<int>(target.size()));
    const auto b = random.below(static_cast<int>(target.size()));
    target[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    edited = merge_vertices(made.c, target);
  }
  if (edited.triangles.rows() == 0 || !is_valid(edited)) return;
  made.c = std::move(edited);
  made.focus.reset();
}

// Puts another mesh beside this one, or into it.
void unite(Random& random, Candidate& made, const MoveContext& context) {
  constexpr Eigen::Index most_triangles = 60;
  if (!context.other || !is_plain(made.c) || !is_plain(context.other->c)) return;
  const corpus::Case& other = context.other->c;
  if (says_query(other) || made.c.triangles.rows() + other.triangles.rows() > most_triangles)
    return;
  auto& c = made.c;
  const auto vertices = static_cast<std::int32_t>(vertex_count(c));
  const double own = greatest_of(c), its = greatest_of(other);
  if (!(own > 0) || !(its > 0) || own > 1e290 || its > 1e290) return;
  const int away = random.one_in(2) ? 0 : random.between(-1, 2);
  const double size = std::ldexp(1.0, std::ilogb(own) - std::ilogb(its));
  const auto axis = random.below(3);
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    detector::Positions put = size * other.frames[std::min(f, other.frames.size() - 1)];
    put.col(axis).array() += away * own;
    c.frames[f].conservativeResize(vertices + put.rows(), 3);
    c.frames[f].bottomRows(put.rows()) = put;
  }
  const auto rows = c.triangles.rows();
  c.triangles.conservativeResize(rows + other.triangles.rows(), 3);
  c.triangles.bottomRows(other.triangles.rows()) = other.triangles.array() + vertices;
  c.view.reset();
  c.expected = {};
  if (!is_valid(c)) made = *context.other;
}

void renumber(Random& random, Candidate& made, const MoveContext&) {
  if (!is_plain(made.c)) return;
  auto triangles = shuffled(random, triangles_of(made.c));
  for (auto& t : triangles) std::rotate(t.begin(), t.begin() + random.below(3), t.end());
  auto edited = with_triangles(made.c, triangles);
  if (edited.frames.front().rows() == made.c.frames.front().rows()) made.c = std::move(edited);
}

// A view primitive near the features, or the middle, or none.
void view(Random& random, Candidate& made, const MoveContext&) {
  auto& c = made.c;
  c.view.reset();
  if (c.ghosts || random.one_in(4)) return;
  const auto& first = c.frames.front();
  const double size = greatest_of(c);
  const Eigen::RowVector3d middle = first.colwise().mean();
  const bool is_line = random.one_in(2), moves = random.one_in(3), at_vertex = random.one_in(3);
  const auto vertex = random.below(static_cast<int>(first.rows()));
  const auto drawn = [&] {
    const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
    return Eigen::RowVector3d(x, y, z);
  };
  const double reach = std::ldexp(size, -random.between(0, 5));
  Eigen::RowVector3d q0 = at_vertex ? Eigen::RowVector3d(first.row(vertex)) : middle;
  q0 += reach * drawn();
  const Eigen::RowVector3d q1 = q0 + size * drawn(), way = moves
                                                               ? Eigen::RowVector3d(reach * drawn())
                                                               : Eigen::RowVector3d(0, 0, 0);
  c.view.emplace();
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    const double share = static_cast<double>(f);
    const Eigen::RowVector3d a = q0 + share * way, b = q1 + share * way;
    c.view->q0.push_back({a[0], a[1], a[2]});
    if (is_line) c.view->q1.push_back({b[0], b[1], b[2]});
  }
}

// Newton steps of a view primitive and a triangle onto degeneracies of the view polynomial, which
// is F of an end of the primitive and the three corners: it is zero where the triangle has no
// sign. So a sign that holds at the ends of a step alone comes about, and one that is zero once.
void look_aside(Random& random, Candidate& made, const MoveContext& context) {
  auto& c = made.c;
  if (c.ghosts || c.triangles.rows() == 0) return;
  if (!c.view) view(random, made, context);
  if (!c.view) return;
  const auto script = corpus::steps_of(c);
  const auto step = made.focus ? script[made.focus->step] : one_of(random, script);
  const auto from = detector::at(step.from), to = detector::at(step.to);
  auto triangle = random.below(static_cast<int>(c.triangles.rows()));
  if (made.focus && made.focus->contact && random.one_in(2)) {
    const auto& pair = made.focus->contact->pair;
    triangle = random.one_in(2) ? pair.a : pair.b;
  }
  const detector::SteppedMesh motion{c.frames[from], c.frames[to]};
  const bool from_its_end = !c.view->q1.empty() && random.one_in(2);
  auto& q = from_its_end ? c.view->q1 : c.view->q0;
  FourPoints points;
  points.first_group = 1;
  points.points[0] = {q[from], q[to]};
  for (int k = 0; k < 3; ++k)
    points.points[static_cast<std::size_t>(k + 1)] = motion.path(c.triangles(triangle, k));
  constexpr double times[] = {0.5, 0.5, 0.25, 0.75, 0.125, 1.0 / 3, 0.0, 1.0};
  const double time = one_of(random, times);
  std::vector<DegeneracyAt> goals = {
      {random.one_in(2) ? Degeneracy::double_root : Degeneracy::coplanar, time, 0}};
  if (random.one_in(3)) goals.push_back({Degeneracy::coplanar, one_of(random, times), 0});
  // The primitive, a corner, or both; what is at rest stays there in half of the cases.
  const unsigned masks[] = {0x01, 0x10, 0x11, 0xe0, 0xf0, 0x20, 0xff, 0xee};
  const auto moved = moved_onto(points, goals, one_of(random, masks));
  if (!moved) return;
  q[from] = moved->points[0].t0;
  q[to] = moved->points[0].t1;
  for (int k = 0; k < 3; ++k) {
    const auto& path = moved->points[static_cast<std::size_t>(k + 1)];
    for (int axis = 0; axis < 3; ++axis) {
      c.frames[from](c.triangles(triangle, k), axis) = path.t0[static_cast<std::size_t>(axis)];
      c.frames[to](c.triangles(triangle, k), axis) = path.t1[static_cast<std::size_t>(axis)];
    }
  }
}

constexpr Move of_meshes[] = {
    {"steps", "one more step", true, 3, more_steps},
    {"edit", "a triangle is flipped, dropped or doubled, two vertices are merged", true, 2,
     edit_mesh},
    {"unite", "another mesh beside this one", true, 2, unite},
    {"renumber", "triangles in another order", true, 1, renumber},
    {"view", "another view primitive", true, 2, view, true},
    {"aside", "Newton steps of a view primitive and a triangle", true, 4, look_aside, true},
};

}  // namespace

std::span<const Move> mesh_moves() { return of_meshes; }

}  // namespace assay::properties
