// L18: a mesh keeps its contacts if edges are split in all of their triangles, as long as no split
// triangle loses its area.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "properties/changes/changes.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using Corners = std::array<std::int32_t, 3>;

// Returns whether the area vector N(t) vanishes at no time of the step: along some axis its three
// Bernstein coefficients have one strict sign. Each is a sum of four products of two differences at
// most; the differences, products and sums have less than 8 roundings, so 2^-40 of the sizes covers
// them.
bool surely_keeps_area(const Corners& v, const Positions& x_t0, const Positions& x_t1) {
  using Vector = Eigen::RowVector3d;
  const Vector a0 = x_t0.row(v[1]) - x_t0.row(v[0]), b0 = x_t0.row(v[2]) - x_t0.row(v[0]);
  const Vector a1 = x_t1.row(v[1]) - x_t1.row(v[0]), b1 = x_t1.row(v[2]) - x_t1.row(v[0]);
  const Vector coefficients[] = {a0.cross(b0), a0.cross(b1) + a1.cross(b0), a1.cross(b1)};
  const double size = std::max(a0.cwiseAbs().maxCoeff(), a1.cwiseAbs().maxCoeff()) *
                      std::max(b0.cwiseAbs().maxCoeff(), b1.cwiseAbs().maxCoeff());
  if (!std::isfinite(size) || size < 0x1p-900) return false;
  for (Eigen::Index k = 0; k < 3; ++k) {
    int above = 0, below = 0;
    for (const auto& n : coefficients) {
      above += n[k] > 0x1p-40 * size ? 1 : 0;
      below += n[k] < -0x1p-40 * size ? 1 : 0;
    }
    if (above == 3 || below == 3) return true;
  }
  return false;
}

// Returns a + w (b - a) for a dyadic w in (0,1), if that is a double. Nothing if a or b is so small
// that fma could lose the rounding error.
std::optional<double> exactly_between(double a, double b, double w) {
  const double of_a = (1 - w) * a, of_b = w * b;
  double sum = 0;
  const auto is_small = [](double x) { return x != 0 && std::abs(x) < 0x1p-900; };
  if (is_small(a) || is_small(b)) return std::nullopt;
  const bool is_scaled = std::fma(1 - w, a, -of_a) == 0 && std::fma(w, b, -of_b) == 0;
  if (!is_scaled || !adds_exactly(of_a, of_b, sum)) return std::nullopt;
  return sum;
}

// Splits the edge of a triangle that is opposite to corner k. False if that cannot be done exactly,
// or if a triangle of the edge may lose its area in some step; then nothing has changed.
bool split(Form& form, Eigen::Index triangle, int k, double w) {
  auto& triangles = form.c.triangles;
  auto& frames = form.c.frames;
  const auto u = triangles(triangle, (k + 1) % 3), v = triangles(triangle, (k + 2) % 3);
  std::vector<Eigen::Index> around;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto row = triangles.row(t);
    if ((row.array() == u).any() && (row.array() == v).any()) around.push_back(t);
  }
  for (const auto t : around) {
    const Corners corners = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    for (const auto& step : form.c.script) {
      if (!surely_keeps_area(corners, frames[at(step.from)], frames[at(step.to)])) return false;
    }
  }
  const auto middle = static_cast<std::int32_t>(frames[0].rows());
  auto longer = frames;
  for (auto& frame : longer) {
    frame.conservativeResize(middle + 1, 3);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto between = exactly_between(frame(u, axis), frame(v, axis), w);
      if (!between) return false;
      frame(middle, axis) = *between;
    }
  }
  frames = std::move(longer);
  for (const auto t : around) {
    const auto new_triangle = triangles.rows();
    triangles.conservativeResize(new_triangle + 1, 3);
    triangles.row(new_triangle) = triangles.row(t);
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (triangles(t, i) == v) triangles(t, i) = middle;
      if (triangles(new_triangle, i) == u) triangles(new_triangle, i) = middle;
    }
    form.parent.push_back(form.parent[static_cast<std::size_t>(t)]);
  }
  return true;
}

// Splits some edges. Why contacts stay: a contact is closed faces without a common vertex that
// meet. Let two such faces of two triangles meet at x. In each triangle x lies in a part, on a face
// of that part whose vertices are vertices of the whole face or split points. A split point is
// common to two parts only if both triangles have the split edge, and two faces without a common
// vertex do not both hold it. Conversely, let parts meet in faces without a common vertex. Their
// triangles meet there too. If these have a vertex p in common, and the one part meets the other at
// a split point m of an edge (p,q), follow the edge from m towards q. It leaves the other triangle,
// which is convex, at q or through a face without p. Either is a contact of the two triangles at
// the same time. So contacts and their times stay; only the parts that are named may differ. A
// triangle without area may meet itself in its parts, which is why none is split.
std::optional<Form> split_some_edges(const Case& c, Random& random) {
  Form form = unchanged(c);
  const int count = random.between(1, 4);
  int splits = 0;
  for (int tries = 0; tries < 4 * count && splits < count; ++tries) {
    const auto triangle = random.below(static_cast<int>(form.c.triangles.rows()));
    const int corner = random.below(3);
    constexpr double shares[] = {0.5, 0.5, 0.25, 0.75};
    const double share = shares[random.below(4)];
    splits += split(form, triangle, corner, share) ? 1 : 0;
  }
  return splits > 0 ? std::optional(form) : std::nullopt;
}

}  // namespace

const CaseChange changes::split_edges = {"refined", split_some_edges};

}  // namespace assay::properties
