// Hard numbers: tiny motion far from the origin; scales up to 2^500 and down to 2^-500, one for
// all axes or another for each; denormals.
#include <algorithm>

#include "corpus/hard/grid_mesh.h"
#include "corpus/hard/hard_families.h"

namespace assay::corpus {
namespace {

// A mesh that is not hard by itself. By kind, a spike goes through a face (at half time), stops in
// it, stops well above it, or passes beside it.
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

// Solids of 2^(45 - exponent) units, 2^51 units and more away from the origin. On the grid the
// spike moves by one, two or four units.
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

// One axis is stretched, another shrunk.
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
       "distance from the origin over 64 times the size", "", 0, 1, 40, 4, 0, far_offset},
      {"scales", "an easy case, made larger or smaller", "factor, or one over it", "", 0, 10, 50, 8,
       0, scales},
      {"mixed-scales", "an easy case, one axis stretched and another shrunk",
       "factor of one axis, and one over that of another", "", 0, 10, 50, 4, 0, mixed_scales},
      {"denormals", "an easy case whose coordinates lose their normal range",
       "unit of the coordinates, which have up to 27 bits", "", -1022, -4, 13, 4, 0, denormals}};
}

}  // namespace assay::corpus
