// With w the inverse-distance weights and y the offsets of the vertices from the point, the change
// of least sum(change^2 / w) that makes sum(y) zero and keeps the sum 1 is
//   change_i = w_i (a + b . y_i),   [ 1    m^T ] [a]   [ 0]
//                                   [ m    C   ] [b] = [-m],   m = sum w y,  C = sum w y y^T.
#include "detector/view/affine_weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace assay::detector {
namespace {

using Row = std::array<double, 5>;  // four unknowns and the right side

// Gaussian elimination with full pivoting. Unknowns whose pivot is below `least` times the first
// pivot become 0.
std::array<double, 4> solve(std::array<Row, 4> rows, double least) {
  std::array<std::size_t, 4> column = {0, 1, 2, 3};
  std::size_t rank = 0;
  double first = 0;
  for (; rank < 4; ++rank) {
    std::size_t r = rank, c = rank;
    for (std::size_t i = rank; i < 4; ++i) {
      for (std::size_t k = rank; k < 4; ++k) {
        if (std::abs(rows[i][column[k]]) > std::abs(rows[r][column[c]])) r = i, c = k;
      }
    }
    std::swap(rows[rank], rows[r]);
    std::swap(column[rank], column[c]);
    const double pivot = rows[rank][column[rank]];
    if (rank == 0) first = std::abs(pivot);
    if (!(std::abs(pivot) > least * first)) break;
    for (std::size_t i = rank + 1; i < 4; ++i) {
      const double factor = rows[i][column[rank]] / pivot;
      for (std::size_t k = rank; k < 4; ++k) {
        rows[i][column[k]] -= factor * rows[rank][column[k]];
      }
      rows[i][4] -= factor * rows[rank][4];
    }
  }
  std::array<double, 4> x = {0, 0, 0, 0};
  for (std::size_t i = rank; i-- > 0;) {
    double sum = rows[i][4];
    for (std::size_t k = i + 1; k < rank; ++k) sum -= rows[i][column[k]] * x[column[k]];
    x[column[i]] = sum / rows[i][column[i]];
  }
  return x;
}

constexpr std::size_t direction_count = 54;

// The number of the cell that the offset points to, on the surface of a cube with 3 x 3 cells on
// each face.
std::size_t direction_of(const Point& y) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(y[k]) > std::abs(y[axis])) axis = k;
  }
  const double third = std::abs(y[axis]) / 3;
  const auto cell = [third](double c) -> std::size_t { return c < -third ? 0 : c > third ? 2 : 1; };
  const std::size_t face = 2 * axis + (y[axis] < 0 ? 1 : 0);
  return 9 * face + 3 * cell(y[(axis + 1) % 3]) + cell(y[(axis + 2) % 3]);
}

double squared_length(const Point& y) { return y[0] * y[0] + y[1] * y[1] + y[2] * y[2]; }

struct Neighbour {
  std::int32_t vertex = -1;
  Point offset{};
  double distance2 = 0;
};

std::vector<Neighbour> neighbours_around(std::span<const std::int32_t> vertices,
                                         std::span<const Point> points, const Point& point) {
  std::array<Neighbour, direction_count> nearest;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point y = {points[i][0] - point[0], points[i][1] - point[1], points[i][2] - point[2]};
    const double distance2 = squared_length(y);
    Neighbour& best = nearest[direction_of(y)];
    if (best.vertex < 0 || distance2 < best.distance2) best = {vertices[i], y, distance2};
  }
  std::vector<Neighbour> found;
  for (const auto& n : nearest) {
    if (n.vertex >= 0) found.push_back(n);
  }
  return found;
}

void correct(const std::vector<Neighbour>& around, std::vector<double>& weights) {
  std::array<Row, 4> rows{};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto& y = around[i].offset;
    const std::array<double, 4> a = {1, y[0], y[1], y[2]};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = 0; c < 4; ++c) rows[r][c] += weights[i] * a[r] * a[c];
    }
  }
  for (std::size_t r = 1; r < 4; ++r) rows[r][4] = -rows[r][0];
  constexpr double least_pivot = 1e-6;
  const auto x = solve(rows, least_pivot);
  std::vector<double> corrected = weights;
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto& y = around[i].offset;
    corrected[i] += weights[i] * (x[0] + x[1] * y[0] + x[2] * y[1] + x[3] * y[2]);
    sum += corrected[i];
    size += std::abs(corrected[i]);
  }
  constexpr double most = 8;  // a point far outside would swing with every vertex
  if (!(size < most && sum > 0.5)) return;
  for (double& w : corrected) w /= sum;
  weights = std::move(corrected);
}

}  // namespace

AffineWeights affine_weights(std::span<const std::int32_t> vertices, std::span<const Point> points,
                             const Point& point) {
  const std::vector<Neighbour> around = neighbours_around(vertices, points, point);
  constexpr double least_distance2 = 1e-12;
  double sum = 0;
  std::vector<double> weights;
  for (const auto& n : around) {
    weights.push_back(1 / std::max(n.distance2, least_distance2));
    sum += weights.back();
  }
  for (double& w : weights) w /= sum;
  correct(around, weights);
  AffineWeights affine;
  for (const auto& n : around) affine.vertices.push_back(n.vertex);
  affine.weights = std::move(weights);
  return affine;
}

Point combine(const AffineWeights& affine, const PositionsView& x) {
  // The sum is one of offsets from one vertex, so that translating all vertices translates the
  // point, as far as doubles go.
  const Point base = point_of(x, affine.vertices[0]);
  Point q = base;
  for (std::size_t k = 0; k < 3; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < affine.vertices.size(); ++i) {
      const double c = x(affine.vertices[i], static_cast<Eigen::Index>(k));
      sum += affine.weights[i] * (c - base[k]);
    }
    q[k] = base[k] + sum;
    if (!std::isfinite(q[k])) q[k] = base[k];  // near the ends of the doubles
  }
  return q;
}

}  // namespace assay::detector
