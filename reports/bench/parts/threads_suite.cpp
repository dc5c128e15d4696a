// Suite `threads` measures what several threads gain and what they take.
#include <fmt/format.h>

#include <thread>

#include "detector/assembly.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/parts/measuring_arena.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

void play(Detector& detector, const corpus::Sequence& sequence) {
  for (std::size_t f = 0; f + 1 < sequence.frames.size(); ++f)
    keep(detector.step(sequence.frames[f], sequence.frames[f + 1]));
}

// On a smaller mesh the threads themselves take more than the mesh.
constexpr Eigen::Index least_for_thread_memory = 20'000;

// The highest memory of preprocessing and the whole sequence. It is measured in a child process,
// and before this process has threads, because threads do not outlive a fork.
void measure_memory(const RealSequence& real, BenchReport& report) {
  const auto bytes_of = [&](std::uint32_t threads) {
    const auto work = [&] {
      auto detector =
          made(Detector::create(real.frames.triangles, real.frames.frames[0],
                                options_of_sequence(Culling::automatic, real.start(), threads)),
               real.name);
      play(detector, real.frames);
    };
    return peak_memory_of(work);
  };
  const auto alone = bytes_of(1);
  for (const std::uint32_t threads : {2u, 4u, 8u}) {
    const std::string label = fmt::format("{}: memory a further thread, of {}", real.name, threads);
    const auto bytes = bytes_of(threads);
    if (!alone || !bytes) {
      report.add_no_data(label, "/proc/self");
      continue;
    }
    constexpr double mega = 1 << 20;
    report.add(label, "%", exactly(100 * (*bytes / *alone - 1) / (threads - 1)),
               wanted_if(real.frames.triangles.rows() >= least_for_thread_memory,
                         wanted::memory_a_thread_percent),
               fmt::format("{:.1f} MB with {} threads, {:.1f} with one", *bytes / mega, threads,
                           *alone / mega));
  }
}

void time_free_steps(const BenchSettings& settings, std::uint32_t cores, BenchReport& report) {
  const auto sphere =
      bench_scene("breathing-sphere", settings.triangles(wanted::free_step_triangles), 11);
  const auto &x0 = sphere.frames[0], &x1 = sphere.frames[1], &x2 = sphere.frames[2];
  const Topology mesh = make_topology(sphere.triangles, x0.rows());
  std::vector<Measurement> measurements;
  std::vector<Workers> workers;
  std::vector<Detector> detectors;
  for (const std::uint32_t threads : {1u, cores}) {
    workers.emplace_back(threads);
    detectors.push_back(
        made(Detector::create(sphere.triangles, x0,
                              options_of_sequence(Culling::automatic, Start::clean, threads)),
             "breathing sphere"));
    detectors.back().step(x0, x1);
  }
  for (const std::size_t i : {0u, 1u}) {
    measurements.push_back(
        [&, i] { return wall_ns_of([&] { keep(read_plainly(mesh, x1, x2, workers[i])); }); });
    measurements.push_back(
        [&, i] { return wall_ns_of([&] { keep(detectors[i].evaluate(x1, x2)); }); });
  }
  const auto samples = interleave(settings.rounds(61), measurements);
  if (result_hash(detectors[0].evaluate(x1, x2)) != result_hash(detectors[1].evaluate(x1, x2)))
    report.wrong_answers.push_back("free step: the result depends on the threads");
  const Estimate plain = ratio_of(samples[0], samples[2]), free = ratio_of(samples[1], samples[3]);
  report.add(fmt::format("plain pass: one thread over {}", cores), "times", plain, {},
             fmt::format("{} triangles", mesh.triangles.size()));
  report.add(fmt::format("free step: one thread over {}", cores), "times", free, {},
             fmt::format("{:.2f} ms with one", 1e-6 * median_of(samples[1]).value));
  report.add("free step's gain over the plain pass's", "times",
             ratio_of(free.samples, plain.samples),
             wanted_if(cores == 2, wanted::free_step_gain_over_plain_pass));
}

// What so many cores would make of the sequence: its time over the time that is left.
void find_critical_path(const RealSequence& real, Culling culling, std::uint32_t cores, int rounds,
                        BenchReport& report) {
  const auto& sequence = real.frames;
  std::vector<double> gains, serial_ms, waiting_ms;
  for (int round = 0; round <= rounds; ++round) {
    MeasuredLoops loops;
    auto options = options_of_sequence(culling, real.start(), 1);
    auto detector =
        made(assemble(sequence.triangles, sequence.frames[0], options, standard_stages(options), {},
                      Workers(make_measuring_arena(cores, loops), cores)),
             real.name);
    loops = {};
    const double taken = wall_ns_of([&] { play(detector, sequence); });
    if (round == 0) continue;  // it finds cold caches, and memory that is not yet mapped
    gains.push_back(taken / (taken - loops.saved()));
    serial_ms.push_back(1e-6 * (taken - loops.pieces));
    waiting_ms.push_back(1e-6 * (loops.longest_lanes - loops.pieces / cores));
  }
  report.add(
      fmt::format("{}, {}: {} cores, by the critical path", real.name, name_of(culling), cores),
      "times", median_of(gains), {},
      fmt::format("not shared out: {:.1f} ms; waiting for the longest lane: {:.1f} ms",
                  median_of(serial_ms).value, median_of(waiting_ms).value));
}

}  // namespace

BenchReport threads_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("threads");
  std::vector<std::string> missing;
  auto sequences = real_sequences(settings, missing);
  const std::string scene = "crumpling-sphere";  // is there without public data
  sequences.push_back({scene, bench_scene(scene, settings.triangles(25'000), 5), true});
  progress.phase("memory");
  for (const auto& real : sequences) measure_memory(real, report);
  const std::uint32_t cores = std::max(2u, std::thread::hardware_concurrency());
  progress.phase("free steps");
  time_free_steps(settings, cores, report);
  for (const auto& real : sequences) {
    progress.phase(real.name);
    for (const auto culling : {Culling::bvh, Culling::automatic}) {
      for (const std::uint32_t lanes : {2u, 4u, 16u})
        find_critical_path(real, culling, lanes, settings.rounds(5), report);
    }
  }
  for (const auto& file : missing) report.add_no_data("a public sequence", file);
  return report;
}

}  // namespace assay::reports
