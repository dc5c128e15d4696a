#include "properties/laws/options/far_body.h"

#include <algorithm>
#include <cmath>

#include "detector/mesh/for_all.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

constexpr std::int32_t side = 112;  // vertices along each side of the sheet
static_assert(std::size_t{side} * side > 3 * detector::shared_piece);

std::int32_t vertex_of_sheet(std::int32_t i, std::int32_t j) { return side * i + j; }

void add_triangles(std::int32_t first_vertex, detector::Triangles& triangles) {
  Eigen::Index t = triangles.rows();
  triangles.conservativeResize(t + Eigen::Index{2} * (side - 1) * (side - 1), 3);
  for (std::int32_t i = 0; i + 1 < side; ++i) {
    for (std::int32_t j = 0; j + 1 < side; ++j) {
      const auto a = first_vertex + vertex_of_sheet(i, j), b = a + side;
      triangles.row(t++) << a, b, b + 1;
      triangles.row(t++) << a, b + 1, a + 1;
    }
  }
}

}  // namespace

std::optional<corpus::Case> with_far_body(corpus::Case c, double apart) {
  double largest = 0;
  for (const auto& frame : c.frames) {
    if (frame.size() > 0) largest = std::max(largest, frame.cwiseAbs().maxCoeff());
  }
  constexpr double most = 0x1p900;
  if (!(largest > 1 / most && largest < most && apart < most)) return std::nullopt;
  Random random(Random::hash(c.id), Random::hash("far body"));
  // All places of the grid are small integers times a power of two, the width of a cell.
  const int reach = std::ilogb(largest) + 1, finest = reach - random.between(0, 16);
  const double cell = std::ldexp(1, apart > 0 ? std::max(finest, std::ilogb(apart) + 2) : finest);
  const double start = cell * (std::ceil(std::ldexp(4, reach) / cell) + 4);
  const auto vertices = static_cast<std::int32_t>(c.frames.front().rows());
  for (auto& frame : c.frames) {
    const double height = random.signed_unit();
    frame.conservativeResize(vertices + side * side, 3);
    for (std::int32_t i = 0; i < side; ++i) {
      for (std::int32_t j = 0; j < side; ++j) {
        const double u = i - side / 2, v = j - side / 2;
        frame.row(vertices + vertex_of_sheet(i, j)) << start + cell * i, cell * v,
            cell * (height + (u * u + v * v) / side);
      }
    }
  }
  add_triangles(vertices, c.triangles);
  if (c.counted) {
    auto& [pairs, steps] = *c.counted;
    steps.clear();
    if (!pairs.body.empty()) {
      const auto fresh = *std::max_element(pairs.body.begin(), pairs.body.end()) + 1;
      pairs.body.resize(static_cast<std::size_t>(c.frames.front().rows()), fresh);
    }
    if (!pairs.rest.empty()) {
      const auto at_rest = corpus::points_of(c.frames.front());
      pairs.rest.insert(pairs.rest.end(), at_rest.begin() + vertices, at_rest.end());
    }
  }
  c.expected = {};
  c.view.reset();
  c.ghosts.reset();
  return c;
}

}  // namespace assay::properties
