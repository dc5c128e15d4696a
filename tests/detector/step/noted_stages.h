// Stages that do what the standard ones do and note their calls.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "detector/step/stages.h"

namespace assay::detector::tests_of_steps {

using Notes = std::vector<std::string>;

// Calls of one stage in a row are one phase.
class Trace {
 public:
  void note(const char* phase) {
    if (notes_.empty() || notes_.back() != phase) notes_.emplace_back(phase);
  }
  Notes taken() { return std::exchange(notes_, {}); }

 private:
  Notes notes_;
};

template <class Stage>
struct Noted : Stage {
  explicit Noted(Trace& trace) : trace_(trace) {}
  Trace& trace_;
};

struct NotedClassifier : Noted<ViewClassifier> {
  using Noted::Noted;
  bool classify(const Topology& surface, const Component& component, const SteppedMesh& motion,
                const ViewPrimitive& primitive, std::vector<ViewSign>& signs, ViewCounts& counts,
                PacedStop& pace) const override {
    trace_.note("view test");
    return ViewClassifier::classify(surface, component, motion, primitive, signs, counts, pace);
  }
};

struct NotedBoundary : Noted<BoundaryHandler> {
  using Noted::Noted;
  std::vector<MovingPoint> place_apexes(const Surface& surface, const std::vector<ApexRule>& rules,
                                        const SteppedMesh& motion) const override {
    trace_.note("apexes");
    return BoundaryHandler::place_apexes(surface, rules, motion);
  }
  bool sweep(const GhostSweep& sweep, std::span<const std::int32_t> ghosts,
             const StopFunction& stop, std::vector<std::uint8_t>& touched,
             GhostCounts& counts) const override {
    trace_.note("ghosts");
    return BoundaryHandler::sweep(sweep, ghosts, stop, touched, counts);
  }
};

template <class Rule>
struct NotedRule : Noted<Rule> {
  using Noted<Rule>::Noted;
  using Noted<Rule>::trace_;
  PairTables candidates() const override {
    trace_.note("K");  // asked once more by the closure: what has been tested
    return Rule::candidates();
  }
  PairTables closure() const override {
    trace_.note("H");
    return Rule::closure();
  }
  bool joins_closure(const TrianglePair& contact, std::int32_t t) const override {
    trace_.note("join");
    return Rule::joins_closure(contact, t);
  }
};

struct NotedMarking : Noted<Marking> {
  using Noted::Noted;
  void mark(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree, Marks& marks,
            MarkingCounts& counts) const override {
    trace_.note("mark");
    Marking::mark(leaf, flags, tree, marks, counts);
  }
  void clear(std::int32_t leaf, std::uint8_t flags, const BoundingVolumeTree& tree, Marks& marks,
             MarkingCounts& counts) const override {
    trace_.note("clear");
    Marking::clear(leaf, flags, tree, marks, counts);
  }
};

struct NotedSearch : Noted<TreeSearch> {
  using Noted::Noted;
  bool fit(BoundingVolumeTree& tree, const Topology& mesh, const SteppedMesh& motion,
           PacedStop& pace) const override {
    trace_.note("fit");
    return TreeSearch::fit(tree, mesh, motion, pace);
  }
  bool search(const SearchInput& input, SearchCounts& counts, const PairSink& sink) const override {
    trace_.note("search");
    return TreeSearch::search(input, counts, sink);
  }
};

struct NotedTest : Noted<ElementaryTest> {
  using Noted::Noted;
  ContactResult test(const FourPoints& query, Want want) const override {
    trace_.note("test");
    return ElementaryTest::test(query, want);
  }
  bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const override {
    trace_.note("test");
    return ElementaryTest::pierces(e0, e1, face);
  }
};

struct NotedRelease : Noted<ReleaseRule> {
  using Noted::Noted;
  bool still_holds(const StepState& state, const PositionsView& x_t0,
                   const PacedStop& pace) const override {
    trace_.note("known?");
    return ReleaseRule::still_holds(state, x_t0, pace);
  }
  bool is_free(const GivenStep& step, const StepMarks& marks, StepCost& cost,
               std::size_t component) const override {
    trace_.note("free?");
    return ReleaseRule::is_free(step, marks, cost, component);
  }
  bool released_at_start(const GivenStep& step, const StepMarks& marks, StepCost& cost,
                         std::size_t component) const override {
    trace_.note("released?");
    return ReleaseRule::released_at_start(step, marks, cost, component);
  }
  bool verify_start(const GivenStep& step, StepMarks& marks, StepCost& cost,
                    const std::vector<std::int32_t>& components) const override {
    trace_.note("layers");
    return ReleaseRule::verify_start(step, marks, cost, components);
  }
  bool release(const GivenStep& step, StepMarks& marks, StepCost& cost,
               const std::vector<std::int32_t>& components) const override {
    trace_.note("release");
    return ReleaseRule::release(step, marks, cost, components);
  }
  void settle(const GivenStep& step, const StepMarks& marks, const std::vector<PairContact>& pairs,
              bool complete, StepState& state) const override {
    trace_.note("settle");
    ReleaseRule::settle(step, marks, pairs, complete, state);
  }
};

inline Stages noted_stages(const Options& options, Trace& trace) {
  Stages stages = standard_stages(options);
  stages.classifier = std::make_shared<NotedClassifier>(trace);
  stages.boundary = std::make_shared<NotedBoundary>(trace);
  if (options.culling == Culling::bvh) {
    stages.pair_rule = std::make_shared<NotedRule<EveryPair>>(trace);
  } else {
    stages.pair_rule = std::make_shared<NotedRule<PairRule>>(trace);
  }
  stages.marking = std::make_shared<NotedMarking>(trace);
  stages.pair_search = std::make_shared<NotedSearch>(trace);
  stages.elementary = std::make_shared<NotedTest>(trace);
  stages.release = std::make_shared<NotedRelease>(trace);
  return stages;
}

}  // namespace assay::detector::tests_of_steps
