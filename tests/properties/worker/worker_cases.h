// What the tests of the worker run.
#pragma once

#include "properties/worker/case_run.h"
#include "tests/properties/small_case.h"

namespace assay::properties::test {

inline const std::vector<Configuration> plugin_alone = {{"plug-in", {}}};

// A case on which troubled_builtin.cpp uses so much processor time.
inline corpus::Case burning_case(double seconds) {
  auto c = small_case(31, 0);
  for (auto& frame : c.frames) frame(0, 0) = seconds;
  return c;
}

}  // namespace assay::properties::test
