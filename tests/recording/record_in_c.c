/* Records steps of a waving sheet in C99, with the recorder's header alone, and compares the
 * processor time with the processor time of a plain fwrite of the same arrays.
 *
 *   record_in_c PATH [LIMIT]
 *
 * The files PATH and PATH.plain are replaced. With a LIMIT, the program fails if recording takes
 * more than LIMIT times as long as plain writing: the median of 15 steps, measured in turn. */
#include <math.h>
#include <time.h>

#include "detector/plugin/assay_record.h"

enum { SIDE = 224, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1), STEPS = 15 };

static int32_t triangles[3 * TRIANGLES];
static double x0[3 * VERTICES], x1[3 * VERTICES];

static void lie_at(double* x, double time) {
  for (int i = 0; i < VERTICES; ++i) {
    x[3 * i] = i % SIDE;
    x[3 * i + 1] = i / SIDE;
    x[3 * i + 2] = sin(0.1 * i + time);
  }
}

static void make_triangles(void) {
  int32_t* t = triangles;
  for (int row = 0; row + 1 < SIDE; ++row)
    for (int32_t v = row * SIDE; v + 1 < (row + 1) * SIDE; ++v, t += 6) {
      t[0] = v, t[1] = v + 1, t[2] = v + SIDE;
      t[3] = v + SIDE, t[4] = v + 1, t[5] = v + SIDE + 1;
    }
}

static int by_size(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static double median(double* seconds) {
  qsort(seconds, STEPS, sizeof *seconds, by_size);
  return seconds[STEPS / 2];
}

static double seconds_of_processor(void) { return (double)clock() / CLOCKS_PER_SEC; }

static int fail(const char* what) { return (void)fprintf(stderr, "%s\n", what), 1; }

int main(int count, char** words) {
  static assay_recorder recorder;
  static char plain_path[4096];
  double recorded[STEPS], plain[STEPS];
  if (count < 2 || strlen(words[1]) > 4000) return fail("usage: record_in_c PATH [LIMIT]");
  (void)strcat(strcpy(plain_path, words[1]), ".plain");
  make_triangles();
  lie_at(x0, 0);
  const assay_record_settings settings = {.path = words[1], .overwrite = 1};
  const assay_description description = {.name = "waves", .version = "1"};
  const assay_record_array rest = {.data = x0};
  if (assay_record_begin(&recorder, &settings, &description, triangles, TRIANGLES, rest, VERTICES,
                         NULL) != ASSAY_OK)
    return fail(assay_record_error(&recorder));
  FILE* file = fopen(plain_path, "wb");
  if (!file || setvbuf(file, NULL, _IONBF, 0)) return fail("cannot write beside the log");
  for (int k = 0; k < STEPS; ++k) {
    lie_at(x0, 0.1 * k);
    lie_at(x1, 0.1 * (k + 1));
    const assay_result result = {.answer = ASSAY_FREE};
    const assay_record_step_data step = {.x0 = {.data = x0}, .x1 = {.data = x1}, .result = &result};
    const double begun = seconds_of_processor();
    if (assay_record_step(&recorder, &step) != ASSAY_OK) return fail(assay_record_error(&recorder));
    const double between = seconds_of_processor();
    if (fwrite(x0, sizeof x0, 1, file) + fwrite(x1, sizeof x1, 1, file) != 2)
      return fail("cannot write beside the log");
    recorded[k] = between - begun;
    plain[k] = seconds_of_processor() - between;
  }
  if (fclose(file) || assay_record_end(&recorder) != ASSAY_OK)
    return fail(assay_record_error(&recorder));
  const double a = median(recorded), b = median(plain);
  printf("%d triangles: a step is recorded in %.2f ms, written in %.2f ms: %.2f times that\n",
         TRIANGLES, 1e3 * a, 1e3 * b, a / b);
  return count > 2 && a > atof(words[2]) * b ? fail("that is more than the limit") : 0;
}
