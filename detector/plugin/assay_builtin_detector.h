/* The built-in detector behind the C interface of assay_detector.h: for programs in C, and for
 * those that take any detector by that interface. Culling view-point, start verified, all pairs,
 * exact arithmetic. */
#ifndef ASSAY_BUILTIN_DETECTOR_H
#define ASSAY_BUILTIN_DETECTOR_H

#include "detector/plugin/assay_detector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Never NULL; valid for ever. */
const assay_detector_api* assay_builtin_detector(void);

#ifdef __cplusplus
}
#endif

#endif
