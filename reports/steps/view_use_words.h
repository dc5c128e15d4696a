// Why a step has no views, in words that follow "no views, ".
#pragma once

#include "detector/step_result.h"

namespace assay::reports {

constexpr const char* words_of(detector::ViewUse use) {
  using detector::ViewUse;
  switch (use) {
    case ViewUse::used:
      return "used";
    case ViewUse::not_asked_for:
      return "the culling has none";
    case ViewUse::resting:
      return "they have not paid in the steps before";
    case ViewUse::start_unknown:
      return "too little is seen to be clean at a start that nothing is known of";
    case ViewUse::hopeless:
      return "of a few triangles doubles can tell too few signs";
    case ViewUse::saving_too_little:
      return "too few triangles are of one sign";
    case ViewUse::among_ghosts:
      return "too many triangles are near ghosts";
    case ViewUse::among_dirty:
      return "too few triangles are clean";
  }
  return "";
}

}  // namespace assay::reports
