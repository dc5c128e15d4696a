// Exact box cull: finds which of many closed boxes meet a given one.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "detector/mesh/types.h"

namespace assay::oracle {

struct Box {
  detector::Point min, max;
};

// The box that holds some vertices over the whole step. Their places at the two ends suffice,
// because each path is the segment between these.
template <class Vertices>
Box swept_box(const detector::SteppedMesh& motion, const Vertices& vertices) {
  Box box{motion.start(vertices[0]), motion.start(vertices[0])};
  for (const std::int32_t v : vertices) {
    for (int k = 0; k < 3; ++k) {
      for (const double x : {motion.vertices_t0(v, k), motion.vertices_t1(v, k)}) {
        if (x < box.min[k]) box.min[k] = x;
        if (x > box.max[k]) box.max[k] = x;
      }
    }
  }
  return box;
}

// A packed R-tree (Boost.Geometry). Its answers rest on comparisons of doubles alone; rounded sums
// decide its layout, never an answer. Many threads may ask at once.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);
  ~BoxTree();
  BoxTree(const BoxTree&) = delete;
  BoxTree& operator=(const BoxTree&) = delete;

  // Replaces `found` by the indices of all boxes that meet `box`, touching included, in any order.
  void meeting(const Box& box, std::vector<std::int32_t>& found) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace assay::oracle
