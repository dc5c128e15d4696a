// The order in which a step calls its stages, which is that of the pseudo-code in
// detector/step/step.cpp. A stage that a step does not need must not be called.
#include "detector/assembly.h"
#include "detector/detector.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::pushed_octahedron, tests::side_by_side,
    tests::two_octahedra;

// Stages that do what the standard ones do and note their calls.

using Notes = std::vector<std::string>;

// Calls of one stage in a row are one phase.
class Trace {
 public:
  void note(const char* phase) {
    if (notes_.empty() || notes_.back() != phase) notes_.emplace_back(phase);
  }
  Notes take() { return std::exchange(notes_, {}); }

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

Stages noted_stages(const Options& options, Trace& trace) {
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

// A detector whose stages note their calls, and what it takes to step it.
class Traced {
 public:
  Traced(const Triangles& triangles, const Positions& x, Options options = {}) {
    auto detector = assemble(triangles, x, options, noted_stages(options, trace_));
    EXPECT_TRUE(detector.has_value());
    detector_ = std::make_unique<Detector>(std::move(detector.value()));
    detector_->state();  // makes what the first step with views would make
    trace_.take();
  }
  Notes step(const Positions& x_t0, const Positions& x_t1, Answer expected) {
    result = detector_->step(x_t0, x_t1, view_);
    EXPECT_EQ(result.answer, expected);
    return trace_.take();
  }
  // Whatever the search for a view primitive would choose.
  void view_from(const Point& q) { view_ = {{{q, q}, {q, q}}}; }

  StepResult result;

 private:
  Trace trace_;
  std::unique_ptr<Detector> detector_;
  std::vector<ViewPrimitive> view_;
};

constexpr Options clean_with_points = {Culling::view_point, Start::clean};

TEST(StepTrace, L5_FreeClosedStepEndsAfterTheViewTest) {
  Traced traced(octahedron(), octahedron_positions(1), clean_with_points);
  traced.view_from({0, 0, 0});
  EXPECT_EQ(traced.step(octahedron_positions(1), octahedron_positions(2), Answer::free),
            (Notes{"view test", "free?", "settle"}));
  EXPECT_EQ(traced.step(octahedron_positions(2), octahedron_positions(3), Answer::free),
            (Notes{"known?", "view test", "free?", "settle"}));
}

TEST(StepTrace, L3L7_ClosedStepWithAContact) {
  Traced traced(octahedron(), octahedron_positions(2), clean_with_points);
  traced.view_from({0, 0, 0});
  // Every triangle at the apex loses its sign; the others are reached by the closure.
  EXPECT_EQ(traced.step(octahedron_positions(2), pushed_octahedron(), Answer::collision),
            (Notes{"view test", "free?", "mark", "clear", "fit", "K", "search", "test", "H", "K",
                   "join", "mark", "search", "clear", "settle"}));
  // From here on with doubt, and L5 asked whether it can be put away.
  EXPECT_EQ(traced.step(pushed_octahedron(), octahedron_positions(2), Answer::collision),
            (Notes{"known?", "view test", "free?", "release", "test", "mark", "clear", "fit", "K",
                   "search", "test", "H", "K", "settle"}));
}

TEST(StepTrace, L9_VerifiedStartComesAfterTheViewTest) {
  Traced traced(octahedron(), octahedron_positions(2), {Culling::view_point, Start::verified});
  traced.view_from({5, 5, 5});
  const Notes notes = traced.step(octahedron_positions(2), octahedron_positions(2), Answer::free);
  ASSERT_GE(notes.size(), 5u);
  EXPECT_EQ(Notes(notes.begin(), notes.begin() + 4),
            (Notes{"view test", "free?", "released?", "layers"}));
  EXPECT_EQ(std::count(notes.begin(), notes.end(), "fit"), 1);
}

TEST(StepTrace, PairsFirstNeverCloses) {
  Traced traced(octahedron(), octahedron_positions(2),
                {Culling::view_point, Start::clean, Pairs::first});
  traced.view_from({0, 0, 0});
  EXPECT_EQ(traced.step(octahedron_positions(2), pushed_octahedron(), Answer::collision),
            (Notes{"view test", "free?", "mark", "clear", "fit", "K", "search", "test", "settle"}));
}

TEST(StepTrace, BvhKnowsNoViewsAndNoStart) {
  Traced traced(octahedron(), octahedron_positions(2), {Culling::bvh});
  EXPECT_EQ(traced.step(octahedron_positions(2), octahedron_positions(3), Answer::free),
            (Notes{"mark", "clear", "fit", "K", "search", "settle"}));
  EXPECT_EQ(traced.step(octahedron_positions(3), pushed_octahedron(), Answer::collision),
            (Notes{"known?", "fit", "K", "search", "test", "settle"}))
      << "no triangle changed its type";
}

// The octahedron without its two faces at the edge 0-2: a hole of four edges.
Triangles open_octahedron() {
  const Triangles all = octahedron();
  Triangles t(6, 3);
  t << all.middleRows(1, 3), all.middleRows(5, 3);
  return t;
}

TEST(StepTrace, L5_UnclosedAllPositiveStepSweepsNoGhosts) {
  Traced traced(open_octahedron(), octahedron_positions(1), clean_with_points);
  traced.view_from({-.125, -.125, 0});
  EXPECT_EQ(traced.step(octahedron_positions(1), octahedron_positions(2), Answer::free),
            (Notes{"apexes", "view test", "free?", "settle"}));
}

TEST(StepTrace, L11_GhostsAreSweptBeforeTheMarking) {
  Traced traced(open_octahedron(), octahedron_positions(2), clean_with_points);
  traced.view_from({-.125, -.125, 0});
  Positions through_the_hole = octahedron_positions(2);
  through_the_hole.row(1) << 2.5, 2.5, 0;  // the vertex -x, opposite the hole
  const Notes notes = traced.step(octahedron_positions(2), through_the_hole, Answer::free);
  EXPECT_GT(traced.result.violated, 0u);
  EXPECT_EQ(notes, (Notes{"apexes", "view test", "free?", "ghosts", "test", "mark", "clear", "fit",
                          "K", "search", "test", "H", "K", "settle"}));
}

TEST(StepTrace, L10_OneFreeComponentOfTwoSavesItsOwnPairsAlone) {
  const Positions x = octahedron_positions(2);
  Traced traced(two_octahedra(), side_by_side(x, x, 16), clean_with_points);
  // The first breathes, the second collides with itself.
  EXPECT_EQ(
      traced.step(side_by_side(x, x, 16),
                  side_by_side(octahedron_positions(3), pushed_octahedron(), 16),
                  Answer::collision),
      (Notes{"view test", "free?", "view test", "free?", "mark", "clear", "fit", "K", "search",
             "test", "H", "K", "join", "mark", "search", "test", "clear", "settle"}));
  EXPECT_EQ(traced.result.counts.free_components, 1u);
  for (const auto& contact : traced.result.pairs) EXPECT_GE(contact.pair.a, 8);
}

}  // namespace
}  // namespace assay::detector
