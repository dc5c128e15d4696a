// The vBVHs: which nodes of the one tree hold triangles of V+, V-, V0, Vv.
//
// A node has the flags P, N, Z, V (and `grown` in the closure) of all triangles below it; the nodes
// with one flag are the partial tree of that set. Flags are kept from step to step. A marking is
// given the types of all triangles, compares them with those of the LAST MARKING (free steps do not
// mark, so that may be several steps ago) and works upward from the leaves that changed:
//   a new flag is set on each ancestor until one has it already;
//   a flag gone is cleared on each ancestor until one has it from its other child.
// All that is new is set before anything is cleared, so no flag is taken away and given back. The
// order of the sets changes no flag. Work: nodes whose flags change, at most the depth a triangle.
#pragma once

#include <span>
#include <vector>

#include "detector/mesh/step_counts.h"
#include "detector/search/bounding_volume_tree.h"
#include "detector/search/triangle_type.h"

namespace assay::detector {

struct Marks {
  // At first all triangles are V+: P is true everywhere, the others nowhere.
  explicit Marks(const BoundingVolumeTree& tree);

  std::vector<TriangleType> types;       // of the last marking, by triangle
  std::vector<std::uint8_t> node_flags;  // by node
  // Triangles whose type the last marking changed, ascending. Has room for all from the start.
  std::vector<std::int32_t> changed;

  std::uint8_t flags(std::int32_t triangle) const {
    return flags_of(types[static_cast<std::size_t>(triangle)]);
  }
};

// A stage of the detector.
class Marking {
 public:
  virtual ~Marking() = default;

  // Brings the flags to new types, one for each triangle. Allocates nothing.
  void bring_to(std::span<const TriangleType> types, const BoundingVolumeTree& tree, Marks& marks,
                MarkingCounts& counts) const;
  // The same for some triangles, each with its new type.
  struct Change {
    std::int32_t triangle;
    TriangleType type;
  };
  void change(std::span<const Change> changes, const BoundingVolumeTree& tree, Marks& marks,
              MarkingCounts& counts) const;

 protected:
  // Sets flags on a leaf and upward; clears them.
  virtual void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                    Marks& marks, MarkingCounts& counts) const;
  virtual void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree,
                     Marks& marks, MarkingCounts& counts) const;

 private:
  // Makes the flags those of the types of marks.changed.
  void update(const BoundingVolumeTree& tree, Marks& marks, MarkingCounts& counts) const;
};

}  // namespace assay::detector
