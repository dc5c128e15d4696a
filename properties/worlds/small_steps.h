// Makes random small steps with small-integer coordinates, where degenerate contacts are frequent:
// coplanar and collinear motion, zero-area triangles, contacts at t=0 and t=1, ties.
#pragma once

#include <cstdint>
#include <string>

#include "properties/words.h"

namespace assay::properties {

struct SmallStep {
  std::string family;  // family of the mesh
  Triangles triangles;
  Positions x_t0, x_t1;
  ViewPrimitive point, line;  // with small integers too; the line may move and change its length
};

// Makes case `index` of `seed`. The hash of these two numbers is the only source of randomness, so
// that any machine can make any case alone.
SmallStep make_small_step(std::uint64_t seed, std::uint64_t index);

}  // namespace assay::properties
