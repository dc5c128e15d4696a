// The built-in detector as a plug-in: all its claims must hold.
#include "detector/plugin/assay_builtin_detector.h"

const assay_detector_api* assay_detector() { return assay_builtin_detector(); }
