
#include "detector/geometry/near_regions.h"

#include <algorithm>
#include <span>

#include "detector/exact/polynomial.h"
#include "detector/geometry/orientation.h"

namespace assay::detector {
namespace {

// Returns whether the features of four points, the first `first_group` of them and the others, are
// nearer to each other than r.
bool are_nearer(const std::array<const Point*, 4>& input, int first_group, double r) {
  std::array<double, 13> values;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = (*input[i])[k];
  }
  values[12] = r;
  std::array<Integer, 13> scaled;
  to_common_integers(values, scaled);
  std::array<std::array<Integer, 3>, 4> points;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) points[i][k] = scaled[3 * i + k];
  }
  const Integer squared = scaled[12] * scaled[12];
  return some_region_holds(NearRegions<Integer>(points, first_group, squared), Near::nearer);
}

// Returns true only if the two boxes are at least r apart. A rounded difference above r is above it
// before rounding too, because rounding keeps the order of numbers and r is a double.
bool boxes_are_apart(std::span<const Point> a, std::span<const Point> b, double r) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto less = [k](const Point& x, const Point& y) { return x[k] < y[k]; };
    const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
    const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
    if ((*low_b)[k] - (*high_a)[k] > r || (*low_a)[k] - (*high_b)[k] > r) return true;
  }
  return false;
}

}  // namespace

bool vertex_is_nearer_to_face(const Point& p, const std::array<Point, 3>& face, double r) {
  if (boxes_are_apart({&p, 1}, face, r)) return false;
  return are_nearer({&p, &face[0], &face[1], &face[2]}, 1, r);
}

bool edges_are_nearer(const std::array<Point, 2>& first, const std::array<Point, 2>& second,
                      double r) {
  if (boxes_are_apart(first, second, r)) return false;
  return are_nearer({&first[0], &first[1], &second[0], &second[1]}, 2, r);
}

bool triangles_are_nearer(const std::array<Point, 3>& a, const std::array<Point, 3>& b, double r) {
  if (boxes_are_apart(a, b, r)) return false;
  const auto edge = [](const std::array<Point, 3>& of, std::size_t i) {
    return std::array<Point, 2>{of[i], of[(i + 1) % 3]};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (vertex_is_nearer_to_face(a[i], b, r) || vertex_is_nearer_to_face(b[i], a, r)) return true;
    for (std::size_t j = 0; j < 3; ++j) {
      if (edges_are_nearer(edge(a, i), edge(b, j), r)) return true;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto of_a = edge(a, i), of_b = edge(b, i);
    if (segment_pierces_triangle(of_a[0], of_a[1], b) ||
        segment_pierces_triangle(of_b[0], of_b[1], a)) {
      return true;
    }
  }
  return false;
}

}  // namespace assay::detector
