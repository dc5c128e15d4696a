#include <algorithm>
#include <cmath>

#include "corpus/hard/hard_families.h"

namespace assay::corpus {

// Hard times: contacts at the very ends of the step, roots that fall together, steps much longer
// and much shorter than the mesh.
namespace {

// Returns a block, and a spike whose tip goes from one height to another.
Case spike_falls(Variation& vary, std::int64_t z_t0, std::int64_t z_t1, KnownFacts facts) {
  GridMesh mesh;
  add_block(mesh, vary, usual_size, vary.between(usual_size / 2, usual_size));
  add_spike(mesh, vary, falling(under_the_face(vary, usual_size, 0), z_t0, z_t1), usual_size / 2,
            usual_size / 2, Side::all_around);
  return sheared_case(mesh, vary, std::move(facts));
}

// Returns a spike that starts above, inside or on the block and leaves it. If it starts inside, it
// is pierced at t=0.
Case at_the_start(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent), start[] = {gap, -gap, 0};
  return spike_falls(vary, start[kind], start[kind] + usual_size / 4,
                     kind == 0 ? known_free() : known_collision(0));
}

// Returns a spike that comes from 2^44 - gap and stops above, inside or on the block. If inside, t*
// = 1 - gap / 2^44; if on it, t* = 1.
Case at_the_end(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent), end[] = {gap, -gap, 0};
  const double first = kind == 2 ? 1 : 1 - std::ldexp(1, exponent - 44);
  return spike_falls(vary, two_to(44) - gap, end[kind],
                     kind == 0 ? known_free() : known_collision(first));
}

// Returns a face and a spike. The face turns about the y axis, from z = x to z = -x, while the tip
// goes along x from -W to W at height -dip. With tau = 2t - 1 the face is z = -tau x, and the tip
// is tau^2 W - dip above it. That is zero twice, at tau = -+sqrt(dip / W), and only touches zero if
// dip is 0. With W = 2^44 and dip = 2^(2m), t* is (1 - 2^(m - 22)) / 2. The rest of the spike,
// within W / 2 of the tip along x and W or more above it, is at least W / 2 above the face; the
// block's fourth corner is below it on the axis.
Case double_root(Variation& vary, int exponent, int kind) {
  constexpr std::int64_t path = std::int64_t{1} << 44;
  const std::int64_t gap = two_to(exponent), dips[] = {gap, -gap, 0};
  const std::int64_t dip = dips[kind];
  GridMesh mesh;
  std::array<GridVertex, 4> block;
  const auto face = wide_face(vary, usual_size);
  for (std::size_t i = 0; i < 3; ++i) {
    block[i] = falling(face[i], face[i].x, -face[i].x);
  }
  block[3] = at_rest({0, 0, -vary.between(usual_size, 2 * usual_size)});
  mesh.add_tetrahedron(block);
  const std::int64_t y = vary.between(-usual_size / 16, usual_size / 16);
  add_spike(mesh, vary, {{-path, y, -dip}, {path, y, -dip}}, path / 2, path, Side::all_around);
  const double first = kind == 2 ? 0.5 : (1 - std::ldexp(1, exponent / 2 - 22)) / 2;
  return sheared_case(mesh, vary, kind == 1 ? known_free() : known_collision(first));
}

// Returns a vertex at the origin and a triangle. With tau = t - 1/2 the triangle's corners are the
// rows of M + tau I, times 2^43 units, and F(tau) = tau^3 + c2 tau^2 - c1 tau + c0. M is the
// companion matrix of that polynomial, rows (0,1,0) (0,0,1) (c0,c1,c2), seen in the basis (1,0,0)
// (0,1,0) (1,1,1). That keeps F, and puts the origin inside of the triangle near tau = 0 (with
// weights 1,1,1 if all c are small). The vertex is the tip of a needle on the side that it comes
// from.
Case triple_root(Variation& vary, int exponent, int kind) {
  constexpr std::int64_t one = std::int64_t{1} << 43;
  const std::int64_t d2 = two_to(43 + 2 * exponent);  // the square of the distance of roots
  // The roots by kind: -d, 0 and d; 0 beside a complex pair; 2 beside a complex pair; three at one
  // place.
  const std::int64_t c0 = kind == 2 ? -2 * d2 : 0;
  const std::int64_t c1 = kind == 3 ? 0 : kind == 0 ? d2 : -d2;
  const std::int64_t c2 = kind == 2 ? -2 * one : 0;
  const GridPoint rows[] = {
      {0, one, 0}, {one, one, one}, {-one + c0 + c2, -2 * one + c1 + c2, -one + c2}};
  const std::int64_t half = one / 2;
  const GridPoint axes[] = {{half, 0, 0}, {0, half, 0}, {0, 0, half}};
  std::array<GridVertex, 3> face;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = axes[i];
    face[i] = {rows[i] + GridPoint{-a.x, -a.y, -a.z}, rows[i] + a};
  }
  GridMesh mesh;
  mesh.add_triangle(face);
  const auto small_offset = [&] { return vary.between(0, one / 64); };
  mesh.add_triangle({at_rest({0, 0, 0}),
                     at_rest({one / 2 + small_offset(), small_offset(), -one / 2}),
                     at_rest({one / 2, small_offset() - one / 16, -one / 2 - small_offset()})});
  const double first = kind == 0 ? 0.5 - std::ldexp(1, exponent) : 0.5;
  return sheared_case(mesh, vary, kind == 2 ? known_free() : known_collision(first));
}

// Returns solids far smaller than the way that the spike goes. By kind, the spike goes through the
// face, past it, or onto it.
Case long_step(Variation& vary, int exponent, int kind) {
  const std::int64_t reach = two_to(usual_exponent - exponent), way = usual_size;
  const bool misses = kind == 1;
  GridMesh mesh;
  std::array<GridVertex, 4> block;
  const auto face = wide_face(vary, reach);
  // For a miss all of the block lies in y <= 0.
  for (std::size_t i = 0; i < 3; ++i)
    block[i] = at_rest(misses ? face[i] + GridPoint{0, -reach} : face[i]);
  block[3] = at_rest({0, misses ? -reach / 2 : 0, -reach});
  mesh.add_tetrahedron(block);
  GridPoint place = under_the_face(vary, reach, 0);
  if (misses) place.y = reach / 8;
  GridVertex tip = falling(place, way, kind == 2 ? 0 : -way);
  const std::int64_t slant = vary.between(-way, way);
  tip.t0.x -= slant;
  if (kind != 2) tip.t1.x += slant;
  add_spike(mesh, vary, tip, reach / 2, reach / 2, misses ? Side::positive_y : Side::all_around);
  return sheared_case(mesh, vary, misses ? known_free() : known_collision(kind == 0 ? 0.5 : 1));
}

Case short_step(Variation& vary, int exponent, int kind) {
  const std::int64_t way = two_to(exponent);
  const std::int64_t start[] = {way, 2 * way, way, 0}, end[] = {-way, way, 0, way};
  constexpr double first[] = {0.5, 0, 1, 0};
  return spike_falls(vary, start[kind], end[kind],
                     kind == 1 ? known_free() : known_collision(first[kind]));
}

}  // namespace

std::vector<HardFamily> time_families() {
  return {{"contact-at-start", "a spike leaves a face, and starts just above or just below it",
           "distance at t=0", "ulp", 40, -1, 40, 2, 1, at_the_start},
          {"contact-at-end", "a spike almost reaches a face, or reaches it just before t=1",
           "distance at t=1", "ulp", 40, -1, 40, 2, 1, at_the_end},
          {"double-root", "a tip's height over a turning face is a square in time, -+ a little",
           "least height", "ulp", 40, -2, 20, 2, 1, double_root},
          {"triple-root", "three roots close together, one root beside a complex pair, or no root",
           "distance of the roots", "of the step", -2, -1, 19, 3, 1, triple_root},
          {"long-steps", "a spike goes through a face, or past it",
           "length of the motion, divided by the usual size", "", 0, 1, 40, 2, 1, long_step},
          {"short-steps", "a spike moves into a face, or toward it", "length of the motion", "ulp",
           44, -1, 44, 2, 2, short_step}};
}

// Hard numbers: tiny motion far from the origin; scales up to 2^500 and down to 2^-500, one for
// all axes or another for each; denormals.
namespace {

// Returns a mesh that is not hard by itself. By kind, a spike goes through a face (at half time),
// stops in it, stops well above it, or passes beside it.
GridMesh easy(Variation& vary, int kind, std::int64_t reach, std::int64_t way) {
  GridMesh mesh;
  const bool beside = kind == 3;
  std::array<GridVertex, 4> block;
  const auto face = wide_face(vary, reach);
  const GridPoint aside{0, beside ? -reach : 0, 0};
  for (std::size_t i = 0; i < 3; ++i) block[i] = at_rest(face[i] + aside);
  block[3] = at_rest(under_the_face(vary, reach, -reach / 2) + aside);
  mesh.add_tetrahedron(block);
  GridPoint place = under_the_face(vary, reach, 0);
  if (beside) place.y = reach / 4;
  const std::int64_t start[] = {way, 3 * way, 2 * way, way}, end[] = {-way, -way, way, -way};
  add_spike(mesh, vary, falling(place, start[kind], end[kind]), reach / 2, reach / 2,
            beside ? Side::positive_y : Side::all_around);
  return mesh;
}

KnownFacts known_of(int kind) {
  constexpr double first[] = {0.5, 0.75};
  return kind < 2 ? known_collision(first[kind]) : known_free();
}

// Returns solids of 2^(45 - exponent) units, 2^51 units and more away from the origin. On the grid
// the spike moves by one, two or four units.
Case far_offset(Variation& vary, int exponent, int kind) {
  const GridMesh mesh = easy(vary, kind, two_to(usual_exponent - exponent), 1);
  GridMap map = GridMap::any(vary);
  const auto away = [&] {
    const std::int64_t distance = vary.between(two_to(51), two_to(51) + two_to(50));
    return vary.sign() * distance;
  };
  const std::int64_t x = away(), y = away();
  map.shift = {x, y, away()};
  return grid_case(mesh, map, {-46, -46, -46}, known_of(kind));
}

constexpr int easy_exponent = 20;  // coordinates below 2^27: products of three fit a double nearly

Case scaled(Variation& vary, int kind, const std::array<int, 3>& exponents) {
  const GridMesh mesh = easy(vary, kind, two_to(easy_exponent), two_to(easy_exponent - 2));
  std::array<int, 3> of_units = exponents;
  for (auto& e : of_units) e -= easy_exponent;
  return grid_case(mesh, GridMap::any(vary), of_units, known_of(kind));
}

// Kinds 0 to 3 are larger, kinds 4 to 7 smaller.
Case scales(Variation& vary, int exponent, int kind) {
  const int e = kind < 4 ? exponent : -exponent;
  return scaled(vary, kind % 4, {e, e, e});
}

// Stretches one axis and shrinks another.
Case mixed_scales(Variation& vary, int exponent, int kind) {
  std::array<int, 3> exponents = {exponent, 0, -exponent};
  std::rotate(exponents.begin(), exponents.begin() + vary.between(0, 2), exponents.end());
  return scaled(vary, kind, exponents);
}

Case denormals(Variation& vary, int exponent, int kind) {
  const int e = exponent + easy_exponent;
  return scaled(vary, kind, {e, e, e});
}

}  // namespace

std::vector<HardFamily> number_families() {
  return {
      {"far-offset", "a motion of one to four ulp, far from the origin",
       "distance from the origin, divided by 64 times the size", "", 0, 1, 40, 4, 0, far_offset},
      {"scales", "an easy case, made larger or smaller", "factor, or its inverse", "", 0, 10, 50, 8,
       0, scales},
      {"mixed-scales", "an easy case, one axis stretched and another shrunk",
       "factor of one axis; another axis is divided by it", "", 0, 10, 50, 4, 0, mixed_scales},
      {"denormals", "an easy case whose coordinates lose their normal range",
       "unit of the coordinates, which have up to 27 bits", "", -1022, -4, 13, 4, 0, denormals}};
}

}  // namespace assay::corpus
