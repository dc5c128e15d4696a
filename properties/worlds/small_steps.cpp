#include "properties/worlds/small_steps.h"

#include <array>
#include <vector>

#include "properties/generators/draft.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using Faces = std::vector<std::array<std::int32_t, 3>>;

struct MeshFamily {
  const char* name;
  int vertices;
  Faces faces;
};

Faces bipyramid(int sides) {
  Faces faces;
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    faces.push_back({i, j, sides});
    faces.push_back({j, i, sides + 1});
  }
  return faces;
}

Faces shifted(const Faces& faces, int offset) {
  Faces out = faces;
  for (auto& f : out) {
    for (auto& v : f) v += offset;
  }
  return out;
}

Faces join(Faces a, const Faces& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Faces tetrahedron = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

const std::vector<MeshFamily>& families() {
  static const std::vector<MeshFamily> all = {
      {"tetrahedron", 4, tetrahedron},
      {"bipyramid", 5, bipyramid(3)},
      {"octahedron", 6, bipyramid(4)},
      {"two tetrahedra", 8, join(tetrahedron, shifted(tetrahedron, 4))},
      {"two tetrahedra at an edge",
       6,
       {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}}},
      {"two tetrahedra at a vertex",
       7,
       {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 5, 4}, {0, 4, 6}, {0, 6, 5}, {4, 5, 6}}},
      {"open tetrahedron", 4, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}}},
      {"two triangles", 6, {{0, 1, 2}, {3, 4, 5}}},
      {"two triangles at a vertex", 5, {{0, 1, 2}, {0, 3, 4}}},
      {"two triangles at an edge", 4, {{0, 1, 2}, {1, 0, 3}}},
      {"three triangles at an edge", 5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}},
      {"tetrahedron and triangle", 7, join(tetrahedron, {{4, 5, 6}})},
  };
  return all;
}

// Draws one of four motions: nothing moves, one vertex moves, all vertices translate, or every
// vertex goes its own way.
void move(Random& random, int reach, const Positions& x_t0, Positions& x_t1) {
  x_t1 = x_t0;
  const auto n = static_cast<int>(x_t0.rows());
  const int kind = random.below(8);
  if (kind == 0) return;
  const auto jump = [&](int v) {
    const auto p = integer_point(random, reach);
    for (int k = 0; k < 3; ++k) x_t1(v, k) = p[static_cast<std::size_t>(k)];
  };
  if (kind <= 3) {
    jump(random.below(n));
  } else if (kind == 4) {
    const auto offset = integer_point(random, 2);
    for (int v = 0; v < n; ++v) {
      for (int k = 0; k < 3; ++k) x_t1(v, k) += offset[static_cast<std::size_t>(k)];
    }
  } else {
    for (int v = 0; v < n; ++v) jump(v);
  }
}

}  // namespace

SmallStep make_small_step(std::uint64_t seed, std::uint64_t index) {
  Random random(seed, index);
  const MeshFamily& family = one_of(random, families());
  SmallStep step;
  step.family = family.name;
  step.triangles = as_rows<Triangles>(family.faces);
  const bool inward = random.below(8) == 0;
  if (inward) step.triangles = step.triangles.rowwise().reverse().eval();
  // A flat menu makes coplanar motion frequent, and a small reach makes coincident points
  // frequent.
  const int reach = random.between(1, 5);
  const bool flat = random.below(6) == 0;
  Points places;
  for (int v = 0; v < family.vertices; ++v) places.push_back(integer_point(random, reach));
  step.x_t0 = as_rows<Positions>(places);
  move(random, reach, step.x_t0, step.x_t1);
  if (flat) {
    step.x_t0.col(2).setZero();
    step.x_t1.col(2).setZero();
  }
  const auto q = integer_point(random, reach);
  step.point.q0 = step.point.q1 = {q, random.below(2) ? q : integer_point(random, reach)};
  const auto q0 = integer_point(random, reach), q1 = integer_point(random, reach);
  const int line_motion = random.below(3);
  step.line.q0 = {q0, q0};
  step.line.q1 = {q1, line_motion == 0 ? q1 : integer_point(random, reach)};
  if (line_motion == 2) step.line.q0.t1 = integer_point(random, reach);
  return step;
}

}  // namespace assay::properties
