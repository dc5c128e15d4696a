/* A plug-in with a broad phase alone: pairs of triangles whose boxes around their whole paths meet.
 * A word of the environment variable ASSAY_CANDIDATES names its fault:
 *
 *   ends-only        boxes of the places at t=0 and t=1, not of the paths between
 *   every-second     leaves out every second pair
 *   changing         adds the pair of the first two triangles in every second call
 *   no-such-triangle, no-list, fail, no-memory, abort
 *   threads=N        fails unless the host allows it exactly N threads */
#include <stdlib.h>
#include <string.h>

#include "detector/plugin/assay_detector.h"

struct assay_handle {
  uint64_t triangle_count;
  int32_t* pairs;
  int32_t triangles[];
};

static uint32_t threads_told; /* once, before everything else */

static int is(const char* word) {
  const char* given = getenv("ASSAY_CANDIDATES");
  return given && strcmp(given, word) == 0;
}

static const assay_description* describe(void) {
  static const assay_description description = {
      .name = "candidates alone",
      .version = "1",
      .claims = ASSAY_CLAIM_CANDIDATES | ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL |
                ASSAY_CLAIM_FREE_SOUND}; /* the last is of no part that it has */
  return &description;
}

static void use_threads(uint32_t count) { threads_told = count; }

static int32_t create(const int32_t* triangles, uint64_t m, const double* x, uint64_t n,
                      assay_handle** out, const char** message) {
  assay_handle* h = malloc(sizeof *h + (3 * m + m * m) * sizeof(int32_t));
  (void)x, (void)n, (void)message;
  if (!h) return ASSAY_OUT_OF_MEMORY;
  h->triangle_count = m;
  h->pairs = h->triangles + 3 * m;
  memcpy(h->triangles, triangles, 3 * m * sizeof(int32_t));
  *out = h;
  return ASSAY_OK;
}
static void destroy(assay_handle* h) { free(h); }

static double reach(const assay_handle* h, const double* x, uint64_t t, int k, double sign) {
  double most = sign * x[3 * h->triangles[3 * t] + k];
  for (int i = 1; i < 3; ++i) {
    const double here = sign * x[3 * h->triangles[3 * t + i] + k];
    if (here > most) most = here;
  }
  return most;
}

static double larger(double a, double b) { return a > b ? a : b; }

static int apart_at(const assay_handle* h, const double* x, uint64_t a, uint64_t b) {
  for (int k = 0; k < 3; ++k)
    for (int sign = -1; sign <= 1; sign += 2)
      if (reach(h, x, a, k, sign) < -reach(h, x, b, k, -sign)) return 1;
  return 0;
}

static int meet(const assay_handle* h, const double* x0, const double* x1, uint64_t a, uint64_t b) {
  if (is("ends-only")) return !(apart_at(h, x0, a, b) && apart_at(h, x1, a, b));
  for (int k = 0; k < 3; ++k)
    for (int sign = -1; sign <= 1; sign += 2)
      if (larger(reach(h, x0, a, k, sign), reach(h, x1, a, k, sign)) <
          -larger(reach(h, x0, b, k, -sign), reach(h, x1, b, k, -sign)))
        return 0;
  return 1;
}

static int32_t candidates(assay_handle* h, const double* x_t0, const double* x_t1,
                          assay_candidates* out) {
  const char* given = getenv("ASSAY_CANDIDATES");
  if (given && strncmp(given, "threads=", 8) == 0 && threads_told != (uint32_t)atoi(given + 8))
    return ASSAY_FAILED;
  if (is("fail")) return ASSAY_FAILED;
  if (is("no-memory")) return ASSAY_OUT_OF_MEMORY;
  if (is("abort")) abort();
  out->pairs = h->pairs;
  for (int32_t b = 1; b < (int32_t)h->triangle_count; ++b)
    for (int32_t a = 0; a < b; ++a)
      if (meet(h, x_t0, x_t1, (uint64_t)a, (uint64_t)b)) {
        h->pairs[2 * out->pair_count] = b; /* any order */
        h->pairs[2 * out->pair_count++ + 1] = a;
      }
  for (uint64_t i = 0; is("every-second") && 2 * i < out->pair_count; ++i)
    memcpy(h->pairs + 2 * i, h->pairs + 4 * i, 2 * sizeof(int32_t));
  if (is("every-second")) out->pair_count = (out->pair_count + 1) / 2;
  static int calls; /* on purpose: two runs begin differently */
  if (is("changing") && ++calls % 2 == 0) {
    h->pairs[2 * out->pair_count] = 0;
    h->pairs[2 * out->pair_count++ + 1] = 1;
  }
  if (is("no-such-triangle") && out->pair_count > 0) h->pairs[0] = 1000000;
  if (is("no-list")) {
    out->pair_count = 3;
    out->pairs = NULL;
  }
  return ASSAY_OK;
}

const assay_detector_api* assay_detector(void) {
  static const assay_detector_api api = {.abi_version = ASSAY_DETECTOR_ABI_VERSION,
                                         .describe = describe,
                                         .create = create,
                                         .destroy = destroy,
                                         .use_threads = use_threads,
                                         .candidates = candidates};
  return &api;
}
