#include "reports/bench/cases.h"

#include <fmt/format.h>

#include <filesystem>

#include "corpus/hard/hard_families.h"
#include "corpus/scenes/scenes.h"
#include "detector/detector.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"

namespace assay::reports {

using namespace detector;

corpus::Sequence bench_scene(const std::string& name, int triangles, int frames) {
  return corpus::make_scene(name, {triangles, frames, {}}).value();
}

namespace {

double mean_edge_length(const Triangles& triangles, const Positions& x) {
  double sum = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      sum += (x.row(triangles(t, k)) - x.row(triangles(t, (k + 1) % 3))).norm();
    }
  }
  return sum / (3 * static_cast<double>(triangles.rows()));
}

// Returns the first step with a contact, and the detector's result; one beyond the last if there is
// none.
std::pair<std::size_t, StepResult> first_collision(const corpus::Sequence& sequence,
                                                   const Options& options,
                                                   const std::string& name) {
  auto detector = take(Detector::create(sequence.triangles, sequence.frames[0], options), name);
  std::size_t step = 0;
  StepResult result;
  for (; step + 1 < sequence.frames.size(); ++step) {
    result = detector.evaluate(sequence.frames[step], sequence.frames[step + 1]);
    if (result.answer == Answer::collision) break;
  }
  return {step, std::move(result)};
}

}  // namespace

std::optional<corpus::Sequence> step_at_first_contact(const std::string& name, int triangles) {
  constexpr int frames = 41;
  const auto scene = bench_scene(name, triangles, frames);
  const auto [f, result] =
      first_collision(scene, {Culling::view_point, Start::clean, Pairs::first}, name);
  if (f + 1 == scene.frames.size()) return std::nullopt;
  const Positions &x0 = scene.frames[f], &x1 = scene.frames[f + 1];
  const double fastest = (x1 - x0).rowwise().norm().maxCoeff();
  const double half = 0.5 * mean_edge_length(scene.triangles, x0) / fastest;
  const double begin = std::max(0.0, result.first.lo - half), end = result.first.hi + half;
  const Positions a = x0 + begin * (x1 - x0), b = x0 + end * (x1 - x0);
  return corpus::Sequence{scene.triangles, {a, b}};
}

corpus::Sequence around_first_contact(const corpus::Sequence& sequence) {
  constexpr std::size_t before = 3, after = 2;
  const std::size_t steps = sequence.frames.size() - 1;
  const auto first =
      first_collision(sequence, {Culling::bvh, Start::verified, Pairs::first}, "scene").first;
  const std::size_t begin = first > before && first < steps ? first - before : 0;
  const std::size_t end = std::min(steps, begin + before + after);
  return {sequence.triangles,
          {sequence.frames.begin() + static_cast<std::ptrdiff_t>(begin),
           sequence.frames.begin() + static_cast<std::ptrdiff_t>(end) + 1}};
}

BenchCase timed_case(const std::string& id, corpus::Sequence sequence, Start start) {
  BenchCase out{{}, start};
  out.c.id = id;
  out.c.triangles = std::move(sequence.triangles);
  out.c.frames = std::move(sequence.frames);
  return out;
}

namespace {

struct PublicFiles {
  const char *name, *pattern;  // of the files of its frames
  int first, last;
  Start start;
};
constexpr PublicFiles public_files[] = {
    {"rod-twist", "scalable-ccd/rod-twist/frames/{}.ply", 3036, 3037, Start::clean},
    {"thick-cloth", "ipc-toolkit/thick-cloth/t{}.ply", 0, 1, Start::verified},
    {"kick", "codim-ipc-kick/shell{}.obj.gz", 56, 62, Start::verified}};

}  // namespace

std::vector<BenchCase> real_sequences(const BenchSettings& settings,
                                      std::vector<std::string>& missing) {
  // The first missing file is named.
  const auto is_there = [&](const std::filesystem::path& file) {
    std::error_code ignored;
    const bool exists = std::filesystem::exists(file, ignored);
    if (!exists) missing.push_back(file.string());
    return exists;
  };
  std::vector<BenchCase> list;
  for (const auto& data : public_files) {
    std::vector<std::filesystem::path> files;
    for (int f = data.first; f <= data.last; ++f)
      files.emplace_back(settings.data + "/" + fmt::format(fmt::runtime(data.pattern), f));
    if (std::all_of(files.begin(), files.end(), is_there))
      list.push_back(timed_case(data.name, take(corpus::read_sequence(files)), data.start));
  }
  constexpr int frames = 6;
  if (const auto bunny = settings.data + "/ipc-toolkit/bunny.ply"; is_there(bunny))
    list.push_back(timed_case(
        "bunny-bent", take(corpus::make_scene("bend", {0, frames, take(corpus::read_mesh(bunny))})),
        Start::clean));
  return list;
}

std::vector<CaseFamily> scene_families(const BenchSettings& settings) {
  std::vector<CaseFamily> list;
  for (const auto& info : corpus::scenes()) {
    const std::string name(info.name);
    list.push_back({name, "scene", settings.rounds(5), [name, info, settings] {
                      const Start start = info.closed ? Start::clean : Start::verified;
                      const auto scene = bench_scene(name, settings.triangles(info.default_size),
                                                     info.default_frames);
                      return std::vector{timed_case(name, around_first_contact(scene), start)};
                    }});
  }
  return list;
}

std::vector<CaseFamily> real_families(const BenchSettings& settings,
                                      std::vector<std::string>& missing) {
  std::vector<CaseFamily> list;
  for (auto& real : real_sequences(settings, missing)) {
    const auto name = real.c.id;
    list.push_back({name, "real", settings.rounds(3),
                    [cases = std::vector{std::move(real)}] { return cases; }});
  }
  return list;
}

namespace {

BenchCase with_known_start(corpus::Case c) {
  const bool clean = properties::starts_clean(c);
  return {std::move(c), clean ? Start::clean : Start::verified};
}

CaseFamily generated_family(const properties::Family& family, const BenchSettings& settings) {
  return {std::string(family.name), "generated", settings.rounds(5), [&family, settings] {
            std::vector<BenchCase> cases;
            const int count = settings.rounds(60);
            for (int i = 0; i < count; ++i) {
              const auto id = fmt::format("bench:1:{}:{}", family.name, i);
              cases.push_back(with_known_start(properties::make_case(family, id).c));
            }
            return cases;
          }};
}

// Takes four strengths from the weakest to the strongest, and a case of each kind. Crowds of more
// than some hundred triangles, in which all triangles meet each other, are left out, because one
// such step takes seconds.
CaseFamily hard_family(const corpus::HardFamily& family, const BenchSettings& settings) {
  return {std::string(family.name), "hard", settings.rounds(5), [&family, settings] {
            constexpr Eigen::Index most_triangles = 600;
            std::vector<BenchCase> cases;
            const int strengths = settings.rounds(4);
            for (int s = 0; s < strengths; ++s) {
              const int strength = family.strongest * s / (strengths - 1);
              for (int kind = 0; kind < family.kinds; ++kind) {
                auto c = corpus::hard_case(family, strength, kind);
                if (c.triangles.rows() <= most_triangles)
                  cases.push_back(with_known_start(std::move(c)));
              }
            }
            return cases;
          }};
}

}  // namespace

std::vector<CaseFamily> all_families(const BenchSettings& settings,
                                     std::vector<std::string>& missing) {
  auto list = scene_families(settings);
  for (const auto& family : properties::families())
    list.push_back(generated_family(family, settings));
  for (const auto& family : corpus::hard_families()) list.push_back(hard_family(family, settings));
  for (auto& real : real_families(settings, missing)) list.push_back(std::move(real));
  return list;
}

}  // namespace assay::reports
