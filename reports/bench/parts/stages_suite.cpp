// Suite `stages` measures where the time of a step without views goes, from boxes to contacts.
#include <fmt/format.h>

#include <algorithm>

#include "detector/search/feature_pairs.h"
#include "detector/search/wide_search.h"
#include "reports/bench/cases.h"
#include "reports/bench/interleave.h"
#include "reports/bench/sweep.h"

namespace assay::reports {
namespace {

using namespace detector;

// The stages of a step, each without those after it.
class StepStages {
 public:
  StepStages(const std::string& name, const corpus::Sequence& step)
      : motion_{step.frames[0], step.frames[1]},
        mesh_(make_topology(step.triangles, motion_.size())),
        tree_(mesh_, motion_.vertices_t0),
        marks_(tree_),
        representatives_(mesh_),
        features_(mesh_, motion_, representatives_, marks_.types),
        detector_(made(Detector::create(step.triangles, step.frames[0],
                                        {Culling::bvh, Start::verified, Pairs::all}),
                       name)) {
    fit();
    for (const auto& corners : mesh_.triangles)
      boxes_.push_back(tree_.box_of_triangle(corners, motion_));
    search([this](std::span<const CandidatePair> pairs) {
      candidates_.insert(candidates_.end(), pairs.begin(), pairs.end());
    });
  }

  void fit() {
    tree_.refit(mesh_, motion_);
    features_.refit(motion_, nullptr, 0);
  }

  template <class Take>
  SearchCounts search(const Take& take) {
    SearchCounts counts;
    WideSearch().search({mesh_, tree_, marks_, everything_}, counts,
                        PairSink::in_lanes([&](std::span<const CandidatePair> pairs, std::size_t) {
                          take(pairs);
                          return true;
                        }));
    return counts;
  }

  std::size_t take_features(std::span<const CandidatePair> pairs) {
    keys_.clear();
    for (const auto& [a, b] : pairs) features_.append(a, b, true, keys_);
    return keys_.size();
  }

  // The boxes of every candidate, compared one after the other with nothing around it.
  std::size_t compare_again() const {
    std::size_t meet = 0;
    for (const auto& [a, b] : candidates_) meet += !apart(boxes_[at(a)], boxes_[at(b)]);
    return meet;
  }

  // Of the candidates those that share a vertex.
  double share_of_neighbours() const {
    const auto neighbours =
        std::count_if(candidates_.begin(), candidates_.end(), [&](const CandidatePair& pair) {
          const auto &p = mesh_.triangles[at(pair.a)], &q = mesh_.triangles[at(pair.b)];
          return std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) != p.end();
        });
    return static_cast<double>(neighbours) / static_cast<double>(std::max<std::size_t>(1, size()));
  }

  std::size_t size() const { return candidates_.size(); }

  StepResult evaluate() {
    detector_.reset();
    return detector_.evaluate(motion_.vertices_t0, motion_.vertices_t1);
  }

 private:
  SteppedMesh motion_;
  Topology mesh_;
  BoundingVolumeTree tree_;
  Marks marks_;
  Representatives representatives_;
  FeaturePairs features_;
  Detector detector_;
  PairTables everything_ = EveryPair().candidates();
  std::vector<MovingBox> boxes_;
  std::vector<CandidatePair> candidates_;
  std::vector<FeatureKey> keys_;
};

void measure(const std::string& name, const corpus::Sequence& step, int rounds,
             BenchReport& report) {
  StepStages stages(name, step);
  const auto through_features = [&] {
    stages.fit();
    std::size_t features = 0;
    stages.search([&](auto pairs) { features += stages.take_features(pairs); });
    keep(features);
  };
  const auto samples =
      interleave(rounds, {[&] { return ns_of([&] { stages.fit(); }); },
                          [&] {
                            return ns_of([&] {
                              stages.fit();
                              keep(stages.search([](auto) {}).candidate_pairs);
                            });
                          },
                          [&] { return ns_of(through_features); },
                          [&] { return ns_of([&] { keep(stages.evaluate().pairs.size()); }); },
                          [&] { return ns_of([&] { keep(stages.compare_again()); }); }});
  if (stages.compare_again() != stages.size())
    report.wrong_answers.push_back(name + ": boxes of a candidate are apart");
  const StepResult result = stages.evaluate();
  const auto& counts = result.counts;
  const auto ms = [&](std::size_t i) { return 1e-6 * median_of(samples[i]).value; };
  const double whole = ms(3), candidates = static_cast<double>(stages.size());
  const auto add = [&](const std::string& what, double part, const std::string& note) {
    report.add(fmt::format("{}: {}", name, what), "ms", exactly(part), {},
               fmt::format("{:.0f} %; {}", 100 * part / whole, note));
  };
  add("step", whole,
      fmt::format("{} triangles, {} pairs in contact", step.triangles.rows(), result.pairs.size()));
  add("boxes", ms(0),
      fmt::format("{:.0f} bytes written a triangle",
                  48 + 64 * static_cast<double>(step.frames[0].rows()) /
                           static_cast<double>(step.triangles.rows())));
  add("descent", ms(1) - ms(0),
      fmt::format("{} box tests, {} candidates, {:.0f} % of them neighbours; {:.1f} ns a candidate",
                  counts.search.box_tests, counts.search.candidate_pairs,
                  100 * stages.share_of_neighbours(), 1e6 * (ms(1) - ms(0)) / candidates));
  add("the boxes of all candidates in a bare loop", ms(4),
      fmt::format("{:.1f} ns a candidate, 96 bytes read for each", 1e6 * ms(4) / candidates));
  add("feature pairs", ms(2) - ms(1),
      fmt::format("{:.1f} ns a candidate, 384 bytes read for each",
                  1e6 * (ms(2) - ms(1)) / candidates));
  const auto& rungs = counts.narrow.rungs;
  add("elementary tests, and the rest", whole - ms(2),
      fmt::format("{} tests: filter {}, fixed {}, unbounded {}", counts.narrow.elementary_tests,
                  rungs.filter, rungs.fixed, rungs.unbounded));
}

// The same step, so short that hardly a vertex moves.
corpus::Sequence shortened(corpus::Sequence step) {
  constexpr double part = 1e-5;
  step.frames[1] = step.frames[0] + part * (step.frames[1] - step.frames[0]);
  return step;
}

}  // namespace

BenchReport stages_suite(const BenchSettings& settings, const BenchProgress& progress) {
  BenchReport report("stages");
  const int rounds = settings.rounds(15);
  const auto measured = [&](const std::string& name, const corpus::Sequence& step) {
    progress.phase(name);
    measure(name, step, rounds, report);
  };
  if (const auto rods = rod_twist_step(settings)) {
    measured("rod-twist", *rods);
    measured("rod-twist shortened", shortened(*rods));
  } else {
    report.add_no_data("rod-twist", settings.file("scalable-ccd/rod-twist/frames/"));
  }
  const int triangles = settings.triangles(20'000);
  measured("folding-sheet", bench_step("folding-sheet", triangles, 21, 19));
  measured("layered-cloth", bench_step("layered-cloth", triangles, 11, 5));
  measured("crumpling-sphere", bench_step("crumpling-sphere", triangles, 11, 8));
  return report;
}

}  // namespace assay::reports
