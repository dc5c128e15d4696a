// A few patches of a mesh, spread over it, of which a step asks how many can be proved free (L13).
//
// They depend on the mesh alone and not on a tree. So what a step decides by them does not depend
// on the positions that the detector was made with.
#pragma once

#include <vector>

#include "detector/traditional/patch_contours.h"

namespace assay::detector {

struct SamplePatch {
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> contour;  // empty if it has none
};

struct SamplePatches {
  std::vector<SamplePatch> small, medium, large;
};

// 4 to 32 patches of 12 triangles, half as many of 36 and a quarter as many of 96. A patch is
// smaller where its component ends. O(M) to clear marks, and 20 us at most.
SamplePatches sample_patches(const Topology& mesh, ContourMaker& maker);

}  // namespace assay::detector
