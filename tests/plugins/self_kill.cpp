// The built-in detector, which sends itself the signal SIGNAL when it evaluates a step: of every
// mesh whose number of triangles is divisible by 5, or, compiled with AT_RANDOM, one time in 20
// whatever the mesh is; compiled with WHILE_LOADED, before it has been asked for anything, and with
// LOADED_AGAIN likewise where the file that the variable ASSAY_TEST_FILE names is there.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "detector/plugin/assay_builtin_detector.h"

namespace {

// Of the mesh created last: the worker has one at a time.
std::uint64_t triangles_now = 0;

bool is_time_to_die() {
#ifdef AT_RANDOM
  constexpr unsigned one_in = 20;
  static std::mt19937_64 random(
      static_cast<std::uint64_t>(getpid()) ^
      static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count()));
  return random() % one_in == 0;
#else
  constexpr std::uint64_t divisor = 5;
  return triangles_now % divisor == 0;
#endif
}

std::int32_t create(const std::int32_t* triangles, std::uint64_t triangle_count,
                    const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                    const char** message) {
  triangles_now = triangle_count;
  return assay_builtin_detector()->create(triangles, triangle_count, positions, vertex_count,
                                          handle, message);
}

std::int32_t evaluate(assay_handle* handle, const double* x_t0, const double* x_t1) {
  if (is_time_to_die()) kill(getpid(), SIGNAL);
  return assay_builtin_detector()->evaluate(handle, x_t0, x_t1);
}

}  // namespace

const assay_detector_api* assay_detector() {
#ifdef WHILE_LOADED
  kill(getpid(), SIGNAL);
#endif
#ifdef LOADED_AGAIN
  const char* file = std::getenv("ASSAY_TEST_FILE");
  if (file && access(file, F_OK) == 0) kill(getpid(), SIGNAL);
#endif
  static const assay_detector_api api = [] {
    assay_detector_api changed = *assay_builtin_detector();
    changed.create = create;
    changed.evaluate = evaluate;
    return changed;
  }();
  return &api;
}
