// Names triangles by their bodies, where a case has bodies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/types.h"

namespace assay::properties {

struct BodyTriangle {
  std::int32_t body = 0;
  std::int32_t triangle = 0;  // its number among those of the body
};

class BodyNames {
 public:
  BodyNames() = default;
  // It has no names if there is no relation (null), or one without bodies. O(triangles).
  BodyNames(const detector::CountedPairs* counted, const detector::TrianglesView& triangles);

  bool empty() const { return by_triangle_.empty(); }
  // REQUIRES names.
  const BodyTriangle& of(std::int32_t triangle) const {
    return by_triangle_[detector::at(triangle)];
  }
  // " (triangle 3 of body 0 and triangle 1 of body 2)"; empty if there are no names.
  std::string text(const detector::TrianglePair& pair) const;

 private:
  std::vector<BodyTriangle> by_triangle_;
};

}  // namespace assay::properties
