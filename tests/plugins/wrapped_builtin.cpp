// The built-in detector as a plug-in: all its claims must hold.
#include "tests/plugins/builtin.h"

const assay_detector_api* assay_detector() { return &assay::tests::builtin_api(); }
