#include "reports/bench/peers/peer_memory.h"

#include "corpus/cases/case_file.h"
#include "properties/worker/worker_process.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

corpus::Case step_of_a_scene(int triangles) {
  constexpr int frames = 101;  // this many, so that a step moves little
  auto scene = bench_scene("bend", triangles, frames);
  corpus::Case c;
  c.triangles = std::move(scene.triangles);
  c.frames = {scene.frames[0], scene.frames[1]};
  return c;
}

}  // namespace

std::optional<double> bytes_a_triangle(const PeerSubject& subject) {
  std::optional<std::filesystem::path> library;
  if (!subject.is_built_in()) library = subject.library;
  properties::WorkerProcess worker(properties::worker_program(), library, {.seconds = 60});
  const properties::Configuration configuration = {subject.name, subject.options, {}, true};
  constexpr int small = 20, large = 20'480;
  double peaks[2] = {}, triangles = 0;
  for (const int size : {small, large}) {
    const auto c = step_of_a_scene(size);
    const auto run = worker.run(c, {&configuration, 1}).front();
    if (!run.times || run.times->peak_bytes == 0) return std::nullopt;
    peaks[size == large ? 1 : 0] = static_cast<double>(run.times->peak_bytes);
    triangles = static_cast<double>(c.triangles.rows());
  }
  return (peaks[1] - peaks[0]) / triangles;
}

}  // namespace assay::reports
