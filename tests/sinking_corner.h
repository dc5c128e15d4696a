// Two triangles that come within a distance, as a case.
#pragma once

#include <map>
#include <string>

#include "corpus/cases/case_file.h"
#include "tests/meshes.h"

namespace assay::tests {

// Returns a case with a triangle at rest in the plane z = 0 and a second triangle above it. A
// corner of the second triangle sinks from z = 3 to `z`, above the inside of the first; its other
// two corners stay at z = 4.
inline corpus::Case sinking_corner(
    double z, const std::map<std::string, std::string, std::less<>>& options = {}) {
  corpus::Case c;
  c.id = "sinking-corner";
  c.about = c.source = "test";
  c.triangles = triangles({{0, 1, 2}, {3, 4, 5}});
  for (const double at : {3., z})
    c.frames.push_back(
        positions({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, at}, {2, 1, 4}, {1, 2, 4}}));
  c.options = options;
  return c;
}

}  // namespace assay::tests
