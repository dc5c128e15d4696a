// The built-in detector, with trouble before each step. Compiled with TROUBLE, it then calls the
// function below of that name; with SIGNAL, it sends itself that signal. Compiled with WHEN_LOADED,
// it also calls the function when the library is loaded.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <random>
#include <thread>

#include "tests/plugins/changed_builtin.h"

#ifndef SIGNAL
#define SIGNAL SIGABRT
#endif
#ifndef WHEN_LOADED
#define WHEN_LOADED none
#endif
#ifndef TROUBLE
#define TROUBLE none
#endif

namespace {

struct Step {
  std::uint64_t triangles;  // of the mesh created last: the worker has one at a time
  double seconds;           // the first coordinate
};

void die() { kill(getpid(), SIGNAL); }

[[maybe_unused]] void none(const Step&) {}

[[maybe_unused]] void at_once(const Step&) { die(); }

// Of every mesh whose number of triangles is divisible by 5.
[[maybe_unused]] void on_some_meshes(const Step& step) {
  constexpr std::uint64_t divisor = 5;
  if (step.triangles % divisor == 0) die();
}

// One time in 20, whatever the mesh is.
[[maybe_unused]] void at_random(const Step&) {
  constexpr unsigned one_in = 20;
  static std::mt19937_64 random(
      static_cast<std::uint64_t>(getpid()) ^
      static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count()));
  if (random() % one_in == 0) die();
}

[[maybe_unused]] void on_the_1000th_step(const Step&) {
  static std::atomic<int> steps = 0;
  if (++steps == 1000) die();
}

// Where the file that the variable ASSAY_TEST_FILE names is there.
[[maybe_unused]] void if_the_file_is_there(const Step&) {
  const char* file = std::getenv("ASSAY_TEST_FILE");
  if (file && access(file, F_OK) == 0) die();
}

// Uses so many seconds of processor time. Never more than a minute, should nobody end it.
void burn(const Step& step) {
  const auto used = [] {
    timespec now = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  constexpr double longest = 60;
  const double until = used() + std::min(step.seconds, longest);
  while (used() < until) {
  }
}

[[maybe_unused]] void burn_in_thread(const Step& step) { std::thread(burn, step).join(); }

[[maybe_unused]] void burn_in_child(const Step& step) {
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    burn(step);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

std::uint64_t triangles_now = 0;

std::int32_t create(const std::int32_t* triangles, std::uint64_t triangle_count,
                    const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                    const char** message) {
  triangles_now = triangle_count;
  return assay_builtin_detector()->create(triangles, triangle_count, positions, vertex_count,
                                          handle, message);
}

std::int32_t evaluate(assay_handle* handle, const double* x_t0, const double* x_t1) {
  TROUBLE({triangles_now, x_t0[0]});
  return assay_builtin_detector()->evaluate(handle, x_t0, x_t1);
}

}  // namespace

const assay_detector_api* assay_detector() {
  WHEN_LOADED({});
  return assay::tests::changed_builtin([](assay_detector_api& table) {
    table.create = create;
    table.evaluate = evaluate;
  });
}
