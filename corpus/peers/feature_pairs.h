// What the peers have in common: their elementary tests, put to every vertex and face and every two
// edges of the pairs of triangles whose swept boxes meet. Features that share a vertex are not
// tested. A pair's first time is the least of its tests.
#pragma once

#include <algorithm>
#include <optional>

#include "detector/plugin/assay_detector.hpp"

namespace assay::peers {

// Four points of a step: a vertex and the corners of a face, or the ends of two edges.
struct FourPaths {
  const double* at[2][4];  // at t = 0 and at t = 1
};

// `Tests` has `std::optional<plugin::Interval> vertex_face(const FourPaths&)` and `edge_edge`: when
// the two meet first, or nothing when they do not.
template <class Tests>
class FeaturePairs {
 public:
  explicit FeaturePairs(const plugin::Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::int32_t* v = mesh.triangles[t];
      triangles_.push_back({{v[0], v[1], v[2]}});
    }
  }

  plugin::Result evaluate(plugin::Positions x_t0, plugin::Positions x_t1) {
    x_t0_ = x_t0.data();
    x_t1_ = x_t1.data();
    boxes_.clear();
    for (const auto& triangle : triangles_) boxes_.push_back(box_of(triangle));
    plugin::Result result;
    for (std::size_t b = 1; b < triangles_.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        if (!meet(boxes_[a], boxes_[b])) continue;
        const auto time = first_time(triangles_[a], triangles_[b]);
        if (!time) continue;
        const bool is_first = result.pairs.empty() || (*time)[0] < result.first[0];
        if (is_first) result.first = *time;
        result.answer = ASSAY_COLLISION;
        result.add(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), (*time)[0],
                   (*time)[1]);
      }
    }
    return result;
  }

 private:
  using Triangle = std::array<std::int32_t, 3>;
  using Time = std::optional<plugin::Interval>;
  struct Box {
    double lo[3], hi[3];
  };

  const double* start(std::int32_t v) const { return x_t0_ + 3 * std::ptrdiff_t{v}; }
  const double* end(std::int32_t v) const { return x_t1_ + 3 * std::ptrdiff_t{v}; }

  Box box_of(const Triangle& triangle) const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = box.hi[k] = start(triangle[0])[k];
      for (const std::int32_t v : triangle) {
        box.lo[k] = std::min({box.lo[k], start(v)[k], end(v)[k]});
        box.hi[k] = std::max({box.hi[k], start(v)[k], end(v)[k]});
      }
    }
    return box;
  }
  static bool meet(const Box& a, const Box& b) {
    for (int k = 0; k < 3; ++k) {
      if (a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k]) return false;
    }
    return true;
  }

  FourPaths paths(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    return {{{start(a), start(b), start(c), start(d)}, {end(a), end(b), end(c), end(d)}}};
  }
  static void keep_earlier(const Time& time, Time& first) {
    if (time && (!first || (*time)[0] < (*first)[0])) first = time;
  }
  static bool has(const Triangle& triangle, std::int32_t v) {
    return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
  }

  Time first_time(const Triangle& s, const Triangle& t) const {
    Time first;
    for (const auto& [of, face] : {std::pair(s, t), std::pair(t, s)}) {
      for (const std::int32_t v : of) {
        if (has(face, v)) continue;
        keep_earlier(Tests::vertex_face(paths(v, face[0], face[1], face[2])), first);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const std::int32_t a = s[i], b = s[(i + 1) % 3], c = t[j], d = t[(j + 1) % 3];
        if (a == c || a == d || b == c || b == d) continue;
        keep_earlier(Tests::edge_edge(paths(a, b, c, d)), first);
      }
    }
    return first;
  }

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
  const double *x_t0_ = nullptr, *x_t1_ = nullptr;
};

}  // namespace assay::peers
