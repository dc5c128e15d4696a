// Suite `growth` measures time and memory from a thousand to four million triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/bench/contact_step.h"
#include "reports/bench/interleave.h"
#include "reports/bench/peak_memory.h"
#include "reports/bench/suites.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using namespace detector;

constexpr int full_sizes[] = {1'000, 5'000, 25'000, 100'000, 400'000, 1'000'000, 4'000'000};

// The times of one kind of work, by the size of the mesh.
struct Growth {
  std::string label;
  std::vector<double> sizes = {}, ms = {};
  std::vector<Estimate> estimates = {};

  void add(double triangles, const std::vector<double>& ns, const std::string& note,
           BenchReport& report) {
    const Estimate estimate = scaled(median_of(ns), 1e-6);
    report.add(fmt::format("{}, {} triangles", label, triangles), "ms", estimate, {}, note);
    sizes.push_back(triangles);
    ms.push_back(estimate.value);
    estimates.push_back(estimate);
  }

  void add_points(BenchReport& report) const {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      report.growth.push_back({label, sizes[i], estimates[i]});
    }
  }

  // What is wanted is an exponent no larger than that of n log n over the same sizes.
  void judge(BenchReport& report) const {
    if (sizes.size() < 2) return;
    std::vector<double> n_log_n;
    for (const double n : sizes) n_log_n.push_back(n * std::log(n));
    double least = 1e300, largest = 0;
    for (std::size_t i = 0; i < ms.size(); ++i) {
      least = std::min(least, ms[i] / n_log_n[i]);
      largest = std::max(largest, ms[i] / n_log_n[i]);
    }
    report.add(label + ": exponent of growth", "", exactly(growth_exponent(sizes, ms)),
               at_most(growth_exponent(sizes, n_log_n)),
               fmt::format("wanted: that of n log n; time/(n log n) varies {:.2f} times",
                           largest / least));
  }
};

struct Growths {
  Growth create{"preprocessing"}, free{"free step"}, contact{"step with contacts"};
};

int repetitions(int triangles) {
  constexpr int work = 2'000'000;
  return std::clamp(work / triangles, 3, 15);
}

// With fewer triangles than this, pages are too coarse a measure of memory.
constexpr int least_for_memory = 20'000;

// The highest memory of preprocessing and a step, in bytes.
struct Memory {
  std::optional<double> of_free, of_contact;
};

// REQUIRES a process that has not freed much yet (peak_memory.h). Steps are made in its children.
Memory memory_of(int wanted_triangles) {
  std::optional<corpus::Sequence> step;
  const auto work = [&] {
    auto made =
        Detector::create(step->triangles, step->frames[0], bench_options(Culling::view_point));
    const StepResult result = made.value().step(step->frames[0], step->frames[1]);
    keep(result);
  };
  return {
      peak_memory_of(work, [&] { step = bench_scene("breathing-sphere", wanted_triangles, 11); }),
      peak_memory_of(work,
                     [&] { step = step_at_first_contact("dented-sphere", wanted_triangles); })};
}

void add_memory(const std::string& label, std::optional<double> bytes, Eigen::Index triangles,
                BenchReport& report) {
  const std::string name = "memory, " + label;
  if (!bytes) return report.add_no_data(name, "/proc/self");
  report.add(fmt::format("{}, {} triangles", name, triangles), "bytes/triangle",
             exactly(*bytes / static_cast<double>(triangles)), wanted::memory_bytes_a_triangle,
             "highest over preprocessing and a step");
}

void measure(int wanted_triangles, const std::optional<Memory>& memory,
             const BenchSettings& settings, Growths& growths, BenchReport& report) {
  const auto sphere = bench_scene("breathing-sphere", wanted_triangles, 11);
  const std::span free_frames(sphere.frames.data(), 3);
  const auto triangles = static_cast<double>(sphere.triangles.rows());
  const int rounds = settings.rounds(repetitions(wanted_triangles));
  const Options options = bench_options(Culling::view_point);
  TimedStep free("free step", sphere.triangles, free_frames, options, report);
  auto samples = interleave(
      rounds,
      {[&] { return free.time(); },
       [&] {
         return ns_of([&] { keep(Detector::create(sphere.triangles, sphere.frames[0], options)); });
       }});
  growths.free.add(triangles, samples[0], free.result().counts.free_components ? "" : "NOT free",
                   report);
  growths.create.add(triangles, samples[1], "a sphere", report);
  if (memory) add_memory("free step", memory->of_free, sphere.triangles.rows(), report);

  const auto dented = step_at_first_contact("dented-sphere", wanted_triangles);
  if (!dented) return;
  TimedStep contact("step with contacts", dented->triangles, dented->frames, options, report);
  samples = interleave(rounds, {[&] { return contact.time(); }});
  growths.contact.add(static_cast<double>(dented->triangles.rows()), samples[0],
                      fmt::format("{} pairs, V+ {:.1f} %", contact.result().pairs.size(),
                                  100 * contact.positive_share()),
                      report);
  if (memory)
    add_memory("step with contacts", memory->of_contact, dented->triangles.rows(), report);
}

}  // namespace

BenchReport growth_suite(const BenchSettings& settings, Progress& progress) {
  BenchReport report("growth");
  Growths growths;
  std::map<int, std::optional<Memory>> sizes;
  for (const int size : full_sizes) sizes[settings.triangles(size)];
  for (auto& [triangles, memory] : sizes) {
    if (triangles < least_for_memory) continue;
    progress.phase(fmt::format("memory, {} triangles", triangles));
    memory = memory_of(triangles);
  }
  for (const auto& [triangles, memory] : sizes) {
    progress.phase(fmt::format("{} triangles", triangles));
    measure(triangles, memory, settings, growths, report);
  }
  for (const Growth* growth : {&growths.create, &growths.free, &growths.contact}) {
    growth->judge(report);
    growth->add_points(report);
  }
  return report;
}

}  // namespace assay::reports
