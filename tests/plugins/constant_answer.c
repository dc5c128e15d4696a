/* Plug-ins that do not look at the mesh. Compiled with ANSWER (collision or free) and, for the
 * tests of what the host must withstand, with one of the things that a plug-in must not do. */
#include <stdlib.h>
#include <unistd.h>

#include "detector/plugin/assay_detector.h"

#ifndef ANSWER
#define ANSWER ASSAY_FREE
#endif
#ifndef ABI
#define ABI ASSAY_DETECTOR_ABI_VERSION
#endif

struct assay_handle {
  int unused;
};

static const assay_description* describe(void) {
  static const assay_description description = {
      .name = "constant answer", .version = "1", .claims = (1u << 8) - 1};
  return &description;
}

static int32_t create(const int32_t* triangles, uint64_t m, const double* x, uint64_t n,
                      assay_handle** out, const char** message) {
  (void)triangles, (void)m, (void)x, (void)n, (void)message;
#ifdef REFUSE
  *message = "too\nmany triangles";
  return ASSAY_REFUSED;
#endif
  *out = calloc(1, sizeof **out);
  return *out ? ASSAY_OK : ASSAY_OUT_OF_MEMORY;
}

static int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  (void)h, (void)x_t0, (void)x_t1;
#ifdef HANG
  for (;;) pause();
#endif
#ifdef EXIT
  exit(0);
#endif
#ifdef NO_MEMORY
  return ASSAY_OUT_OF_MEMORY;
#endif
#ifdef FAIL
  return ASSAY_FAILED;
#endif
  return ASSAY_OK;
}

static int32_t commit(assay_handle* h) { return (void)h, ASSAY_OK; }

static int32_t result(assay_handle* h, assay_result* r) {
  (void)h;
  r->answer = ANSWER; /* at t = 0 if at all */
#ifdef NO_SUCH_TRIANGLE
  static const int32_t pair[2] = {0, 1000000};
  r->answer = ASSAY_COLLISION;
  r->pair_count = 1;
  r->pairs = pair;
#endif
#ifdef NO_INTERVAL
  r->answer = ASSAY_COLLISION;
  r->first_lo = 1;
#endif
  return ASSAY_OK;
}

static void destroy(assay_handle* h) { free(h); }

const assay_detector_api* assay_detector(void) {
#ifdef HANG_WHILE_LOADED
  for (;;) pause();
#endif
  static const assay_detector_api api = {.abi_version = ABI,
                                         .describe = describe,
                                         .create = create,
                                         .evaluate = evaluate,
                                         .commit = commit,
                                         .result = result,
                                         .destroy = destroy};
  return &api;
}
