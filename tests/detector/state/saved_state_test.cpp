// A saved state as a value: two states are equal only if all parts are equal, a state of another
// mesh is refused, and a state can be restored at any scale of the mesh.
#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/asked.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::tip_at;

// An octahedron with a hole whose tip has gone through it: some triangles are dirty.
Detector passed(Culling culling, int steps = 2) {
  const Positions in = octahedron_positions(2), out = tip_at(1.5);
  auto result = Detector::create(octahedron().bottomRows(7), in, {culling});
  for (int s = 0; s < steps; ++s) result.value().step(s % 2 ? out : in, s % 2 ? in : out);
  return std::move(result.value());
}

// Every field, the optional ones present.
StateFields full_state() {
  StateFields state = passed(Culling::view_line).state().fields();
  state.committed->contacts = {{0, 3}, {2, 5}};
  state.committed->contacts_are_complete = false;
  state.committed->inside[0] = {{{1, -0.0, 0x1p-1074}, {-2, .1, 4}}};
  auto& policy = state.committed->policy;
  policy.anchors = {std::make_shared<const std::vector<ViewAnchor>>(state.anchors)};
  policy.anchors_are_due = true;
  policy.anchor_age = 3, policy.least_anchor_age = 32, policy.best_share = .7,
  policy.replaced_at = .3;
  policy.pause = 5, policy.next_pause = 8, policy.candidates = 1234, policy.overhead = 17.5;
  policy.credit = -3.5, policy.tried = 250, policy.has_views = true;
  state.view_work = 1e5;
  return state;
}

TEST(SavedState, IsEqualOnlyIfAllOfItIs) {
  const StateFields state = full_state();
  StateFields same = state;
  auto& held = same.committed->policy.anchors.list;
  held = std::make_shared<const std::vector<ViewAnchor>>(*held);
  EXPECT_EQ(SavedState(same), SavedState(state)) << "anchors may stand elsewhere";
  const auto expect_other = [&](const char* change, const auto& make) {
    StateFields other = state;
    make(other);
    EXPECT_NE(SavedState(other), SavedState(state)) << change;
    EXPECT_NE(SavedState(state), SavedState(other)) << change;
  };
  const auto chosen = [](StateFields& s, const auto& change) {
    auto anchors = *s.committed->policy.anchors.list;
    change(anchors);
    s.committed->policy.anchors = {
        std::make_shared<const std::vector<ViewAnchor>>(std::move(anchors))};
  };
  expect_other("mesh", [](auto& s) { ++s.mesh; });
  expect_other("culling", [](auto& s) { s.culling = Culling::view_point; });
  expect_other("nothing committed", [](auto& s) { s.committed.reset(); });
  expect_other("height", [](auto& s) { s.apex_rules[0].height += 1; });
  expect_other("rules", [](auto& s) { s.apex_rules.pop_back(); });
  expect_other("kind", [](auto& s) { s.anchors[0].kind = ViewKind::point; });
  expect_other("vertex", [](auto& s) { ++s.anchors[0].ends[1].vertices.back(); });
  expect_other("weight", [](auto& s) { s.anchors[0].ends[1].weights.back() += 1; });
  expect_other("view work", [](auto& s) { s.view_work += 1; });
  expect_other("place", [](auto& s) { s.committed->positions(5, 2) += 1; });
  expect_other("sign of 0", [](auto& s) {
    double& zero = s.committed->positions(0, 1);
    ASSERT_EQ(zero, 0);
    zero = -zero;
  });
  expect_other("places", [](auto& s) { s.committed->positions.conservativeResize(5, 3); });
  expect_other("clean", [](auto& s) { s.committed->clean.back() ^= 1; });
  expect_other("contact", [](auto& s) { --s.committed->contacts[1].b; });
  expect_other("completeness", [](auto& s) { s.committed->contacts_are_complete = true; });
  expect_other("not known inside", [](auto& s) { s.committed->inside[0].reset(); });
  expect_other("inside", [](auto& s) { (*s.committed->inside[0])[1][2] += 1; });
  expect_other("no anchors", [](auto& s) { s.committed->policy.anchors = {}; });
  expect_other("anchors", [&](auto& s) { chosen(s, [](auto& list) { list.clear(); }); });
  expect_other("anchor",
               [&](auto& s) { chosen(s, [](auto& list) { list[0].ends[0].weights[0] += 1; }); });
  expect_other("due", [](auto& s) { s.committed->policy.anchors_are_due = false; });
  expect_other("age", [](auto& s) { ++s.committed->policy.anchor_age; });
  expect_other("least age", [](auto& s) { ++s.committed->policy.least_anchor_age; });
  expect_other("best share", [](auto& s) { s.committed->policy.best_share += 1; });
  expect_other("replaced at", [](auto& s) { s.committed->policy.replaced_at += 1; });
  expect_other("pause", [](auto& s) { ++s.committed->policy.pause; });
  expect_other("next pause", [](auto& s) { ++s.committed->policy.next_pause; });
  expect_other("candidates", [](auto& s) { ++s.committed->policy.candidates; });
  expect_other("overhead", [](auto& s) { s.committed->policy.overhead += 1; });
  expect_other("credit", [](auto& s) { s.committed->policy.credit += 1; });
  expect_other("tried", [](auto& s) { s.committed->policy.tried += 1; });
  expect_other("views", [](auto& s) { s.committed->policy.has_views = false; });
}

// Whatever a detector has committed itself, it then has what was saved, also if that is nothing.
TEST(SavedState, ReplacesWhatTheDetectorHasCommitted) {
  for (const auto culling : all_values<Culling>) {
    for (const int steps : {0, 1, 2}) {
      const SavedState saved = passed(culling, steps).state();
      EXPECT_EQ(saved.fields().committed.has_value(), steps > 0);
      for (const int own_steps : {0, 1, 2}) {
        Detector other = passed(culling, own_steps);
        ASSERT_FALSE(other.restore(saved));
        EXPECT_EQ(other.state(), saved) << name_of(culling) << " " << own_steps;
      }
    }
  }
}

TEST(SavedState, DropsAnEvaluationUnlessItIsRefused) {
  const Positions in = octahedron_positions(2), near = tip_at(1);
  Detector detector = passed(Culling::view_point), line = passed(Culling::view_line);
  const SavedState saved = detector.state();
  detector.evaluate(in, near);
  EXPECT_EQ(detector.restore(line.state())->error, InputError::foreign_state);
  EXPECT_EQ(detector.state(), saved);
  EXPECT_FALSE(detector.commit()) << "a refused state leaves the evaluation";
  EXPECT_NE(detector.state(), saved);
  detector.evaluate(near, in);
  ASSERT_FALSE(detector.restore(saved));
  EXPECT_EQ(detector.commit()->error, InputError::nothing_to_commit);
  EXPECT_EQ(detector.state(), saved);
}

// What does not fit the mesh although its sizes are right.
TEST(SavedState, ThatContradictsTheMeshIsRefused) {
  Detector detector = passed(Culling::view_line);
  const StateFields right = full_state();
  ASSERT_FALSE(detector.restore(SavedState(right)));
  const auto expect_damaged = [&](const char* damage, auto change) {
    StateFields wrong = right;
    change(wrong);
    const auto problem = detector.restore(SavedState(wrong));
    ASSERT_TRUE(problem) << damage;
    EXPECT_EQ(problem->error, InputError::damaged_state) << damage;
    EXPECT_EQ(detector.state(), SavedState(right)) << damage;
  };
  const double nan = std::nan("");
  expect_damaged("positions", [](auto& s) { s.committed->positions.conservativeResize(5, 3); });
  expect_damaged("a position", [&](auto& s) { s.committed->positions(2, 1) = nan; });
  expect_damaged("clean", [](auto& s) { s.committed->clean.pop_back(); });
  expect_damaged("inside", [](auto& s) { s.committed->inside.clear(); });
  expect_damaged("a pair below", [](auto& s) { s.committed->contacts[0].a = -1; });
  expect_damaged("a pair above", [](auto& s) { s.committed->contacts[1].b = 7; });
  expect_damaged("a pair turned", [](auto& s) { s.committed->contacts[1] = {5, 2}; });
  expect_damaged("an apex", [&](auto& s) { s.apex_rules[0].height = nan; });
  expect_damaged("a vertex", [](auto& s) { s.anchors[0].ends[1].vertices[0] = 6; });
  expect_damaged("a weight", [&](auto& s) { s.anchors[0].ends[0].weights[0] = nan; });
  expect_damaged("weights", [](auto& s) { s.anchors[0].ends[0].weights.pop_back(); });
  expect_damaged("chosen anchors", [](auto& s) {
    s.committed->policy.anchors = {std::make_shared<const std::vector<ViewAnchor>>()};
  });
}

// A saved state is always taken back by the detector that saved it, whatever numbers it has seen:
// all scales, with extents of a few denormals and coordinates at the end of the doubles.

struct ScaledMesh {
  const char* name;
  Triangles triangles;
  Positions x;  // of size about 1
};

std::vector<ScaledMesh> scaled_meshes() {
  const Positions ball = octahedron_positions(1);
  Positions flat = ball, needle = ball, irregular = ball;
  flat.col(2).setZero();
  needle.rightCols(2) *= 0x1p-40;
  irregular.row(0) << .9, .3, -.2;
  irregular.row(3) << .1, -.7, .6;
  return {{"closed", octahedron(), ball},
          {"irregular", octahedron(), irregular},
          {"open", octahedron().topRows(7), irregular},
          {"one triangle", octahedron().topRows(1), ball},
          {"flat", octahedron(), flat},
          {"needle", octahedron().topRows(6), needle}};
}

// Saved, and restored into the same detector and a new one; and both go on alike.
void expect_taken_back(Detector& detector, const ScaledMesh& mesh, Culling culling,
                       const Positions& x, const Positions& next) {
  const SavedState saved = detector.state();
  const auto refused = detector.restore(saved);
  ASSERT_FALSE(refused.has_value()) << refused->message;
  auto result = Detector::create(mesh.triangles, x, {culling});
  ASSERT_TRUE(result.has_value());
  Detector& other = result.value();
  const auto refused_by_other = other.restore(saved);
  ASSERT_FALSE(refused_by_other.has_value()) << refused_by_other->message;
  const StepResult a = detector.evaluate(x, next), b = other.evaluate(x, next);
  EXPECT_EQ(a.answer, b.answer);
  EXPECT_EQ(a.pairs.size(), b.pairs.size());
}

void expect_states_at(const ScaledMesh& mesh, const Positions& x, const Positions& next) {
  for (const auto culling : all_values<Culling>) {
    auto result = Detector::create(mesh.triangles, x, {culling});
    ASSERT_TRUE(result.has_value());
    expect_taken_back(result.value(), mesh, culling, x, next);
    if (testing::Test::HasFatalFailure()) return;
    ASSERT_NE(result.value().step(x, next).answer, Answer::error);
    expect_taken_back(result.value(), mesh, culling, next, x);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(SavedStateScales, AreTakenBackAtAllScales) {
  for (const auto& mesh : scaled_meshes()) {
    for (int exponent = -1076; exponent <= 1023; exponent += exponent < -1060 ? 1 : 59) {
      Positions x = mesh.x, next = mesh.x.rowwise().reverse();
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        x.data()[i] = std::ldexp(x.data()[i], exponent);
        next.data()[i] = std::ldexp(next.data()[i], exponent);
      }
      expect_states_at(mesh, x, next);
      ASSERT_FALSE(HasFailure()) << mesh.name << " at 2^" << exponent;
    }
  }
}

// A few denormals wide in some directions, and far out or at the end of the doubles in others.
TEST(SavedStateScales, AreTakenBackForAnyExtents) {
  std::mt19937_64 engine(20119);
  const auto below = [&engine](int n) { return static_cast<int>(engine() % std::uint64_t(n)); };
  const double places[] = {0, 0, 1, -0x1p-1022, 0x1p1023, -1.7e308};
  constexpr double unit = 0x1p-1074;
  for (int round = 0; round < tests::usual(10); ++round) {
    for (const auto& mesh : scaled_meshes()) {
      Positions x = mesh.x, next = mesh.x;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double place = places[below(6)];
        const double step = below(3) == 0 ? std::ldexp(1, below(2097) - 1074) : unit;
        for (Positions* p : {&x, &next}) {
          for (Eigen::Index v = 0; v < x.rows(); ++v) {
            const double c = place + (below(5) - 2) * step;
            (*p)(v, k) = std::isfinite(c) ? c : place;
          }
        }
      }
      expect_states_at(mesh, x, next);
      ASSERT_FALSE(HasFailure()) << mesh.name << ", round " << round;
    }
  }
}

// The component whose half extent is one denormal: half of that is 0.
TEST(SavedStateScales, HalfExtentOfOneDenormal) {
  constexpr double d = 0x1p-1074;
  const Triangles tetrahedron = tests::triangles_of("0 1 2, 0 2 3, 0 3 1, 1 3 2");
  const Positions x =
      tests::positions({{2 * d, -d, d}, {2 * d, 0, -2 * d}, {0, d, -d}, {0, -d, -2 * d}});
  expect_states_at({"tetrahedron", tetrahedron, x}, x, x);
}

}  // namespace
}  // namespace assay::detector
