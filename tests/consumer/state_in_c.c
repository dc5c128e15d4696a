/* A long run in C that is saved half way and taken up by another handle, as after a restart. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "detector/plugin/assay_builtin_detector.h"

enum { vertices = 6, triangle_count = 7, steps = 40 };

/* An octahedron without one of its triangles. */
static const int32_t triangles[] = {2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

/* Its lowest vertex goes out through the hole, stays there for a step and comes back, again and
 * again, each time a little further. */
static void place(double* x, int frame) {
  static const double rest[3 * vertices] = {2, 0,  0, -2, 0, 0, 0, 2, 0,
                                            0, -2, 0, 0,  0, 2, 0, 0, -2};
  memcpy(x, rest, sizeof rest);
  if (frame % 4 == 1 || frame % 4 == 2) x[15] = x[16] = x[17] = 1.5 + frame / 64.0;
}

static assay_handle* make(void) {
  assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
  assay_builtin_error error;
  assay_handle* handle = NULL;
  double x[3 * vertices];
  options.culling = ASSAY_CULLING_VIEW_POINT;
  place(x, 0);
  if (assay_builtin_create(triangles, triangle_count, x, vertices, &options, &handle, &error) !=
      ASSAY_OK) {
    printf("%s: %s\n", assay_builtin_error_name(error.code), error.message);
    exit(1);
  }
  return handle;
}

/* Answers, and what is dirty, of the steps from `begin` on. */
static void play(assay_handle* handle, int begin, int end, int32_t* answers, uint64_t* dirty) {
  for (int s = begin; s < end; ++s) {
    double x_t0[3 * vertices], x_t1[3 * vertices];
    assay_result result = {0};
    assay_builtin_sets sets;
    place(x_t0, s);
    place(x_t1, s + 1);
    if (assay_builtin_evaluate(handle, x_t0, x_t1, NULL, 0, NULL, NULL, NULL) != ASSAY_OK) exit(2);
    assay_builtin_detector()->result(handle, &result);
    assay_builtin_get_sets(handle, &sets);
    answers[s] = result.answer;
    dirty[s] = sets.dirty;
    if (assay_builtin_commit(handle, NULL) != ASSAY_OK) exit(3);
  }
}

int main(void) {
  int32_t answers[steps], again[steps];
  uint64_t dirty[steps], dirty_again[steps], size = 0, written = 0;
  const int half = 37; /* the vertex is outside: some triangles are dirty */
  assay_builtin_error error;
  assay_handle *first = make(), *second = make();
  unsigned char* bytes;

  play(first, 0, half, answers, dirty);
  if (assay_builtin_save(first, NULL, 0, &size, &error) != ASSAY_OK) return 4;
  bytes = malloc((size_t)size);
  if (!bytes || assay_builtin_save(first, bytes, size, &written, &error) != ASSAY_OK) return 5;
  play(first, half, steps, answers, dirty);

  bytes[30] ^= 1;
  if (assay_builtin_restore(second, bytes, size, &error) != ASSAY_REFUSED ||
      error.code != ASSAY_BUILTIN_DAMAGED_STATE) {
    return 6;
  }
  bytes[30] ^= 1;
  if (assay_builtin_restore(second, bytes, size, &error) != ASSAY_OK) return 7;
  play(second, half, steps, again, dirty_again);
  for (int s = half; s < steps; ++s) {
    if (answers[s] != again[s] || dirty[s] != dirty_again[s]) return 8;
  }
  printf("%d bytes of state, %d triangles dirty at it\n", (int)size, (int)dirty[half]);
  free(bytes);
  assay_builtin_detector()->destroy(first);
  assay_builtin_detector()->destroy(second);
  return dirty[half] > 0 ? 0 : 9;
}
