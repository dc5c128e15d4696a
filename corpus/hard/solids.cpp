#include "corpus/hard/solids.h"

namespace assay::corpus {

// Corners (-a, -b), (c, -d), (e, f) with a, b, c, d, f in [3/4, 1] and |e| <= 1/8 of reach. How far
// the edges stay away from the origin:
// - The lower edge stays 3/4 below.
// - The left one passes y = 0 at x = -a + (e + a) b / (b + f) <= -3/4 + 7/8 * 4/7 = -1/4. Its slope
//   is at least (3/4 + 3/4) / (1 + 1/8) = 4/3, so it stays at least 1/4 * 4/5 = 1/5 away.
std::array<GridPoint, 3> wide_face(Variation& vary, std::int64_t reach) {
  const auto far = [&] { return vary.between(3 * reach / 4, reach); };
  const std::int64_t a = far(), b = far(), c = far(), d = far(), f = far();
  const std::int64_t e = vary.between(-reach / 8, reach / 8);
  return {GridPoint{-a, -b, 0}, GridPoint{c, -d, 0}, GridPoint{e, f, 0}};
}

void add_block(GridMesh& mesh, Variation& vary, std::int64_t reach, std::int64_t depth) {
  const auto face = wide_face(vary, reach);
  const GridPoint bottom = under_the_face(vary, reach, -depth);
  mesh.add_tetrahedron({at_rest(face[0]), at_rest(face[1]), at_rest(face[2]), at_rest(bottom)});
}

void add_spike(GridMesh& mesh, Variation& vary, const GridVertex& tip, std::int64_t reach,
               std::int64_t height, Side side) {
  const auto far = [&] { return vary.between(reach / 2, reach); };
  std::array<GridPoint, 3> top;
  switch (side) {
    case Side::all_around:
      top = {GridPoint{-far(), -far()}, GridPoint{far(), -far()}, GridPoint{0, far()}};
      break;
    case Side::positive_y:
      top = {GridPoint{-far(), far()}, GridPoint{far(), far()}, GridPoint{0, reach / 4}};
      break;
    case Side::negative_y:
      top = {GridPoint{-far(), -far()}, GridPoint{far(), -far()}, GridPoint{0, -reach / 4}};
      break;
  }
  for (auto& p : top) p.z = vary.between(height, 3 * height);
  mesh.add_tetrahedron({tip, carried(tip, top[0]), carried(tip, top[1]), carried(tip, top[2])});
}

GridPoint under_the_face(Variation& vary, std::int64_t reach, std::int64_t z) {
  const std::int64_t x = vary.between(-reach / 16, reach / 16);
  return {x, vary.between(-reach / 16, reach / 16), z};
}

GridVertex falling(const GridPoint& p, std::int64_t z_t0, std::int64_t z_t1) {
  return {{p.x, p.y, z_t0}, {p.x, p.y, z_t1}};
}

KnownFacts known_free() { return {}; }

KnownFacts known_collision(double first) {
  KnownFacts known = known_collision();
  known.first_time = {first, first};
  return known;
}

KnownFacts known_collision() {
  KnownFacts known;
  known.answer = detector::Answer::collision;
  return known;
}

}  // namespace assay::corpus
