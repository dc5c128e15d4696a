// Features that are nearly in one plane, nearly parallel, nearly without area, or pass each other
// by a hair. Grazing gaps go from 2^40 ulp down to one, both sides.
#include "corpus/hard/grid_mesh.h"
#include "corpus/hard/hard_families.h"

namespace assay::corpus {
namespace {

constexpr std::int64_t drop = usual_size / 4;

// A flat spike over a flat block. All eight vertices are within a few gaps of one plane, and the
// tip is within two gaps of it all the time.
Case near_coplanar(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  GridMesh mesh;
  add_block(mesh, vary, usual_size, 2 * gap);
  const GridPoint place = under_the_face(vary, usual_size, 0);
  const std::int64_t end[] = {-gap, gap, gap, 0};
  GridVertex tip = falling(place, kind == 1 ? 2 * gap : gap, end[kind]);
  if (kind == 2) tip.t1.x += usual_size / 16;  // it glides over the face
  add_spike(mesh, vary, tip, usual_size / 2, gap, Side::all_around);
  constexpr double first[] = {0.5, 0, 0, 1};
  return sheared_case(mesh, vary, kind % 3 == 0 ? known_collision(first[kind]) : known_free());
}

// The lower edge of one tetrahedron over the upper edge of another. They cross over the origin, at
// an angle of about gap / usual_size. In kind 2 they would cross only beyond their ends, because y
// is at most gap in the one and at least twice that in the other.
Case near_parallel(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  const auto half_or_more_of = [&](std::int64_t n) { return vary.between(n / 2, n); };
  GridMesh mesh;
  const std::int64_t reach = half_or_more_of(usual_size);
  mesh.add_tetrahedron({at_rest({-reach, -gap, 0}), at_rest({reach, gap, 0}),
                        at_rest({-half_or_more_of(usual_size), -half_or_more_of(usual_size / 2),
                                 -half_or_more_of(usual_size)}),
                        at_rest({half_or_more_of(usual_size), gap - half_or_more_of(usual_size / 2),
                                 -half_or_more_of(usual_size)})});
  const bool beside = kind == 2;
  const std::int64_t y = beside ? 2 * gap : 0;
  const std::int64_t end[] = {-drop, gap, -drop, 0};
  const GridVertex left =
      falling({-half_or_more_of(usual_size / 2), y, 0}, kind == 1 ? 2 * gap : drop, end[kind]);
  mesh.add_tetrahedron(
      {left, carried(left, {half_or_more_of(usual_size / 2) + usual_size / 2, 0, 0}),
       carried(left, {0, half_or_more_of(usual_size / 2), half_or_more_of(usual_size)}),
       carried(left, {half_or_more_of(usual_size),
                      beside ? half_or_more_of(usual_size) : -half_or_more_of(usual_size),
                      half_or_more_of(usual_size)})});
  constexpr double first[] = {0.5, 0, 0, 1};
  return sheared_case(mesh, vary, kind % 3 == 0 ? known_collision(first[kind]) : known_free());
}

// A face of this width and the usual length. By kind, a spike comes down through it, as far beside
// its long edge as the face is wide, on that edge, or on its far corner.
Case slivers(Variation& vary, int exponent, int kind) {
  const std::int64_t width = two_to(exponent);
  const auto far = [&] { return vary.between(usual_size / 2, usual_size); };
  GridMesh mesh;
  mesh.add_tetrahedron({at_rest({-far(), 0, 0}), at_rest({far(), 0, 0}), at_rest({0, width, 0}),
                        at_rest({0, width, -far()})});
  const std::int64_t on_the_edge = vary.between(-usual_size / 4, usual_size / 4);
  const GridPoint places[] = {
      {0, (width + 1) / 2, 0}, {on_the_edge, -width, 0}, {on_the_edge, 0, 0}, {0, width, 0}};
  const bool misses = kind == 1;
  add_spike(mesh, vary, falling(places[kind], drop, -drop), usual_size / 2, far(),
            misses ? Side::negative_y : Side::all_around);
  return sheared_case(mesh, vary, misses ? known_free() : known_collision(0.5));
}

// A spike passes the straight edge (y = 0) of a block in y <= 0: outside it, inside it or on it.
Case vertex_passes(Variation& vary, std::int64_t y) {
  const auto far = [&] { return vary.between(usual_size / 2, usual_size); };
  GridMesh mesh;
  mesh.add_tetrahedron({at_rest({-far(), 0, 0}), at_rest({far(), 0, 0}),
                        at_rest({0, -usual_size - far() / 4, 0}),
                        at_rest({far() / 4, -far() / 2, -far()})});
  const GridPoint place{vary.between(-usual_size / 16, usual_size / 16), y, 0};
  add_spike(mesh, vary, falling(place, drop, -drop), usual_size / 2, far(),
            y > 0 ? Side::positive_y : Side::all_around);
  return sheared_case(mesh, vary, y > 0 ? known_free() : known_collision(0.5));
}

// An edge whose end passes the upper edge (x = 0) of a tetrahedron in x <= 0, at this x.
Case edge_passes(Variation& vary, std::int64_t x) {
  const auto far = [&] { return vary.between(usual_size / 2, usual_size); };
  GridMesh mesh;
  mesh.add_tetrahedron({at_rest({0, -far(), 0}), at_rest({0, far(), 0}),
                        at_rest({-far(), -far() / 2, -far()}),
                        at_rest({-far() / 2, far() / 2, -far()})});
  const GridPoint place{x, vary.between(-usual_size / 8, usual_size / 8), 0};
  const GridVertex end = falling(place, drop, -drop);
  mesh.add_tetrahedron({end, carried(end, {far(), far() / 4, 0}),
                        carried(end, {far(), -far() / 2, far()}),
                        carried(end, {far() / 2, far() / 2, far()})});
  return sheared_case(mesh, vary, x > 0 ? known_free() : known_collision(0.5));
}

Case grazing(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  const std::int64_t places[] = {gap, -gap, gap, -gap, 0, 0};
  const bool is_vertex = kind < 2 || kind == 4;
  return is_vertex ? vertex_passes(vary, places[kind]) : edge_passes(vary, places[kind]);
}

}  // namespace

std::vector<HardFamily> feature_families() {
  return {{"near-coplanar", "two flat tetrahedra face to face: through, turning back, gliding over",
           "height of each over the plane", "ulp", 44, -1, 44, 3, 1, near_coplanar},
          {"near-parallel", "two edges that all but line up: through, turning back, beside",
           "angle of the edges, as height over 2^45 ulp", "ulp", 44, -1, 44, 3, 1, near_parallel},
          {"slivers", "a vertex through a sliver, or as far beside it as it is wide",
           "width of a triangle 2^45 ulp long", "ulp", 44, -1, 44, 2, 2, slivers},
          {"grazing", "vertex past an edge, edge past an end: just missing, just meeting", "gap",
           "ulp", 40, -1, 40, 4, 2, grazing}};
}

}  // namespace assay::corpus
