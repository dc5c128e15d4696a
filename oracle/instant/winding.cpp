#include "oracle/instant/winding.h"

#include <cmath>
#include <limits>

#include "oracle/instant/instant_contacts.h"

namespace assay::oracle {

namespace {

using detector::Point;

// Directions of rays are (2^20, k, k^2), k = 1, 2, ... No plane through the origin holds three of
// them, so each edge of the cycle spoils at most two, and some direction meets no edge.
constexpr int run_exponent = 20;

IntegerPoint direction_vector(int k) {
  return {Integer(1) << run_exponent, Integer(k), Integer(k) * k};
}

Integer determinant(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c) {
  return dot(a, cross(b, c));
}

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

// The farthest that a ray in direction (2^20, s) rises over `run`, rounded up.
double rise(double run, double s) {
  constexpr double rounding_slack =
      1 + 0x1p-10;  // for the roundings of three operations: far below 2^-50
  return up(run * std::ldexp(s, -run_exponent) * rounding_slack);
}

}  // namespace

// A ray starts at point / weight in the units of the instant; the box of doubles `start` holds
// that place.
struct WindingField::Ray {
  IntegerPoint point;
  Integer weight;
  Box start;

  IntegerPoint to(const IntegerPoint& x) const {
    IntegerPoint v;
    for (int k = 0; k < 3; ++k) v[k] = x[k] * weight - point[k];
    return v;
  }
};

WindingField::WindingField(const Instant& instant, detector::Triangles cycle)
    : instant_(instant), cycle_(std::move(cycle)) {
  std::vector<Box> boxes;
  boxes.reserve(static_cast<std::size_t>(cycle_.rows()));
  for (Eigen::Index t = 0; t < cycle_.rows(); ++t) {
    boxes.push_back(instant_.box_of(std::array{cycle_(t, 0), cycle_(t, 1), cycle_(t, 2)}));
    if (t == 0) bounds_ = boxes[0];
    for (int k = 0; k < 3; ++k) {
      bounds_.min[k] = std::min(bounds_.min[k], boxes.back().min[k]);
      bounds_.max[k] = std::max(bounds_.max[k], boxes.back().max[k]);
    }
  }
  tree_ = std::make_unique<BoxTree>(boxes);
}

std::optional<int> WindingField::at(const Point& point) const {
  return at(RationalPoint{mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])});
}

std::optional<int> WindingField::at(const RationalPoint& point) const {
  if (cycle_.rows() == 0) return 0;
  for (int k = 0; k < 3; ++k) {
    if (point[k] < mpq_class(bounds_.min[k]) || point[k] > mpq_class(bounds_.max[k])) return 0;
  }
  Ray ray;
  ray.weight = 1;
  RationalPoint scaled;
  for (int k = 0; k < 3; ++k) {
    scaled[k] = instant_.in_units(point[k]);
    ray.weight *= scaled[k].get_den();
    // get_d truncates, so the place is at this double or beyond it, before the next one.
    const double d = point[k].get_d();
    ray.start.min[k] = std::nextafter(d, -std::numeric_limits<double>::infinity());
    ray.start.max[k] = up(d);
  }
  for (int k = 0; k < 3; ++k) {
    const mpq_class whole = scaled[k] * ray.weight;
    ray.point[k] = whole.get_num();
  }
  if (on_surface(ray)) return std::nullopt;
  for (int direction = 1;; ++direction) {
    if (const auto w = crossings(ray, direction, -1)) return w;
  }
}

Layer WindingField::layer_of(std::int32_t triangle) const {
  const std::array<std::int32_t, 3> corner = {cycle_(triangle, 0), cycle_(triangle, 1),
                                              cycle_(triangle, 2)};
  const auto& x = instant_.points();
  Ray ray;
  ray.weight = 3;
  ray.start = instant_.box_of(corner);
  for (int k = 0; k < 3; ++k) {
    ray.point[k] = x[corner[0]][k] + x[corner[1]][k] + x[corner[2]][k];
  }
  const IntegerPoint normal = cross(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]]);
  for (int direction = 1;; ++direction) {
    const int side = sgn(dot(direction_vector(direction), normal));
    if (side == 0) continue;
    // Without the triangle itself the count is the winding number on the side of the ray.
    if (const auto w = crossings(ray, direction, triangle)) {
      return side > 0 ? Layer{*w + 1, *w} : Layer{*w, *w - 1};
    }
  }
}

// The sum of the crossings ahead, without those of triangle `skipped`. Nothing when the line of
// the ray meets an edge, or lies in the plane of a triangle.
std::optional<int> WindingField::crossings(const Ray& ray, int direction,
                                           std::int32_t skipped) const {
  const IntegerPoint d = direction_vector(direction);
  const double run = up(bounds_.max[0] - ray.start.min[0]);
  Box path = ray.start;
  path.max[0] = std::max(path.max[0], bounds_.max[0]);
  path.max[1] = up(path.max[1] + rise(run, direction));
  path.max[2] = up(path.max[2] + rise(run, static_cast<double>(direction) * direction));
  std::vector<std::int32_t> met;
  tree_->meeting(path, met);

  int w = 0;
  const auto& x = instant_.points();
  for (const std::int32_t t : met) {
    if (t == skipped) continue;
    const IntegerPoint a = ray.to(x[cycle_(t, 0)]), b = ray.to(x[cycle_(t, 1)]),
                       c = ray.to(x[cycle_(t, 2)]);
    const int ab = sgn(determinant(d, a, b)), bc = sgn(determinant(d, b, c)),
              ca = sgn(determinant(d, c, a));
    if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) continue;
    if (ab != 0 && ab == bc && bc == ca) {
      // The line crosses the inside, and d.N has the sign ab. The crossing is ahead when a.N has
      // it too.
      if (sgn(determinant(a, b, c)) == ab) w += ab;
      continue;
    }
    const IntegerPoint normal = cross(b - a, c - a);
    const bool zero_area = normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
    if (!zero_area) return std::nullopt;
  }
  return w;
}

bool WindingField::on_surface(const Ray& ray) const {
  std::vector<std::int32_t> met;
  tree_->meeting(ray.start, met);
  const IntegerPoint here = {0, 0, 0};
  for (const std::int32_t t : met) {
    std::array<IntegerPoint, 4> points = {here};
    for (int i = 0; i < 3; ++i) points[i + 1] = ray.to(instant_.points()[cycle_(t, i)]);
    if (vertex_meets_face(points, 0, {1, 2, 3})) return true;
  }
  return false;
}

}  // namespace assay::oracle
