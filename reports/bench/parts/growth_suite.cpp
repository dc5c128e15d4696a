// Suite `growth` measures time and memory from a thousand to four million triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/pictures.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

constexpr int full_sizes[] = {1'000, 5'000, 25'000, 100'000, 400'000, 1'000'000, 4'000'000};

// The times of one kind of work, by the size of the mesh.
using Growth = std::vector<GrowthPoint>;

void add_time(const char* label, double triangles, const std::vector<double>& ns,
              const std::string& note, Growth& growth, BenchReport& report) {
  growth.push_back({label, triangles, scaled(median_of(ns), 1e-6)});
  report.add(fmt::format("{}, {} triangles", label, triangles), "ms", growth.back().ms, {}, note);
}

// What is wanted is an exponent no larger than that of n log n over the same sizes.
void judge(const Growth& growth, BenchReport& report) {
  if (growth.size() < 2) return;
  std::vector<double> sizes, ms, n_log_n;
  double least = 1e300, largest = 0;
  for (const auto& point : growth) {
    sizes.push_back(point.triangles);
    ms.push_back(point.ms.value);
    n_log_n.push_back(point.triangles * std::log(point.triangles));
    least = std::min(least, ms.back() / n_log_n.back());
    largest = std::max(largest, ms.back() / n_log_n.back());
  }
  report.add(
      growth.front().label + ": exponent of growth", "", exactly(growth_exponent(sizes, ms)),
      at_most(growth_exponent(sizes, n_log_n)),
      fmt::format("wanted: that of n log n; time/(n log n) varies {:.2f} times", largest / least));
}

struct Growths {
  Growth create, free, contact;
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

// REQUIRES a process that has not freed much yet (interleave.h). Steps are made in its children.
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
  add_time("free step", triangles, samples[0],
           free.result().counts.free_components ? "" : "NOT free", growths.free, report);
  add_time("preprocessing", triangles, samples[1], "a sphere", growths.create, report);
  if (memory) add_memory("free step", memory->of_free, sphere.triangles.rows(), report);

  const auto dented = step_at_first_contact("dented-sphere", wanted_triangles);
  if (!dented) return;
  TimedStep contact("step with contacts", dented->triangles, dented->frames, options, report);
  samples = interleave(rounds, {[&] { return contact.time(); }});
  add_time("step with contacts", static_cast<double>(dented->triangles.rows()), samples[0],
           fmt::format("{} pairs, V+ {:.1f} %", contact.result().pairs.size(),
                       100 * contact.positive_share()),
           growths.contact, report);
  if (memory)
    add_memory("step with contacts", memory->of_contact, dented->triangles.rows(), report);
}

}  // namespace

BenchReport growth_suite(const BenchSettings& settings, const BenchProgress& progress) {
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
  Growth all;
  for (const Growth* growth : {&growths.create, &growths.free, &growths.contact}) {
    judge(*growth, report);
    all.insert(all.end(), growth->begin(), growth->end());
  }
  report.picture = growth_picture(all);
  return report;
}

}  // namespace assay::reports
