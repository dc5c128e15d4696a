// The built-in detector's table of functions, for a plug-in that changes some of them.
#pragma once

#include "detector/plugin/assay_builtin_detector.h"

namespace assay::tests {

template <class Change>
const assay_detector_api* changed_builtin(Change change) {
  static const assay_detector_api api = [&] {
    assay_detector_api table = *assay_builtin_detector();
    change(table);
    return table;
  }();
  return &api;
}

}  // namespace assay::tests
