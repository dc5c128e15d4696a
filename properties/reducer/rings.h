// How far the vertices of a mesh are from the triangles of the reported pair.
#pragma once

#include <cstdint>
#include <vector>

#include "properties/reducer/search.h"

namespace assay::properties {

struct Rings {
  // Both are by vertex. `distance` is in edges from the nearest vertex of the focus, or
  // `unreached` if no path leads there. `parent` is a neighbour that is nearer by one, or the
  // vertex itself if its distance is 0 or unreached.
  std::vector<int> distance;
  std::vector<std::int32_t> parent;
  std::vector<std::vector<std::int32_t>> neighbours;  // ascending
  std::vector<std::int32_t> far_first;                // vertices: farthest first, then by number
  int farthest = 0;                                   // greatest distance that is reached

  static constexpr int unreached = 1 << 30;
};

// The rings around finding().focus of the best case, or around its first triangle if the focus is
// empty. O(n log n).
Rings rings_of(const ReductionSearch& search);

// The triangles with all vertices at a distance of `ring` or less.
corpus::Case within(const corpus::Case& c, const Rings& rings, int ring);

// Offers to drop or change ranges [begin, end) of a list, halves first. `try_range` is called with
// ever smaller ranges and returns whether it succeeded. After a success the list (`size`) is
// shorter, and the same place is tried again. A range is not tried a second time after a success
// elsewhere; a later call of the pass does that.
template <class Size, class TryRange>
void try_halves(const ReductionSearch& search, Size size, TryRange try_range) {
  for (std::size_t chunk = std::max<std::size_t>(1, (size() + 1) / 2);; chunk /= 2) {
    for (std::size_t begin = 0; begin < size() && !search.ended();) {
      if (!try_range(begin, std::min(begin + chunk, size()))) begin += chunk;
    }
    if (chunk == 1 || search.ended()) return;
  }
}

}  // namespace assay::properties
