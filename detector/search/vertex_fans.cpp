#include "detector/search/vertex_fans.h"

#include "detector/mesh/for_all.h"
#include "detector/search/feature_pairs.h"

namespace assay::detector {
namespace {

// The bits that a triangle contributes to the fans of its corners: bit k, that it is seen from
// above along axis k; bit 3 + k, from below; bit 6 + 3 i + k, that along axis k the corner after i
// is below corner i, and the one before i is not.
using Sides = std::uint16_t;
constexpr unsigned axes = 7;

unsigned bits_of(LaneTruth truth) {
  unsigned bits = 0;
#ifdef __SSE__
  bits = static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(truth)));
#else
  for (int k = 0; k < 3; ++k) bits |= static_cast<unsigned>(truth[k] & 1) << k;
#endif
  return bits & axes;
}

FloatLanes next_axes(FloatLanes a) { return FloatLanes{a[1], a[2], a[0], a[3]}; }

FloatLanes cross(FloatLanes a, FloatLanes b) {
  return next_axes(a * next_axes(b) - next_axes(a) * b);
}

FloatLanes size_of(FloatLanes a) { return greatest(a, -a); }

// Returns the sides. A triangle that is seen from one side is seen from there throughout the step.
// Positions are floats of the grid, off by e = 2^-23 at most (its radius is 1, and the third of
// three roundings is that to float). S_k is the greatest size of an edge along axis k, as computed,
// at most 4. An edge is off by 2 e and by its own rounding, 2^-24 S_k: by d = 2^-21 at most. The
// component a_i b_j - a_j b_i of the normal is off by 2 d (S_i + S_j) + 2 d^2, and by the roundings
// of its two products and of their difference, 2^-22 S_i S_j <= 2^-20 min(S_i, S_j): by less than
// 2^-19 (S_i + S_j) + 2^-41. Twice the middle coefficient is a sum of two such components; it is
// off by twice that, and by its own rounding, at most 2^-22 S_i S_j: by less than (1 + 2^-2) 2^-18
// (S_i + S_j) + 2^-40. The code compares with 2^-17 (S_i + S_j) + 2^-39; its own two roundings are
// 2^-23 of it. So all three coefficients have the sign that is compared, and the normal, which lies
// between them, has it throughout.
Sides sides_of(const std::array<std::int32_t, 3>& triangle, const FeaturePoints& points) {
  const std::array<FloatLanes, 3> corners = {points.start(triangle[0]).axes,
                                             points.start(triangle[1]).axes,
                                             points.start(triangle[2]).axes};
  const FloatLanes p = corners[1] - corners[0], q = corners[2] - corners[0],
                   origin = points.end(triangle[0]).axes,
                   p_end = points.end(triangle[1]).axes - origin,
                   q_end = points.end(triangle[2]).axes - origin;
  const FloatLanes size =
      greatest(greatest(size_of(p), size_of(q)), greatest(size_of(p_end), size_of(q_end)));
  constexpr float of_sizes = 0x1p-17f, least_bound = 0x1p-39f;
  const FloatLanes one = next_axes(size), bound = of_sizes * (one + next_axes(one)) + least_bound;
  const FloatLanes start = cross(p, q), middle = cross(p, q_end) + cross(p_end, q),
                   end = cross(p_end, q_end);
  const FloatLanes lowest = least(least(start, middle), end),
                   highest = greatest(greatest(start, middle), end);
  unsigned sides = bits_of(lowest > bound) | bits_of(highest < -bound) << 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const FloatLanes here = corners[i], after = corners[(i + 1) % 3], before = corners[(i + 2) % 3];
    sides |= bits_of((after < here) & (before >= here)) << (6 + 3 * i);
  }
  return static_cast<Sides>(sides);
}

}  // namespace

void VertexFans::prove(const Topology& mesh, const FeaturePoints& points, PacedStop* pace) {
  if (pace && pace->stopped()) return;  // the points may not be there
  constexpr std::uint64_t work_of_look = 3, work_of_fan = 5;
  std::vector<Sides> sides(mesh.triangles.size());
  const auto look = [&](std::size_t t) { sides[t] = sides_of(mesh.triangles[t], points); };
  std::vector<std::uint8_t> is_proved(mesh.vertex_triangles.starts.size() - 1);
  const auto settle = [&](std::size_t number) {
    const auto v = static_cast<std::int32_t>(number);
    unsigned fan = axes | axes << 3, once = 0, twice = 0;
    for (const auto t : mesh.vertex_triangles.row(v)) {
      const auto& corners = mesh.triangles[at(t)];
      const unsigned corner = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
      const unsigned counted = unsigned{sides[at(t)]} >> (6 + 3 * corner) & axes;
      fan &= sides[at(t)];
      twice |= once & counted;
      once |= counted;
    }
    // A fan that is seen along an axis is counted by the next axis.
    const unsigned around_once = once & ~twice;
    is_proved[number] = ((fan | fan >> 3) & (around_once >> 1 | around_once << 2) & axes) != 0;
  };
  if (!for_all_paced(sides.size(), work_of_look, pace, look) ||
      !for_all_paced(is_proved.size(), work_of_fan, pace, settle)) {
    return;
  }
  for (const auto& [edge, surplus] : mesh.unmatched) {
    for (const auto v : mesh.edges[at(edge)]) is_proved[at(v)] = 0;
  }
  auto proved = std::make_unique_for_overwrite<Corners[]>(sides.size());
  const auto keep = [&](std::size_t t) {
    const auto none = ~static_cast<std::int32_t>(t);
    const auto corner = [&](std::int32_t v) { return is_proved[at(v)] ? v : none; };
    const auto& [u, v, w] = mesh.triangles[t];
    proved[t] = Corners{corner(u), corner(v), corner(w), none};
  };
  if (for_all_paced(sides.size(), 1, pace, keep)) proved_ = std::move(proved);
}

}  // namespace assay::detector
