// A saved state is always taken back by the detector that saved it, whatever numbers it has seen:
// all scales, with extents of a few denormals and coordinates at the end of the doubles.
#include "detector/detector.h"
#include "tests/detector/points.h"

namespace assay::detector {
namespace {

struct ScaledMesh {
  const char* name;
  Triangles triangles;
  Positions x;  // of size about 1
};

std::vector<ScaledMesh> scaled_meshes() {
  const Positions ball = tests::octahedron_positions(1);
  Positions flat = ball, needle = ball, irregular = ball;
  flat.col(2).setZero();
  needle.rightCols(2) *= 0x1p-40;
  irregular.row(0) << .9, .3, -.2;
  irregular.row(3) << .1, -.7, .6;
  return {{"closed", tests::octahedron(), ball},
          {"irregular", tests::octahedron(), irregular},
          {"open", tests::octahedron().topRows(7), irregular},
          {"one triangle", tests::octahedron().topRows(1), ball},
          {"flat", tests::octahedron(), flat},
          {"needle", tests::octahedron().topRows(6), needle}};
}

// Saved, through bytes and back, into the same detector and a new one; and both go on alike.
void expect_taken_back(Detector& detector, const ScaledMesh& mesh, Culling culling,
                       const Positions& x, const Positions& next) {
  const SavedState saved = detector.state();
  const auto read = SavedState::read(saved.bytes());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const auto refused = detector.restore(read.value());
  ASSERT_FALSE(refused.has_value()) << refused->message;
  auto made = Detector::create(mesh.triangles, x, {culling});
  ASSERT_TRUE(made.has_value());
  Detector& other = made.value();
  const auto refused_by_other = other.restore(saved);
  ASSERT_FALSE(refused_by_other.has_value()) << refused_by_other->message;
  const StepResult a = detector.evaluate(x, next), b = other.evaluate(x, next);
  EXPECT_EQ(a.answer, b.answer);
  EXPECT_EQ(a.pairs.size(), b.pairs.size());
}

void expect_states_at(const ScaledMesh& mesh, const Positions& x, const Positions& next) {
  for (const auto culling : all_values<Culling>) {
    auto made = Detector::create(mesh.triangles, x, {culling});
    ASSERT_TRUE(made.has_value());
    expect_taken_back(made.value(), mesh, culling, x, next);
    if (testing::Test::HasFatalFailure()) return;
    ASSERT_NE(made.value().step(x, next).answer, Answer::error);
    expect_taken_back(made.value(), mesh, culling, next, x);
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
  for (int round = 0; round < 10; ++round) {
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
  const Triangles tetrahedron = tests::triangles({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
  const Positions x =
      tests::positions({{2 * d, -d, d}, {2 * d, 0, -2 * d}, {0, d, -d}, {0, -d, -2 * d}});
  expect_states_at({"tetrahedron", tetrahedron, x}, x, x);
}

}  // namespace
}  // namespace assay::detector
