/* Plug-ins that do not look at the mesh. They are compiled with ANSWER (collision or free) or, for
 * tests of what a host must survive, with one of the acts that are forbidden to plug-ins. */
#include <stdlib.h>
#include <unistd.h>

#include "detector/plugin/assay_detector.h"

#ifndef ANSWER
#define ANSWER ASSAY_FREE
#endif
#ifndef ABI
#define ABI ASSAY_DETECTOR_ABI_VERSION
#endif

#ifndef MISSES_ON
#define MISSES_ON 0
#define CLAIMS ((1u << 8) - 1)
#else /* with this many triangles it misses every contact; otherwise its claims hold */
#define CLAIMS (ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_TOTAL)
#endif

struct assay_handle {
  uint64_t triangle_count;
};

static const assay_description* describe(void) {
  static const assay_description description = {
      .name = "constant answer", .version = "1", .claims = CLAIMS};
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
  if (!*out) return ASSAY_OUT_OF_MEMORY;
  (*out)->triangle_count = m;
  return ASSAY_OK;
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
  r->answer = h->triangle_count == MISSES_ON ? ASSAY_FREE : ANSWER; /* at t = 0 if at all */
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
