// Shared code of the micro benches: steps by name, and the parts of a step, each of which runs
// without the later parts.
#pragma once

#include <benchmark/benchmark.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "detector/contact/lanes/query_lanes.h"
#include "detector/search/feature_pairs.h"
#include "detector/search/pair_search.h"
#include "reports/bench/cases.h"

namespace assay::tests {

// Returns a size or a count, multiplied by ASSAY_BENCH_SCALE (default 1), but at least 320.
int sized(int full);

// Returns the settings of `assay bench`, with the data of ASSAY_DATA and the scale of
// ASSAY_BENCH_SCALE.
reports::BenchSettings settings();

// Returns options with which the caller vouches for the start, and all pairs are reported.
inline detector::Options bench_options(
    detector::Culling culling, detector::Arithmetic arithmetic = detector::Arithmetic::exact) {
  return {culling, detector::Start::clean, detector::Pairs::all, arithmetic};
}

// Returns the step of a scene that begins at frame `step`.
corpus::Sequence bench_step(const std::string& name, int triangles, int frames, std::size_t step);

// The steps whose parts are measured: `rod-twist` of the public data, this step shortened until
// hardly a vertex moves, and steps of scenes.
inline constexpr const char* step_names[] = {"rod-twist", "rod-twist-shortened", "folding-sheet",
                                             "layered-cloth", "crumpling-sphere"};
// Returns the step of this name, which is made once; nothing if its data is absent.
const std::optional<corpus::Sequence>& step_named(const std::string& name);
// Returns why a step is absent. If public data is missing, that is no error.
const char* why_absent(const std::string& name);

// Also shows the time of a single thing, out of `items` things.
void show_each(benchmark::State& state, std::size_t items);

// Registers a benchmark of this name, which calls `function` with the arguments.
template <class Function, class... Arguments>
benchmark::internal::Benchmark* add(const std::string& name, Function function,
                                    Arguments... arguments) {
  return benchmark::RegisterBenchmark(
             name.c_str(), [=](benchmark::State& state) { function(state, arguments...); })
      ->Unit(benchmark::kMillisecond);
}

class StepParts {
 public:
  explicit StepParts(const corpus::Sequence& step);
  // Returns the parts of the step of this name, which are made once. If the step is absent, returns
  // null and skips the benchmark.
  static StepParts* of(const std::string& name, benchmark::State& state);

  // Writes the boxes of nodes and features.
  void fit();
  using Take = std::function<void(std::span<const detector::CandidatePair>)>;
  void search(const Take& take) const;
  std::size_t take_features(std::span<const detector::CandidatePair> pairs);
  // Compares the boxes of every candidate in turn, and does nothing else.
  std::size_t compare_again() const;

  const detector::Topology& mesh() const { return mesh_; }
  const detector::SteppedMesh& motion() const { return motion_; }
  std::span<const detector::CandidatePair> candidates() const { return candidates_; }
  // The feature pairs that are tested, and the vertices of each. Vertex-face pairs stand first.
  std::vector<detector::QueryVertices> queries(detector::FeatureKind kind) const;

 private:
  detector::SteppedMesh motion_;
  detector::Topology mesh_;
  detector::BoundingVolumeTree tree_;
  detector::Marks marks_;
  detector::Representatives representatives_;
  detector::FeaturePairs features_;
  detector::PairTables everything_ = detector::EveryPair().candidates();
  std::vector<detector::MovingBox> boxes_;
  std::vector<detector::CandidatePair> candidates_;
  std::vector<detector::FeatureKey> keys_, all_keys_;
};

}  // namespace assay::tests
