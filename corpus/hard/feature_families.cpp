#include "corpus/hard/hard_families.h"

namespace assay::corpus {

// Features that are nearly in one plane, nearly parallel, nearly without area, or pass each other
// by a hair. Grazing gaps go from 2^40 ulp down to one, both sides.
namespace {

constexpr std::int64_t drop = usual_size / 4;

// Returns a flat spike over a flat block. All eight vertices are within a few gaps of one plane,
// and the tip is within two gaps of it all the time.
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

// Returns two tetrahedra, the lower edge of one over the upper edge of the other. The edges cross
// over the origin, at an angle of about gap / usual_size. In kind 2 they would cross only beyond
// their ends, because y is at most gap in the one and at least twice that in the other.
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

// Returns a face of this width and the usual length. By kind, a spike comes down through it, as far
// beside its long edge as the face is wide, on that edge, or on its far corner.
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

// Returns a spike that passes the straight edge (y = 0) of a block in y <= 0: outside it, inside it
// or on it.
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

// Returns an edge whose end passes the upper edge (x = 0) of a tetrahedron in x <= 0, at this x.
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
  return {{"near-coplanar", "a flat tetrahedron goes through another, turns back or glides over it",
           "height of each tetrahedron", "ulp", 44, -1, 44, 3, 1, near_coplanar},
          {"near-parallel", "one of two nearly parallel edges crosses the other or misses it",
           "angle between the edges times 2^45 ulp", "ulp", 44, -1, 44, 3, 1, near_parallel},
          {"slivers", "a vertex goes through a sliver, or passes one width beside it",
           "width of a sliver of length 2^45 ulp", "ulp", 44, -1, 44, 2, 2, slivers},
          {"grazing", "a spike's tip or an edge's end just misses or meets an edge", "gap", "ulp",
           40, -1, 40, 4, 2, grazing}};
}

// Many things at once: contacts at one time, copies of vertices and triangles, sheets in one
// plane.
namespace {

// Returns spikes side by side over one face. By kind, all go through it at half time, all stop well
// above it, or all touch it at the end.
Case simultaneous(Variation& vary, int exponent, int kind) {
  const int spikes = 1 << exponent;
  constexpr int columns = 8;
  constexpr std::int64_t cell = usual_size / 64, depth = usual_size / 16;
  GridMesh mesh;
  add_block(mesh, vary, usual_size, usual_size);
  const std::int64_t end[] = {-depth, depth / 4, 0};
  for (int i = 0; i < spikes; ++i) {
    const GridPoint place{cell * (i % columns - columns / 2), cell * (i / columns - columns / 2),
                          0};
    add_spike(mesh, vary, falling(place, depth, end[kind]), cell / 4, usual_size / 8,
              Side::all_around);
  }
  constexpr double first[] = {0.5, 0, 1};
  return sheared_case(mesh, vary, kind == 1 ? known_free() : known_collision(first[kind]));
}

// Returns a triangle that tilts, and a copy of it with vertices of its own, at a height above it
// that goes from z_t0 to z_t1. While the height is not 0 the two do not meet, because neither ever
// stands upright.
Case copies(Variation& vary, std::int64_t z_t0, std::int64_t z_t1, KnownFacts facts) {
  GridMesh mesh;
  std::array<GridVertex, 3> corners, copy;
  const auto face = wide_face(vary, usual_size);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t start = vary.between(-usual_size / 2, usual_size / 2);
    corners[i] = falling(face[i], start, vary.between(-usual_size / 2, usual_size / 2));
    copy[i] = {corners[i].t0 + GridPoint{0, 0, z_t0}, corners[i].t1 + GridPoint{0, 0, z_t1}};
  }
  mesh.add_triangle(corners);
  mesh.add_triangle(copy);
  return sheared_case(mesh, vary, std::move(facts));
}

Case duplicates(Variation& vary, int exponent, int kind) {
  const std::int64_t gap = two_to(exponent);
  const std::int64_t start[] = {gap, gap, 0, gap}, end[] = {gap, -gap, 0, 0};
  constexpr double first[] = {0, 0.5, 0, 1};
  if (kind < 4) {
    return copies(vary, start[kind], end[kind],
                  kind == 0 ? known_free() : known_collision(first[kind]));
  }
  // A spike whose four triangles have vertices of their own: neighbours meet along open seams.
  GridMesh closed, mesh;
  add_spike(closed, vary, falling(under_the_face(vary, usual_size, 0), gap, 0), usual_size / 2, gap,
            Side::all_around);
  const auto corner = [&](std::int32_t v) { return closed.vertices[static_cast<std::size_t>(v)]; };
  for (const auto& t : closed.triangles) {
    mesh.add_triangle({corner(t[0]), corner(t[1]), corner(t[2])});
  }
  return sheared_case(mesh, vary, known_collision(0));
}

// Returns a sheet in one plane, its vertices up to an eighth of a cell off a grid. In kind 0 it
// moves within the plane, all in one direction. In kind 1 one vertex goes to where its second
// neighbour is, over the first one, which it reaches at half time; here the vertices around are not
// moved off the grid. Until then it is inside the hexagon of its neighbours, which stays convex, so
// nothing overlaps.
Case coplanar_sheet(Variation& vary, int exponent, int kind) {
  const int rows = 1 << ((exponent - 1) / 2), columns = 1 << (exponent - 1 - (exponent - 1) / 2);
  const std::int64_t cell = usual_size / columns;
  const int i_moved = columns / 2 - 1, j_moved = rows / 2;
  const GridPoint moved{kind == 0 ? vary.between(-usual_size, usual_size) : 0,
                        kind == 0 ? vary.between(-usual_size, usual_size) : 0, 0};
  GridMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const bool beside = std::abs(i - i_moved) <= 2 && std::abs(j - j_moved) <= 1;
      const auto off = [&] { return kind == 1 && beside ? 0 : vary.between(-cell / 8, cell / 8); };
      const std::int64_t x = cell * i - usual_size / 2 + off();
      const GridPoint p{x, cell * j - usual_size / 2 + off(), 0};
      GridVertex vertex{p, p + moved};
      if (kind == 1 && i == i_moved && j == j_moved) vertex.t1.x += 2 * cell;
      mesh.add(vertex);
    }
  }
  const auto index = [&](int i, int j) { return static_cast<std::int32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  Case c = sheared_case(mesh, vary, kind == 0 ? known_free() : known_collision(0.5));
  // The culling is view-auto, because under a culling that always uses views every ghost of a flat
  // sheet would be swept against every triangle, which takes n^1.5.
  c.options["culling"] = "view-auto";
  return c;
}

}  // namespace

std::vector<HardFamily> crowd_families() {
  return {{"simultaneous", "spikes move to one face together; all go through it, or none",
           "number of contacts at one time", "", 0, 1, 6, 2, 1, simultaneous},
          {"duplicates", "a triangle and its copy stay apart or go through each other",
           "distance of the copies", "ulp", 40, -1, 40, 2, 3, duplicates},
          {"coplanar", "a sheet stays in its plane, or one of its vertices folds over", "triangles",
           "", 5, 1, 7, 2, 0, coplanar_sheet}};
}

}  // namespace assay::corpus
