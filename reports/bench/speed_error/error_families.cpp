#include "reports/bench/speed_error/error_families.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/hard/hard_families.h"
#include "corpus/scenes/scenes.h"
#include "detector/detector.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/generators/families.h"
#include "reports/bench/real_sequences.h"
#include "reports/bench/timed_step.h"

namespace assay::reports {
namespace {

using detector::Start;

TimedCase timed_case(const std::string& id, corpus::Sequence sequence, Start start) {
  TimedCase out;
  out.c.id = id;
  out.c.triangles = std::move(sequence.triangles);
  out.c.frames = std::move(sequence.frames);
  out.start = start;
  return out;
}

ErrorFamily scene_family(const corpus::SceneInfo& info, const BenchSettings& settings) {
  return {
      std::string(info.name), "scene", settings.rounds(5), [info, settings] {
        const auto scene = bench_scene(std::string(info.name),
                                       settings.triangles(info.default_size), info.default_frames);
        const Start start = info.closed ? Start::clean : Start::verified;
        return std::vector{timed_case(std::string(info.name), around_first_contact(scene), start)};
      }};
}

ErrorFamily generated_family(const properties::Family& family, const BenchSettings& settings) {
  return {std::string(family.name), "generated", settings.rounds(5), [&family, settings] {
            std::vector<TimedCase> cases;
            const int count = settings.rounds(60);
            for (int i = 0; i < count; ++i) {
              auto made =
                  properties::make_case(family, fmt::format("bench:1:{}:{}", family.name, i));
              const bool clean = properties::starts_clean(made.c);
              cases.push_back({std::move(made.c), clean ? Start::clean : Start::verified});
            }
            return cases;
          }};
}

// Takes four strengths from the weakest to the strongest, and a case of each kind. Crowds of more
// than some hundred triangles, in which each meets each, are left out, because one such step takes
// seconds.
ErrorFamily hard_family(const corpus::HardFamily& family, const BenchSettings& settings) {
  return {std::string(family.name), "hard", settings.rounds(5), [&family, settings] {
            constexpr Eigen::Index most_triangles = 600;
            std::vector<TimedCase> cases;
            const int strengths = settings.rounds(4);
            for (int s = 0; s < strengths; ++s) {
              const int strength = family.strongest * s / (strengths - 1);
              for (int kind = 0; kind < family.kinds; ++kind) {
                auto c = corpus::hard_case(family, strength, kind);
                if (c.triangles.rows() > most_triangles) continue;
                const bool clean = properties::starts_clean(c);
                cases.push_back({std::move(c), clean ? Start::clean : Start::verified});
              }
            }
            return cases;
          }};
}

}  // namespace

corpus::Sequence around_first_contact(const corpus::Sequence& sequence) {
  constexpr std::size_t before = 3, after = 2;
  auto made =
      detector::Detector::create(sequence.triangles, sequence.frames[0],
                                 {detector::Culling::bvh, Start::verified, detector::Pairs::first});
  if (!made) throw UnusableData(made.error().message);
  const std::size_t steps = sequence.frames.size() - 1;
  std::size_t first = 0;
  while (first < steps &&
         made.value().evaluate(sequence.frames[first], sequence.frames[first + 1]).answer !=
             detector::Answer::collision) {
    ++first;
  }
  std::size_t begin = first > before ? first - before : 0;
  if (first == steps) begin = 0;
  const std::size_t end = std::min(steps, begin + before + after);
  return {sequence.triangles,
          {sequence.frames.begin() + static_cast<std::ptrdiff_t>(begin),
           sequence.frames.begin() + static_cast<std::ptrdiff_t>(end) + 1}};
}

std::vector<ErrorFamily> error_families(const BenchSettings& settings,
                                        std::vector<std::string>& missing) {
  std::vector<ErrorFamily> list;
  for (const auto& info : corpus::scenes()) list.push_back(scene_family(info, settings));
  for (const auto& family : properties::families()) {
    list.push_back(generated_family(family, settings));
  }
  for (const auto& family : corpus::hard_families()) {
    list.push_back(hard_family(family, settings));
  }
  for (auto& real : real_sequences(settings, missing)) {
    const Start start = real.starts_clean ? Start::clean : Start::verified;
    std::vector cases = {timed_case(real.name, std::move(real.frames), start)};
    list.push_back(
        {real.name, "real", settings.rounds(3), [cases = std::move(cases)] { return cases; }});
  }
  return list;
}

}  // namespace assay::reports
