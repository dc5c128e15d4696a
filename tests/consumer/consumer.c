/* The same as consumer.cpp, in C. */
#include <stdio.h>

#include "detector/plugin/assay_builtin_detector.h"

int main(void) {
  const int32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const double x_t0[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 2};
  const double x_t1[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -2};
  const assay_detector_api* detector = assay_builtin_detector();
  assay_handle* handle = NULL;
  const char* message = NULL;
  assay_result result = {0};

  if (detector->create(triangles, 4, x_t0, 4, &handle, &message) != ASSAY_OK) {
    printf("refused: %s\n", message);
    return 1;
  }
  if (detector->evaluate(handle, x_t0, x_t1) != ASSAY_OK) return 1;
  if (detector->result(handle, &result) != ASSAY_OK) return 1;
  printf("%s at t = %g, %d pairs\n", result.answer == ASSAY_COLLISION ? "collision" : "free",
         result.first_lo, (int)result.pair_count);
  const int right = result.answer == ASSAY_COLLISION && result.first_lo == 0.5;
  detector->commit(handle);
  detector->destroy(handle);
  return right ? 0 : 1;
}
