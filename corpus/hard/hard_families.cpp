// The families of all files of hard/ together, how a case of one is made, and view_families().
#include "corpus/hard/hard_families.h"

#include <fmt/format.h>

#include <cmath>

namespace assay::corpus {

std::span<const HardFamily> hard_families() {
  static const std::vector<HardFamily> all = [] {
    std::vector<HardFamily> rows;
    for (const auto& part : {feature_families(), time_families(), view_families(),
                             number_families(), crowd_families()}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  }();
  return all;
}

Case hard_case(const HardFamily& family, int strength, int variant) {
  Variation vary(family.name, strength, variant);
  const int kind = variant % family.kinds_at(strength);
  // Exact touching happens among features of every size.
  Case c =
      family.touches(strength)
          ? family.make(vary, family.exponent(static_cast<int>(vary.between(0, family.strongest))),
                        family.kinds + kind)
          : family.make(vary, family.exponent(strength), kind);
  c.id = fmt::format("{}-s{}-v{}", family.name, strength, variant);
  c.about = family.about;
  c.source = "corpus/hard";
  return c;
}

// View tests near zero: values that touch it, primitives on the surface, vertices beside the
// planes through the ends of a view-line. The sign of each triangle is an expected fact too.

namespace {

using detector::ViewSign;

constexpr ViewSign zero = ViewSign::zero, plus = ViewSign::positive, minus = ViewSign::negative;

KnownFacts with_signs(KnownFacts facts, std::vector<ViewSign> signs) {
  facts.view_signs = std::move(signs);
  return facts;
}

// A tetrahedron on a wide face, its fourth corner on the axis; its last triangle is the floor.
void add_tent(GridMesh& mesh, Variation& vary, const GridVertex& top, const GridPoint& moved) {
  const auto face = wide_face(vary, usual_size);
  const auto floor = [&](std::size_t i) { return GridVertex{face[i], face[i] + moved}; };
  mesh.add_tetrahedron({floor(0), floor(1), floor(2), top});
}

// Even kinds: a tent moves up past the view-point at rest inside, until that is above, below or on
// its floor. Odd kinds: the top comes down to above, below or on the floor, and the view-point is
// half as high all the time. If the top gets on or below the floor, all four triangles are in
// contact, and all their values are 0 at that time. That is t* = 1 if it stops on the floor, else
// t* = 1 - 2 gap / 2^45, because the top starts at 2^45 - 2 gap.
Case touches_zero(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  GridMesh mesh;
  KnownFacts facts;
  const std::int64_t ends[] = {gap, -gap, 0}, end = ends[kind / 2];
  const bool above = end > 0;
  if (kind % 2 == 0) {
    const GridPoint moved{0, 0, usual_size / 2 - end};
    const GridPoint top{0, 0, usual_size + vary.between(0, usual_size)};
    add_tent(mesh, vary, {top, top + moved}, moved);
    mesh.view = {at_rest({0, 0, usual_size / 2})};
    facts = with_signs(known_free(), {plus, plus, plus, above ? plus : zero});
  } else {
    const std::int64_t start = usual_size / 2 - gap;
    add_tent(mesh, vary, falling({}, 2 * start, 2 * end), {});
    mesh.view = {falling({}, start, end)};
    const ViewSign sign = above ? plus : zero;
    const double first = end == 0 ? 1 : 1 - std::ldexp(1, exponent + 1 - usual_exponent);
    facts = with_signs(above ? known_free() : known_collision(first), {sign, sign, sign, sign});
  }
  return sheared_case(mesh, vary, std::move(facts));
}

// A tent that moves along with its view-point, which stays above, below or on the floor, or is one
// of its corners.
Case on_the_surface(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  GridMesh mesh;
  const GridPoint moved{vary.between(-usual_size, usual_size),
                        vary.between(-usual_size, usual_size),
                        vary.between(-usual_size, usual_size)};
  const GridPoint top{0, 0, vary.between(usual_size / 2, usual_size)};
  add_tent(mesh, vary, {top, top + moved}, moved);
  const std::int64_t heights[] = {gap, -gap, 0};
  constexpr ViewSign floor[] = {plus, minus, zero};
  if (kind < 3) {
    const GridPoint q{0, 0, heights[kind]};
    mesh.view = {{q, q + moved}};
    return sheared_case(mesh, vary, with_signs(known_free(), {plus, plus, plus, floor[kind]}));
  }
  mesh.view = {mesh.vertices[0]};
  return sheared_case(mesh, vary, with_signs(known_free(), {plus, zero, zero, zero}));
}

// The view-line lies on the x axis from 0 to 2^45. A triangle lies in the plane z = gap - x; its
// first corner comes to x = c near 0, and the others stay at x < 0. At x < 0 the nearest point is
// the line's end at 0 and the view value is gap (times twice the area seen along z); between the
// planes through the ends it is gap - x. So the triangle is positive exactly when c < gap. Kinds 3
// to 5 are the same at the other end, mirrored, with the vertices exchanged to keep its side.
Case line_ends(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent), ends[] = {gap - 1, gap, gap + 1};
  const std::int64_t c = ends[kind % 3];
  const auto far = [&] { return vary.between(usual_size / 4, usual_size / 2); };
  const auto in_plane = [&](GridPoint p) {
    p.z = gap - p.x;
    return p;
  };
  const std::int64_t y = vary.between(-usual_size / 16, usual_size / 16);
  std::array<GridVertex, 3> corners = {
      GridVertex{in_plane({-vary.between(1, gap), y}), in_plane({c, y})},
      at_rest(in_plane({-far(), usual_size / 16 + far()})),
      at_rest(in_plane({-far(), -usual_size / 16 - far()}))};
  const bool mirrored = kind >= 3;
  if (mirrored) {
    for (auto& corner : corners) {
      corner.t0.x = usual_size - corner.t0.x;
      corner.t1.x = usual_size - corner.t1.x;
    }
    std::swap(corners[1], corners[2]);
  }
  GridMesh mesh;
  mesh.add_triangle(corners);
  mesh.view = {at_rest({0, 0, 0}), at_rest({usual_size, 0, 0})};
  return grid_case(mesh, GridMap::of_axes(vary), to_size_one,
                   with_signs(known_free(), {kind % 3 == 0 ? plus : zero}));
}

}  // namespace

std::vector<HardFamily> view_families() {
  return {{"view-touches-zero",
           "a tent passes over its view-point; a tent collapses onto it: not quite, a little",
           "what is left of the view value, as height", "ulp", 40, -1, 40, 4, 2, touches_zero},
          {"view-on-surface", "the view-point above or below a face that it moves with",
           "distance from the face", "ulp", 40, -1, 40, 2, 2, on_the_surface},
          {"view-line-ends",
           "a vertex beside the plane through a view-line's end, the view value one ulp from 0",
           "distance from that plane", "ulp", 40, -1, 40, 6, 0, line_ends}};
}

}  // namespace assay::corpus
