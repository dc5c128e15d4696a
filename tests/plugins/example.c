/* A detector by boxes: two triangles collide if the boxes around their paths meet. It never misses
 * a contact, and claims this alone; it often reports a contact falsely. */
#include <stdlib.h>
#include <string.h>

#include "detector/plugin/assay_detector.h"

struct assay_handle {
  uint64_t triangle_count, pair_count;
  int32_t* pairs;
  int32_t triangles[]; /* a copy: the host's array is gone after create() */
};
static const assay_description description = {
    .name = "swept boxes",
    .version = "1.0",
    .claims =
        ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_TOTAL,
    .adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX}; /* what is not named is 0: nothing left out */
static const assay_description* describe(void) { return &description; }

static int32_t create(const int32_t* triangles, uint64_t m, const double* x, uint64_t n,
                      assay_handle** out, const char** message) {
  assay_handle* h = malloc(sizeof *h + (3 * m + m * m) * sizeof(int32_t));
  (void)x, (void)n, (void)message; /* nothing to prepare, nothing to refuse */
  if (!h) return ASSAY_OUT_OF_MEMORY;
  h->triangle_count = m;
  h->pairs = h->triangles + 3 * m;
  memcpy(h->triangles, triangles, 3 * m * sizeof(int32_t));
  *out = h;
  return ASSAY_OK;
}
static void destroy(assay_handle* h) { free(h); }
/* The greatest value of +-x_k on the path of triangle t. */
static double reach(const assay_handle* h, const double* x[2], uint64_t t, int k, double sign) {
  double most = sign * x[0][3 * h->triangles[3 * t] + k];
  for (int i = 0; i < 6; ++i) {
    const double here = sign * x[i / 3][3 * h->triangles[3 * t + i % 3] + k];
    if (here > most) most = here;
  }
  return most;
}

static int meet(const assay_handle* h, const double* x[2], uint64_t a, uint64_t b) {
  int apart = 0;
  for (int i = 0; i < 9; ++i) /* the contract leaves neighbours out */
    apart |= h->triangles[3 * a + i / 3] == h->triangles[3 * b + i % 3];
  for (int k = 0; k < 3; ++k)
    apart |= reach(h, x, a, k, 1) < -reach(h, x, b, k, -1) ||
             reach(h, x, b, k, 1) < -reach(h, x, a, k, -1);
  return !apart;
}

static int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  const double* x[2] = {x_t0, x_t1};
  h->pair_count = 0;
  for (int32_t b = 1; b < (int32_t)h->triangle_count; ++b)
    for (int32_t a = 0; a < b; ++a)
      if (meet(h, x, a, b)) {
        h->pairs[2 * h->pair_count] = a;
        h->pairs[2 * h->pair_count++ + 1] = b;
      }
  return ASSAY_OK;
}
static int32_t commit(assay_handle* h) { return (void)h, ASSAY_OK; } /* carries no state */
static int32_t result(assay_handle* h, assay_result* r) {
  r->answer = h->pair_count ? ASSAY_COLLISION : ASSAY_FREE;
  r->first_hi = 1; /* at some time in [0, 1]: never late */
  r->pair_count = h->pair_count;
  r->pairs = h->pairs;
  return ASSAY_OK;
}
static const assay_detector_api api = {.abi_version = ASSAY_DETECTOR_ABI_VERSION,
                                       .describe = describe,
                                       .create = create,
                                       .evaluate = evaluate,
                                       .commit = commit,
                                       .result = result,
                                       .destroy = destroy};
const assay_detector_api* assay_detector(void) { return &api; }
