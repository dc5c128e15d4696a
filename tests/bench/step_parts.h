// What the micro benches share: steps by name, and the parts of a step, each without those after
// it.
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

// A size or a count, times what ASSAY_BENCH_SCALE says (default 1), but at least 320.
int sized(int full);

// The settings of the product's benches: data of ASSAY_DATA, the same scale.
reports::BenchSettings settings();

// The caller vouches for the start, and all pairs are asked for.
inline detector::Options bench_options(
    detector::Culling culling, detector::Arithmetic arithmetic = detector::Arithmetic::exact) {
  return {culling, detector::Start::clean, detector::Pairs::all, arithmetic};
}

// Two of the frames of a scene: the step from frame `step` on.
corpus::Sequence bench_step(const std::string& name, int triangles, int frames, std::size_t step);

// The steps that parts of a step are measured on: `rod-twist` of the public data, the same
// shortened until hardly a vertex moves, and steps of scenes.
inline constexpr const char* step_names[] = {"rod-twist", "rod-twist-shortened", "folding-sheet",
                                             "layered-cloth", "crumpling-sphere"};
// Made once. Nothing if its data is not there.
const std::optional<corpus::Sequence>& step_named(const std::string& name);
// Why there is none: of the public data that is no fault.
const char* why_absent(const std::string& name);

// Adds the time of each of `items` things to what is shown.
void show_each(benchmark::State& state, std::size_t items);

// Registers a benchmark of this name, which gets the arguments.
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
  // Of the step of this name, made once. Null, and the benchmark is skipped, if it is not there.
  static StepParts* of(const std::string& name, benchmark::State& state);

  // Writes the boxes of nodes and features.
  void fit();
  using Take = std::function<void(std::span<const detector::CandidatePair>)>;
  void search(const Take& take) const;
  std::size_t take_features(std::span<const detector::CandidatePair> pairs);
  // Compares the boxes of every candidate, one after the other with nothing around it.
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
