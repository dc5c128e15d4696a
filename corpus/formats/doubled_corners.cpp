#include "corpus/formats/doubled_corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace assay::corpus {

DoubledCorners::DoubledCorners(const detector::Triangles& triangles,
                               const std::vector<std::int32_t>& body)
    : first_(body.size(), -1) {
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const auto v = static_cast<std::size_t>(triangles.data()[i]);
    first_[v] = body[v];
  }
}

void DoubledCorners::add(const detector::Positions& x) {
  // A table of places, open addressing, at most half full.
  const std::size_t size = std::bit_ceil(2 * first_.size() + 1);
  std::vector<std::int32_t> table(size, -1), next(first_.size(), -1);
  for (std::size_t v = 0; v < first_.size(); ++v) {
    if (first_[v] < 0) continue;
    const auto place = x.row(static_cast<Eigen::Index>(v));
    auto hash = static_cast<std::uint64_t>(first_[v]);
    for (const double c : {place[0], place[1], place[2]}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9E3779B97F4A7C15;  // -0 becomes 0
      hash ^= hash >> 32;
    }
    for (std::size_t slot = hash & (size - 1);; slot = (slot + 1) & (size - 1)) {
      auto& u = table[slot];
      if (u < 0) u = static_cast<std::int32_t>(v);
      if (first_[static_cast<std::size_t>(u)] != first_[v] || x.row(u) != place) continue;
      next[v] = u;
      break;
    }
  }
  first_ = std::move(next);
}

std::string DoubledCorners::remark(bool is_welded) const {
  std::vector<std::uint8_t> is_shared(first_.size(), 0);
  std::size_t vertices = 0;
  for (std::size_t v = 0; v < first_.size(); ++v) {
    if (first_[v] < 0 || first_[v] == static_cast<std::int32_t>(v)) continue;
    is_shared[static_cast<std::size_t>(first_[v])] = 1;
    ++vertices;
  }
  const auto places = static_cast<std::size_t>(std::ranges::count(is_shared, 1));
  if (places == 0) return "";
  const auto counts = fmt::format("{} vertices stand at {} place{}", vertices + places, places,
                                  places == 1 ? "" : "s");
  return is_welded ? fmt::format(
                         "welded: {} and count as {}; where sheets rest on each other, their "
                         "vertices are welded, too",
                         counts, places)
                   : counts +
                         ": neighbours do not share their corners, so they touch; --weld "
                         "counts the vertices of a place as one";
}

detector::Triangles DoubledCorners::welded(detector::Triangles triangles) const {
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    auto& v = triangles.data()[i];
    v = first_[static_cast<std::size_t>(v)];
  }
  return triangles;
}

}  // namespace assay::corpus
