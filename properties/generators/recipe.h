// How a case of a family is put together: shape, motion, aims, menus, primitive, in this order.
#pragma once

#include "properties/generators/draft.h"

namespace assay::properties {

struct Recipe {
  bool closed = true, broken = false;
  bool exact = false;              // small integers and dyadics, exact aims and collapses
  bool nearly_degenerate = false;  // ulp neighbours, slivers, aims just missed
  bool far = false;                // far from the origin, scales, denormals, large steps
  // Percentages of the cases that are positive by construction, and of those with an aimed
  // contact.
  int positive = 0, aimed = 0;
};

GeneratedCase make_by(const Recipe& recipe, Random& random, std::string id);

}  // namespace assay::properties
