// The built-in detector behind the plug-in interface, for the plug-ins that are made of it.
#pragma once

#include "detector/plugin/assay_detector.h"

namespace assay::tests {

const assay_detector_api& builtin_api();

}  // namespace assay::tests
