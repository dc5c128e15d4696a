// Exact winding numbers of a cycle: by counting how often a ray crosses it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "oracle/instant/instant.h"

namespace assay::oracle {

// (w just inside, w just outside) of a triangle: always (w, w - 1).
struct Layer {
  int inside = 0, outside = 0;
  friend auto operator<=>(const Layer&, const Layer&) = default;
};

using RationalPoint = std::array<mpq_class, 3>;

// The winding number w of a cycle at one instant: 0 far away, and less by 1 behind each triangle
// that is crossed in the direction of its normal. Zero-area triangles bound nothing and add
// nothing. A ray runs nearly along the x axis, so a query costs a few determinants (10 to 100 us)
// besides one box tree for all.
class WindingField {
 public:
  // REQUIRES a cycle (every directed edge as often as its reverse), indices in range; the instant
  // outlives the field.
  WindingField(const Instant& instant, detector::Triangles cycle);

  // Nothing when the point is on a triangle. Exact for every finite double and every rational.
  std::optional<int> at(const detector::Point& point) const;
  std::optional<int> at(const RationalPoint& point) const;

  // Layer of a triangle of the cycle. REQUIRES that its area is not zero and that no other triangle
  // contains its centroid, as is so for one that is in no contact.
  Layer layer_of(std::int32_t triangle) const;

 private:
  struct Ray;
  std::optional<int> crossings(const Ray& ray, int direction, std::int32_t skipped) const;
  bool on_surface(const Ray& ray) const;

  const Instant& instant_;
  detector::Triangles cycle_;
  Box bounds_{};
  std::unique_ptr<BoxTree> tree_;
};

}  // namespace assay::oracle
