// A saved state as bytes: the same state again, and whatever is not one is refused by name.
#include <sys/resource.h>
#include <unistd.h>

#include "detector/detector.h"
#include "detector/state/step_state.h"
#include "tests/asked.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

using tests::octahedron, tests::octahedron_positions, tests::tip_at;
using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const StateFields& state) {
  Bytes bytes(state_size(state));
  write_state(state, bytes);
  return bytes;
}

// The form is stated in step_state.h; a test may make its own bytes by that.
void set_number(Bytes& bytes, std::size_t at, std::uint64_t value) {
  for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}
void seal(Bytes& bytes) {
  set_number(bytes, 16, bytes.size());
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
  set_number(bytes, bytes.size() - 8, hash);
}

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
  policy.anchors = std::make_shared<const std::vector<ViewAnchor>>(state.anchors);
  policy.anchors_are_due = true;
  policy.anchor_age = 3, policy.least_anchor_age = 32, policy.best_share = .7,
  policy.replaced_at = .3;
  policy.pause = 5, policy.next_pause = 8, policy.candidates = 1234, policy.overhead = 17.5;
  policy.credit = -3.5, policy.tried = 250, policy.has_views = true;
  state.view_work = 1e5;
  return state;
}

void expect_equal(const std::vector<ViewAnchor>& a, const std::vector<ViewAnchor>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind);
    for (int e = 0; e < 2; ++e) {
      EXPECT_EQ(a[i].ends[e].vertices, b[i].ends[e].vertices);
      EXPECT_EQ(a[i].ends[e].weights, b[i].ends[e].weights);
    }
  }
}

TEST(StateBytes, AreTheSameStateAgain) {
  const StateFields state = full_state();
  const auto read = read_state(bytes_of(state));
  ASSERT_TRUE(read) << read.error().message;
  const StateFields& again = read.value();
  EXPECT_EQ(again.mesh, state.mesh);
  EXPECT_EQ(again.culling, Culling::view_line);
  ASSERT_EQ(again.apex_rules.size(), 1u);
  EXPECT_EQ(again.apex_rules[0].height, state.apex_rules[0].height);
  expect_equal(again.anchors, state.anchors);
  ASSERT_TRUE(again.committed);
  const StepState &a = *again.committed, &b = *state.committed;
  EXPECT_TRUE(a.holds_at(b.positions));
  EXPECT_EQ(a.clean, b.clean);
  EXPECT_EQ(a.contacts, b.contacts);
  EXPECT_EQ(a.contacts_are_complete, b.contacts_are_complete);
  EXPECT_EQ(a.inside, b.inside);
  EXPECT_TRUE(std::signbit((*a.inside[0])[0][1]));
  ASSERT_TRUE(a.policy.anchors);
  expect_equal(*a.policy.anchors, *b.policy.anchors);
  const auto numbers_of = [](const PolicyState& p) {
    return std::tuple(p.anchors_are_due, p.anchor_age, p.least_anchor_age, p.best_share,
                      p.replaced_at, p.pause, p.next_pause, p.candidates, p.overhead, p.credit,
                      p.tried, p.has_views);
  };
  EXPECT_EQ(numbers_of(a.policy), numbers_of(b.policy));
  EXPECT_EQ(again.view_work, state.view_work);
  EXPECT_EQ(bytes_of(again), bytes_of(state));
}

// Whatever a detector has committed itself, it then has what was saved, also if that is nothing.
TEST(StateBytes, ReplaceWhatTheDetectorHasCommitted) {
  for (const auto culling : all_values<Culling>) {
    for (const int steps : {0, 1, 2}) {
      const auto bytes = passed(culling, steps).state().bytes();
      const auto read = read_state(bytes);
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read.value().committed.has_value(), steps > 0);
      EXPECT_EQ(bytes_of(read.value()), bytes);
      for (const int own_steps : {0, 1, 2}) {
        Detector other = passed(culling, own_steps);
        ASSERT_FALSE(other.restore(SavedState(read.value())));
        EXPECT_EQ(other.state().bytes(), bytes) << name_of(culling) << " " << own_steps;
      }
    }
  }
}

// The form is for ever: what an older build of version 3 has saved is read by a newer one.
TEST(StateBytes, HaveTheFormThatIsStated) {
  StateFields state;
  state.mesh = 0x0123456789abcdef;
  state.culling = Culling::bvh;
  state.apex_rules = {{-.25}};
  Bytes expected = {'a', 's', 's', 'a', 'y', 'S', 'A', 'V', 3, 0, 0, 0, 0, 0, 0, 0};
  expected.insert(expected.end(), {74, 0, 0, 0, 0, 0, 0, 0});                         // bytes
  expected.insert(expected.end(), {0xef, 0xcd, 0xab, 0x89, 0x67, 0x45, 0x23, 0x01});  // mesh
  expected.insert(expected.end(), {4, 0});  // bvh, no step committed
  expected.insert(expected.end(), {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xd0, 0xbf});
  expected.insert(expected.end(), {0, 0, 0, 0, 0, 0, 0, 0});  // anchors
  expected.insert(expected.end(), {0, 0, 0, 0, 0, 0, 0, 0});  // their work
  expected.resize(expected.size() + 8);
  seal(expected);
  EXPECT_EQ(bytes_of(state), expected);
}

TEST(StateBytes, DamageIsRefused) {
  const Bytes whole = bytes_of(full_state());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const std::uint8_t bit : {1, 128}) {
      Bytes changed = whole;
      changed[i] ^= bit;
      const auto read = read_state(changed);
      ASSERT_FALSE(read) << "byte " << i;
      const bool version = i >= 8 && i < 16;
      EXPECT_EQ(read.error().error,
                version ? InputError::other_state_version : InputError::damaged_state)
          << "byte " << i;
    }
    const auto cut = read_state(std::span(whole).first(i));
    ASSERT_FALSE(cut) << i << " bytes";
    EXPECT_EQ(cut.error().error, InputError::damaged_state);
  }
  Bytes longer = whole;
  longer.push_back(0);
  EXPECT_FALSE(read_state(longer));
  EXPECT_FALSE(read_state({}));
}

// A right checksum over wrong fields: read as far as they make sense, never beyond the bytes, and
// refused by the reading or by the mesh.
TEST(StateBytes, WrongFieldsUnderARightChecksumAreRefused) {
  Detector detector = passed(Culling::view_line);
  const Bytes whole = bytes_of(full_state()), before = detector.state().bytes();
  std::size_t refused = 0, read_back = 0;
  for (std::size_t i = 24; i + 8 < whole.size(); ++i) {
    for (const std::uint8_t value : {0, 1, 2, 127, 255}) {
      Bytes changed = whole;
      changed[i] = value;
      seal(changed);
      auto read = read_state(changed);
      if (!read) {
        EXPECT_EQ(read.error().error, InputError::damaged_state);
        ++refused;
      } else if (const auto problem = detector.restore(SavedState(read.value()))) {
        EXPECT_TRUE(problem->error == InputError::damaged_state ||
                    problem->error == InputError::foreign_state);
        EXPECT_EQ(detector.state().bytes(), before) << "nothing has changed";
        ++refused;
      } else {
        // Another state that a detector of this mesh may have: it is in use without harm.
        ++read_back;
        EXPECT_EQ(detector.step(octahedron_positions(2), tip_at(1)).answer, Answer::free);
        ASSERT_FALSE(detector.restore(SavedState::read(before).value()));
      }
    }
  }
  EXPECT_GT(refused, 100u);
  EXPECT_GT(read_back, 100u);
  for (const std::uint64_t count : {std::uint64_t{8}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    Bytes changed = whole;
    set_number(changed, 34, count);  // the number of positions
    seal(changed);
    EXPECT_FALSE(read_state(changed));
  }
  // A version of before, and one to come.
  for (const std::uint8_t version : {2, 4}) {
    Bytes other = whole;
    other[8] = version;
    seal(other);
    EXPECT_EQ(read_state(other).error().error, InputError::other_state_version);
  }
}

// By component there may be a view primitive or none, in any order.
TEST(StateBytes, WhatIsKnownOfComponentsMayHaveGaps) {
  StateFields state = full_state();
  auto& inside = state.committed->inside;
  inside = {std::nullopt, inside[0], std::nullopt, inside[0]};
  const Bytes bytes = bytes_of(state);
  const auto read = read_state(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read.value().committed->inside, inside);
  EXPECT_EQ(bytes_of(read.value()), bytes);
}

// Sanitizers need address space of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// The number of positions that the bytes claim would take 24 times the memory of the bytes.
TEST(StateBytes, AClaimedLengthTakesNoMemory) {
  constexpr std::size_t size = std::size_t{64} << 20;
  Bytes bytes = bytes_of(full_state());
  bytes.resize(size);
  set_number(bytes, 34, size / 2);
  seal(bytes);
  const auto read_in_little_memory = [&] {
    rlimit limit = {};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = std::min<rlim_t>(2 * size + (std::size_t{256} << 20), limit.rlim_max);
    _exit(setrlimit(RLIMIT_AS, &limit) == 0 && !read_state(bytes) ? 0 : 1);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(read_in_little_memory(), testing::ExitedWithCode(0), "");
}
#endif

// What does not fit the mesh although its sizes are right.
TEST(StateBytes, WhatContradictsTheMeshIsRefused) {
  Detector detector = passed(Culling::view_line);
  const StateFields right = full_state();
  ASSERT_FALSE(detector.restore(SavedState(right)));
  const auto expect_damaged = [&](const char* damage, auto change) {
    StateFields wrong = right;
    change(wrong);
    const auto problem = detector.restore(SavedState(wrong));
    ASSERT_TRUE(problem) << damage;
    EXPECT_EQ(problem->error, InputError::damaged_state) << damage;
    EXPECT_EQ(detector.state().bytes(), bytes_of(right)) << damage;
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
    s.committed->policy.anchors = std::make_shared<const std::vector<ViewAnchor>>();
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

// Saved, through bytes and back, into the same detector and a new one; and both go on alike.
void expect_taken_back(Detector& detector, const ScaledMesh& mesh, Culling culling,
                       const Positions& x, const Positions& next) {
  const SavedState saved = detector.state();
  const auto read = SavedState::read(saved.bytes());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const auto refused = detector.restore(read.value());
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
    for (int exponent = -1076; exponent <= 1023;
         exponent += exponent < -1060 ? 1 : tests::spaced(59)) {
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
