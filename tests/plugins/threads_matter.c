/* A detector by boxes: two triangles collide if the boxes around their paths meet. On meshes of
 * more than 1,000 triangles its first time changes if it may use several threads, although it
 * claims to be deterministic. A word of the environment variable ASSAY_THREADS_MATTER can change
 * this:
 *
 *   harmless         the time is the same with any number of threads
 *   at-random        the time changes in every second call, whatever the number of threads */
#include <stdlib.h>
#include <string.h>

#include "detector/plugin/assay_detector.h"

struct assay_handle {
  uint64_t count;
  int is_met;
  double* boxes; /* least and largest of each axis */
  int32_t triangles[];
};

static uint32_t threads = 1, calls;

static int is(const char* word) {
  const char* given = getenv("ASSAY_THREADS_MATTER");
  return given && strcmp(given, word) == 0;
}

static const assay_description* describe(void) {
  static const assay_description description = {
      .name = "threads matter",
      .version = "1",
      .claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_DETERMINISTIC |
                ASSAY_CLAIM_TOTAL,
      .adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX,
      .reports = ASSAY_REPORTS_NO_PAIRS};
  return &description;
}

static void use_threads(uint32_t count) { threads = count; }

static int32_t create(const int32_t* triangles, uint64_t m, const double* x, uint64_t n,
                      assay_handle** out, const char** message) {
  assay_handle* h = malloc(sizeof *h + 3 * m * sizeof(int32_t));
  (void)x, (void)n, (void)message;
  if (!h) return ASSAY_OUT_OF_MEMORY;
  h->count = m;
  h->boxes = malloc(6 * m * sizeof(double));
  memcpy(h->triangles, triangles, 3 * m * sizeof(int32_t));
  *out = h;
  return ASSAY_OK;
}

static void destroy(assay_handle* h) {
  free(h->boxes);
  free(h);
}

static void write_box(assay_handle* h, const double* x[2], uint64_t t) {
  for (int k = 0; k < 3; ++k) {
    double* box = h->boxes + 6 * t + 2 * k;
    box[0] = box[1] = x[0][3 * h->triangles[3 * t] + k];
    for (int i = 1; i < 6; ++i) {
      const double here = x[i / 3][3 * h->triangles[3 * t + i % 3] + k];
      if (here < box[0]) box[0] = here;
      if (here > box[1]) box[1] = here;
    }
  }
}

static int meet(const assay_handle* h, uint64_t s, uint64_t t) {
  const double *a = h->boxes + 6 * s, *b = h->boxes + 6 * t;
  for (int k = 0; k < 3; ++k) {
    if (a[2 * k + 1] < b[2 * k] || b[2 * k + 1] < a[2 * k]) return 0;
  }
  for (int i = 0; i < 9; ++i) {
    if (h->triangles[3 * s + i / 3] == h->triangles[3 * t + i % 3]) return 0;
  }
  return 1;
}

static int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  const double* x[2] = {x_t0, x_t1};
  for (uint64_t t = 0; t < h->count; ++t) write_box(h, x, t);
  h->is_met = 0;
  for (uint64_t t = 1; t < h->count && !h->is_met; ++t) {
    for (uint64_t s = 0; s < t && !h->is_met; ++s) h->is_met = meet(h, s, t);
  }
  return ASSAY_OK;
}

static int32_t commit(assay_handle* h) { return (void)h, ASSAY_OK; }

static int32_t result(assay_handle* h, assay_result* r) {
  const int matters = is("at-random") ? ++calls % 2 == 0 : threads > 1 && !is("harmless");
  r->answer = h->is_met ? ASSAY_COLLISION : ASSAY_FREE;
  r->first_hi = !h->is_met ? 0 : matters && h->count > 1000 ? 0.5 : 1;
  return ASSAY_OK;
}

const assay_detector_api* assay_detector(void) {
  static const assay_detector_api api = {.abi_version = ASSAY_DETECTOR_ABI_VERSION,
                                         .describe = describe,
                                         .create = create,
                                         .evaluate = evaluate,
                                         .commit = commit,
                                         .result = result,
                                         .destroy = destroy,
                                         .use_threads = use_threads};
  return &api;
}
