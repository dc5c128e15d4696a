#include <barrier>

#include "detector/detector.h"
#include "detector/mesh/for_all.h"
#include "detector/state/layers.h"
#include "tests/detector/step/bare_step.h"
#include "tests/detector/view/revolved.h"

namespace assay::detector {
namespace {

using tests::BareStep, tests::octahedron, tests::octahedron_positions;

// Positions are copied and compared in pieces, of which 100,000 rows make several.
TEST(StepState, HoldsAtThePositionsThatItKeptAndAtNoOthers) {
  constexpr Eigen::Index count = 100'000;
  Positions x(count, 3);
  for (Eigen::Index v = 0; v < count; ++v) x.row(v) << 3. * v, 3. * v + 1, 3. * v + 2;
  PacedStop pace(never_stops);
  StepState state;
  state.keep(x, pace);
  EXPECT_TRUE(state.positions == x);
  EXPECT_TRUE(state.holds_at(x, pace));
  EXPECT_FALSE(state.holds_at(x.topRows(count - 1), pace)) << "the same as far as it goes";
  for (const Eigen::Index v : {Eigen::Index{0}, count / 2, count - 1}) {
    Positions other = x;
    other(v, 2) += 1;
    EXPECT_FALSE(state.holds_at(other, pace)) << v;
  }
}

// Begins all pieces before it ends one: each has a thread of its own, and they wait for each other
// at the beginning. So what a piece has read of another one's result is what stood there before.
class BeginTogether : public ThreadArena {
 public:
  void run(std::size_t count, const Work& work) override {
    std::barrier begin(static_cast<std::ptrdiff_t>(count));
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i) {
      threads.emplace_back([&, i] {
        begin.arrive_and_wait();
        work.run(i, i);
      });
    }
    for (auto& thread : threads) thread.join();
  }
};

// A piece that finds no difference must not take back what another one has found.
TEST(StepState, HoldsAtNoOtherPositionsWhicheverPieceEndsLast) {
  constexpr Eigen::Index pieces = 2, of_piece = least_shared, count = pieces * of_piece;
  const Workers workers(std::make_unique<BeginTogether>(), pieces);
  const Positions x = Positions::Constant(count, 3, 1.5);
  PacedStop pace(never_stops, workers);
  StepState state;
  state.keep(x, pace);
  EXPECT_TRUE(state.holds_at(x, pace));
  constexpr int repetitions = 100;
  Positions other = x;
  for (Eigen::Index piece = 0; piece < pieces; ++piece) {
    for (const Eigen::Index place : {Eigen::Index{1}, of_piece / 2, of_piece - 2}) {
      double& changed = other(piece * of_piece + place, 1);
      changed = 2.5;
      int believed = 0;
      for (int n = 0; n < repetitions; ++n) believed += state.holds_at(other, pace) ? 1 : 0;
      EXPECT_EQ(believed, 0) << "of " << repetitions << ", piece " << piece << ", row " << place;
      changed = 1.5;
    }
  }
}

TEST(Topology, AnOctahedronIsOneCycleAsItIsAlone) {
  const Topology mesh = make_topology(octahedron(), 6);
  EXPECT_EQ(mesh.edges.size(), 12u);
  ASSERT_EQ(mesh.components.size(), 1u);
  EXPECT_TRUE(mesh.components[0].is_cycle);
  for (std::int32_t e = 0; e < 12; ++e) EXPECT_EQ(mesh.edge_triangles.row(e).size(), 2u);
  Triangles all = octahedron();
  EXPECT_FALSE(make_topology(all.topRows(7), 6).components[0].is_cycle) << "one less";
  std::swap(all(0, 1), all(0, 2));
  EXPECT_FALSE(make_topology(all, 6).components[0].is_cycle) << "one flipped";
}

// What is clean by layers alone.
std::vector<std::uint8_t> clean_by_layers(const Triangles& triangles, const Positions& x,
                                          std::vector<std::uint8_t> touched = {},
                                          Arithmetic arithmetic = Arithmetic::exact) {
  const Surface surface = make_surface(triangles, x.rows());
  const auto count = static_cast<std::size_t>(triangles.rows());
  std::vector<std::uint8_t> clean(count, 2), is_seen(count, 0);
  touched.resize(count);
  mark_clean_by_layers({surface, x, touched, arithmetic}, 0, is_seen, clean);
  return clean;
}

// Two outward tetrahedra that share an edge, one inside the other: connected, embedded, but two
// pieces of different layers.
TEST(Layers, L9_PiecesNotConnectionDecide) {
  const Triangles t = tests::triangles(
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}});
  const Positions x =
      tests::positions({{0, 0, -4}, {0, 0, 4}, {8, -6, 0}, {8, 6, 0}, {4, -1.5, 0}, {4, 1.5, 0}});
  const Surface surface = make_surface(t, 6);
  ASSERT_TRUE(surface.mesh.components.size() == 1 && surface.is_closed());
  EXPECT_EQ(clean_by_layers(t, x), (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 0, 0, 0}))
      << "as many triangles in each layer: the one with triangle 0 is common";
}

TEST(Layers, L9_TouchedTrianglesStayDirty) {
  EXPECT_EQ(clean_by_layers(octahedron(), octahedron_positions(1), {0, 0, 1}),
            (std::vector<std::uint8_t>{1, 1, 0, 1, 1, 1, 1, 1}));
}

// However its triangles are numbered, all that is linked is one piece: one winding number.
TEST(Layers, L9_AFloodGoesBothWaysOverAnEdge) {
  const Triangles sphere = tests::revolved(tests::sphere_rings);
  const auto count = static_cast<std::size_t>(sphere.rows());
  Triangles mixed(sphere.rows(), 3);
  constexpr Eigen::Index stride = 37;  // prime to the number of triangles
  for (Eigen::Index t = 0; t < sphere.rows(); ++t)
    mixed.row(t) = sphere.row(t * stride % sphere.rows());
  const Surface surface = make_surface(mixed, tests::sphere(1).rows());
  ASSERT_TRUE(surface.is_closed());
  std::vector<std::uint8_t> clean(count, 0), is_seen(count, 0);
  const std::vector<std::uint8_t> untouched(count, 0);
  EXPECT_EQ(mark_clean_by_layers({surface, tests::sphere(1), untouched}, 0, is_seen, clean), 1u);
  EXPECT_EQ(clean, std::vector<std::uint8_t>(count, 1));
}

// What hangs together with a clean triangle has its layer: no winding number is counted.
TEST(Layers, L9_APieceBesideACleanTriangleNeedsNoWindingNumber) {
  const Surface surface = make_surface(octahedron(), 6);
  std::vector<std::uint8_t> clean = {1, 1, 0, 0, 0, 0, 1, 1}, is_seen(8, 0);
  const std::vector<std::uint8_t> untouched(8, 0);
  const std::vector<std::int32_t> in_doubt = {2, 3, 4, 5};
  EXPECT_EQ(release_pieces({surface, octahedron_positions(1), untouched}, 0, in_doubt, {0}, is_seen,
                           clean),
            0u);
  EXPECT_EQ(clean, std::vector<std::uint8_t>(8, 1));
}

// From a triangle without area no ray can start. If it is a piece of its own, nobody knows its
// layer, and the other pieces are released all the same.
TEST(Layers, L9_APieceOfUnknownLayerHoldsUpNoOther) {
  Positions x = octahedron_positions(1);
  x.row(4) = .5 * (x.row(0) + x.row(2));  // the tip of the first triangle, which is flat then
  EXPECT_EQ(clean_by_layers(octahedron(), x, {0, 1, 1, 1, 1, 1, 0, 1}),
            (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 1, 0}));
}

// Where doubles cannot tell the number at the first triangle of a piece they may at the next one.
TEST(Layers, L9_DoublesTryMoreThanOneTriangle) {
  const Triangles sphere = tests::revolved(tests::sphere_rings);
  Positions x = tests::sphere(1);
  x.row(sphere(0, 2)) = .5 * (x.row(sphere(0, 0)) + x.row(sphere(0, 1)));
  const auto clean = clean_by_layers(sphere, x, {}, Arithmetic::bounded);
  EXPECT_EQ(clean, std::vector<std::uint8_t>(clean.size(), 1));
}

// The state holds at positions that are equal in every bit, whatever the stride of their rows.
TEST(StepState, HoldsAtEqualPositionsAlone) {
  const Positions x = octahedron_positions(1);
  StepState state;
  state.keep(x);
  for (const Eigen::Index stride : {3, 4}) {
    using Rows = Eigen::Map<Positions, 0, Eigen::OuterStride<>>;
    std::vector<double> memory(6 * 4, 0);
    Rows rows(memory.data(), 6, 3, Eigen::OuterStride<>(stride));
    rows = x;
    EXPECT_TRUE(state.holds_at(rows)) << stride;
    for (Eigen::Index v = 0; v < 6; ++v) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double before = rows(v, k);
        rows(v, k) = before == 0 ? -0.0 : std::nextafter(before, 0);
        EXPECT_FALSE(state.holds_at(rows)) << stride << " " << v << " " << k;
        rows(v, k) = before;
      }
    }
  }
}

// Nobody swept the ghosts of an open component in a step without views, so it is not known to be
// clean at the end; a closed one beside it is.
TEST(StepState, L15_AfterAStepWithoutViewsOnlyClosedComponentsAreClean) {
  for (const bool closed_first : {true, false}) {
    const Triangles closed = octahedron(), open = octahedron().bottomRows(7);
    Triangles both(15, 3);
    both << (closed_first ? closed : open), (closed_first ? open : closed).array() + 6;
    const Positions one = octahedron_positions(1), x = tests::side_by_side(one, one, 9);
    auto detector = Detector::create(both, x, {Culling::view_auto, Start::clean});
    ASSERT_TRUE(detector);
    const MovingPoint far = {{90, 60, 30}, {90, 60, 30}};
    const ViewPrimitive outside = {far, far};
    const auto result = detector.value().step(x, x, {&outside, 1});
    ASSERT_TRUE(result.primitives.empty()) << "ghosts cost more than the views save";
    ASSERT_EQ(result.answer, Answer::free);
    const auto clean = detector.value().state().fields().committed->clean;
    for (std::size_t t = 0; t < 15; ++t) {
      const bool is_of_closed = closed_first ? t < 8 : t >= 7;
      EXPECT_EQ(clean[t], is_of_closed ? 1 : 0) << t;
    }
  }
}

TEST(Release, L5_ReleasesWithWindingOneOnly) {
  BareStep still(octahedron(), octahedron_positions(1));
  const auto released_from = [&](const Point& q) {
    still.marks.primitives = {{{q, q}, {q, q}}};
    return ReleaseRule().released_at_start(still.step, still.marks, still.cost, 0);
  };
  EXPECT_TRUE(released_from({0, 0, 0}));
  EXPECT_FALSE(released_from({2, 0, 0}));
}

TEST(Release, L9_FindsStaticContactsOfAStartInContact) {
  BareStep still(octahedron(), tests::pushed_octahedron());
  auto& clean = still.marks.clean;
  clean.assign(8, 2);
  ASSERT_TRUE(ReleaseRule().verify_start(still.step, still.marks, still.cost, {0}));
  // Edge (1,4) of triangles 1 and 2 pierces triangle 4.
  EXPECT_EQ(clean[1], 0);
  EXPECT_EQ(clean[2], 0);
  EXPECT_GT(std::count(clean.begin(), clean.end(), 0), 2);
}

// The state after a step: clean before, not touched, in no contact of its own component.
TEST(Release, L8_ContactsAndTouchesMakeDirty) {
  BareStep still(octahedron(), octahedron_positions(1));
  StepMarks& marks = still.marks;
  marks.clean.assign(8, 1);
  marks.clean[7] = 0;
  marks.touched.assign(8, 0);
  marks.touched[3] = 1;
  const std::vector<PairContact> pairs = {{{0, 6}, {}, {}}};
  StepState state;
  ReleaseRule().settle(still.step, marks, pairs, true, state);
  EXPECT_EQ(state.clean, (std::vector<std::uint8_t>{0, 1, 1, 0, 1, 1, 0, 0}));
  EXPECT_EQ(state.contacts, (std::vector<TrianglePair>{{0, 6}}));
  EXPECT_TRUE(state.contacts_are_complete);
  ReleaseRule().settle(still.step, marks, pairs, false, state);
  EXPECT_FALSE(state.contacts_are_complete);
  EXPECT_EQ(std::count(state.clean.begin(), state.clean.end(), 1), 0)
      << "an incomplete set vouches for none";
}

}  // namespace
}  // namespace assay::detector
