// Exact winding numbers of a cycle, found by counting how often a ray crosses it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "oracle/instant/instant.h"

namespace assay::oracle {

// The winding numbers beside a triangle: `inside` just behind it, `outside` just in front, where
// the normal points. Always (w, w - 1).
struct Layer {
  int inside = 0, outside = 0;
  friend auto operator<=>(const Layer&, const Layer&) = default;
};

using RationalPoint = std::array<mpq_class, 3>;

// The winding number w of a cycle at one instant: w is 0 far away, and drops by 1 across each
// triangle in the direction of its normal. Zero-area triangles bound nothing and add nothing. A
// query follows a ray that runs nearly along the x axis, so it costs a few determinants (10 to 100
// us); one box tree serves all queries.
class WindingField {
 public:
  // REQUIRES a cycle (every directed edge as often as its reverse), indices in range. The instant
  // has to outlive the field.
  WindingField(const Instant& instant, detector::Triangles cycle);

  // The winding number at the point; nothing when the point is on a triangle. Exact for every
  // finite double and every rational.
  std::optional<int> at(const detector::Point& point) const;
  std::optional<int> at(const RationalPoint& point) const;

  // The layer of a triangle of the cycle. REQUIRES that its area is not zero and that no other
  // triangle contains its centroid; none does when the triangle is in no contact.
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
