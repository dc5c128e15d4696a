// Small cases for the tests of the reducer; nothing in them moves.
#pragma once

#include <array>
#include <vector>

#include "corpus/cases/case_file.h"
#include "oracle/mesh/loops.h"

namespace assay::properties::toys {

using corpus::Case;
using Corners = std::array<std::int32_t, 3>;

inline Case still_case(const std::vector<Corners>& triangles,
                       const std::vector<detector::Point>& points, std::size_t frames = 2) {
  Case c;
  c.frames.assign(frames, detector::Positions(static_cast<Eigen::Index>(points.size()), 3));
  for (auto& frame : c.frames) {
    for (std::size_t v = 0; v < points.size(); ++v) {
      for (int k = 0; k < 3; ++k) {
        frame(static_cast<Eigen::Index>(v), k) = points[v][static_cast<std::size_t>(k)];
      }
    }
  }
  c.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      c.triangles(static_cast<Eigen::Index>(t), i) = triangles[t][static_cast<std::size_t>(i)];
    }
  }
  return c;
}

inline Case octahedron(std::size_t frames = 2) {
  return still_case(
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
      {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}}, frames);
}

inline Case tetrahedron() {
  return still_case({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

inline bool is_closed(const Case& c) { return oracle::unmatched_edges(c.triangles).empty(); }

}  // namespace assay::properties::toys
