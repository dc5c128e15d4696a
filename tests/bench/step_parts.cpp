#include "tests/bench/step_parts.h"

#include <cstdlib>
#include <map>
#include <memory>

#include "tests/public_data.h"

namespace assay::tests {

using namespace detector;

namespace {

struct PublicFolder {
  const char* name = public_data();
};

}  // namespace

reports::BenchSettings settings() {
  const char* scale = std::getenv("ASSAY_BENCH_SCALE");
  const PublicFolder data;
  return {data.name ? data.name : "", scale ? std::strtod(scale, nullptr) : 1};
}

int sized(int full) { return settings().triangles(full); }

corpus::Sequence bench_step(const std::string& name, int triangles, int frames, std::size_t step) {
  auto scene = reports::bench_scene(name, triangles, frames);
  return {std::move(scene.triangles), {scene.frames[step], scene.frames[step + 1]}};
}

const std::optional<corpus::Sequence>& step_named(const std::string& name) {
  static std::map<std::string, std::optional<corpus::Sequence>> cache;
  if (const auto found = cache.find(name); found != cache.end()) return found->second;
  constexpr double hardly = 1e-5;
  auto& step = cache[name];
  const int triangles = sized(20'000);
  if (name.starts_with("rod-twist")) {
    std::vector<std::string> unused;
    for (auto& real : reports::real_sequences(settings(), unused)) {
      if (real.c.id == "rod-twist")
        step = corpus::Sequence{std::move(real.c.triangles), std::move(real.c.frames)};
    }
  }
  if (name == "rod-twist-shortened" && step)
    step->frames[1] = step->frames[0] + hardly * (step->frames[1] - step->frames[0]);
  if (name == "folding-sheet") step = bench_step(name, triangles, 21, 19);
  if (name == "layered-cloth") step = bench_step(name, triangles, 11, 5);
  // The first with a contact: bench_options promise a clean start.
  if (name == "crumpling-sphere") step = reports::step_at_first_contact(name, triangles);
  return step;
}

const char* why_absent(const std::string& name) {
  return name.starts_with("rod-twist") ? "no public data (ASSAY_DATA)" : "no such step";
}

void show_each(benchmark::State& state, std::size_t items) {
  using benchmark::Counter;
  state.counters["items"] = static_cast<double>(items);
  state.counters["each"] =
      Counter(static_cast<double>(items), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

StepParts::StepParts(const corpus::Sequence& step)
    : motion_{step.frames[0], step.frames[1]},
      mesh_(make_topology(step.triangles, motion_.size())),
      tree_(mesh_, motion_.vertices_t0),
      marks_(tree_),
      representatives_(mesh_),
      features_(mesh_, representatives_, marks_.types) {
  fit();
  for (const auto& corners : mesh_.triangles)
    boxes_.push_back(tree_.box_of_triangle(corners, motion_));
  search([this](auto pairs) {
    candidates_.insert(candidates_.end(), pairs.begin(), pairs.end());
    for (const auto& [a, b] : pairs) features_.append(a, b, false, all_keys_);
  });
}

StepParts* StepParts::of(const std::string& name, benchmark::State& state) {
  static std::map<std::string, std::unique_ptr<StepParts>> cache;
  const auto& step = step_named(name);
  if (!step) {
    state.SkipWithError(why_absent(name));
    return nullptr;
  }
  auto& parts = cache[name];
  if (!parts) parts = std::make_unique<StepParts>(*step);
  return parts.get();
}

void StepParts::fit() {
  tree_.refit(mesh_, motion_);
  features_.fit(motion_, nullptr, 0);
}

void StepParts::search(const Take& take) const {
  SearchCounts counts;
  WideSearch().search({mesh_, tree_, marks_, everything_}, counts,
                      PairSink::in_lanes([&](std::span<const CandidatePair> pairs, std::size_t) {
                        take(pairs);
                        return true;
                      }));
}

std::size_t StepParts::take_features(std::span<const CandidatePair> pairs) {
  keys_.clear();
  for (const auto& [a, b] : pairs) features_.append(a, b, true, keys_);
  return keys_.size();
}

std::size_t StepParts::compare_again() const {
  std::size_t meet = 0;
  for (const auto& [a, b] : candidates_) meet += !apart(boxes_[at(a)], boxes_[at(b)]);
  return meet;
}

std::vector<QueryVertices> StepParts::queries(FeatureKind kind) const {
  std::vector<QueryVertices> queries;
  for (const auto key : all_keys_) {
    if (kind_of(key) != kind) continue;
    const auto first = first_of(key), second = second_of(key);
    if (kind == FeatureKind::vertex_face) {
      const auto& f = mesh_.triangles[at(second)];
      queries.push_back({{first, f[0], f[1], f[2], -1}});
    } else {
      const auto &a = mesh_.edges[at(first)], &b = mesh_.edges[at(second)];
      queries.push_back({{a[0], a[1], b[0], b[1], -1}});
    }
  }
  return queries;
}

}  // namespace assay::tests
