/* Loads the two plug-ins of this folder as a host does, and calls the functions that they have. */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "detector/plugin/assay_detector.h"

#define EXPECT(what)                                             \
  do {                                                           \
    if (!(what)) {                                               \
      fprintf(stderr, "line %d: not so: %s\n", __LINE__, #what); \
      return 1;                                                  \
    }                                                            \
  } while (0)

static const assay_detector_api* load(const char* file) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  const assay_detector_api* (*entry)(void) = NULL;
  void* symbol = library ? dlsym(library, "assay_detector") : NULL;
  memcpy(&entry, &symbol, sizeof entry);
  return entry ? entry() : NULL;
}

static int whole(const assay_detector_api* api) {
  const int32_t triangles[] = {0, 1, 2, 3, 4, 5};
  double x_t0[18] = {0}, x_t1[18] = {0};
  assay_handle* handle = NULL;
  const char* message = NULL;
  assay_result result = {0};
  assay_candidates candidates = {0};
  EXPECT(strcmp(api->describe()->name, "height field") == 0);
  api->use_threads(2);
  EXPECT(api->create(triangles, 0, x_t0, 6, &handle, &message) == ASSAY_REFUSED);
  EXPECT(!handle && strcmp(message, "no triangles") == 0);
  EXPECT(api->create(triangles, 2, x_t0, 6, &handle, &message) == ASSAY_OK && handle);
  EXPECT(api->evaluate(handle, x_t0, x_t1) == ASSAY_OK);
  EXPECT(api->result(handle, &result) == ASSAY_OK && result.answer == ASSAY_COLLISION);
  EXPECT(result.pair_count == 1 && result.pairs[0] == 0 && result.pairs[1] == 1);
  EXPECT(api->candidates(handle, x_t0, x_t1, &candidates) == ASSAY_OK);
  EXPECT(candidates.pair_count == 1 && candidates.pairs[1] == 1);
  EXPECT(api->commit(handle) == ASSAY_OK);
  EXPECT(api->evaluate(handle, x_t0, x_t0) == ASSAY_OK);
  EXPECT(api->result(handle, &result) == ASSAY_OK && result.answer == ASSAY_ERROR);
  EXPECT(strcmp(result.message, "no step") == 0);
  api->destroy(handle);
  return 0;
}

static int query_alone(const assay_detector_api* api) {
  double x[12] = {0};
  assay_query_result result = {0};
  EXPECT(!api->create && !api->evaluate && !api->candidates && api->query);
  x[11] = .5;
  EXPECT(api->query(ASSAY_QUERY_VERTEX_FACE, x, x, &result) == ASSAY_OK);
  EXPECT(result.answer == ASSAY_COLLISION && result.first_lo == .5);
  return 0;
}

int main(int count, char** files) {
  const assay_detector_api* api = NULL;
  EXPECT(count == 3);
  EXPECT((api = load(files[1])) != NULL);
  if (whole(api)) return 1;
  EXPECT((api = load(files[2])) != NULL);
  return query_alone(api);
}
