// The vBVHs of the thesis, as flags on the one tree: which nodes hold triangles of V+, V-, V0, Vv.
//
// A node has the flags P, N, Z, V (and `grown` in the closure) of all triangles below it. The
// nodes with one flag are the partial tree of that set. Flags are kept from step to step. A
// marking is given the types of all triangles and compares them with those of the LAST MARKING,
// which may be several steps ago, because a step that ends as free by L5 does not mark. From each
// leaf that changed it works upward:
//   a new flag is set on each ancestor until one has it already;
//   a lost flag is cleared on each ancestor until one has it from its other child.
// All new flags are set before any is cleared, so no flag is taken away and given back. The flags
// do not depend on the order in which triangles change. The work is the number of nodes whose
// flags change, for each changed triangle at most the depth of the tree. Where a quarter of a
// large mesh has changed, as in the first step with views, one pass over all nodes takes less.
#pragma once

#include <span>
#include <vector>

#include "detector/boxes/bounding_volume_tree.h"
#include "detector/mesh/step_counts.h"
#include "detector/search/pair_rule.h"

namespace assay::detector {

struct Marks {
  // At first all triangles are V+: every node has the flag P and no other.
  explicit Marks(const BoundingVolumeTree& tree);

  std::vector<TriangleType> types;       // of the last marking, by triangle
  std::vector<std::uint8_t> node_flags;  // by node
  // Triangles whose type the last marking changed, ascending. Its capacity is all triangles from
  // the start, so that marking allocates nothing.
  std::vector<std::int32_t> changed;

  std::uint8_t flags(std::int32_t triangle) const {
    return flags_of(types[static_cast<std::size_t>(triangle)]);
  }
};

// A stage of the detector.
class Marking {
 public:
  virtual ~Marking() = default;

  // Sets the types of all triangles, and the flags to match. Allocates nothing.
  void bring_to(std::span<const TriangleType> types, const BoundingVolumeTree& tree, Marks& marks,
                MarkingCounts& counts) const;
  // The same where only some triangles may change, each with its new type.
  struct Change {
    std::int32_t triangle;
    TriangleType type;
  };
  void change(std::span<const Change> changes, const BoundingVolumeTree& tree, Marks& marks,
              MarkingCounts& counts) const;

 protected:
  // Set flags on a leaf and upward, and clear them.
  virtual void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                    Marks& marks, MarkingCounts& counts) const;
  virtual void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                     Marks& marks, MarkingCounts& counts) const;

 private:
  // Makes the flags agree with the types of the triangles in marks.changed.
  void update(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts) const;
  // The same by one pass over all nodes, for types that have one flag each, as those of a first
  // search have.
  static void mark_anew(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts);
};

}  // namespace assay::detector
