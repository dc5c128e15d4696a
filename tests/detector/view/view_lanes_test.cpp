// View signs in lanes, compared with the signs of single triangles, and the instruction sets
// compared with each other.
#include "detector/view/view_lanes.h"

#include <algorithm>
#include <numbers>

#include "detector/view/view_signs.h"
#include "tests/asked.h"
#include "tests/detector/exact/exact_numbers.h"
#include "tests/detector/view/triangle_batches.h"
#include "tests/test.h"

#define ASSAY_LANES 2
#include "detector/view/view_lanes_kernel.h"

namespace assay::detector {
namespace {

using tests::BatchFamily, tests::BatchMaker, tests::TriangleBatch;

constexpr std::array<InstructionSet, 3> all_sets = {InstructionSet::baseline, InstructionSet::avx2,
                                                    InstructionSet::avx512};

struct Found {
  std::vector<ViewSign> signs;
  ViewCounts counts;
  friend bool operator==(const Found& a, const Found& b) {
    return a.signs == b.signs && a.counts.lanes == b.counts.lanes &&
           a.counts.filter == b.counts.filter && a.counts.exact == b.counts.exact;
  }
};

Found find(const TriangleBatch& batch, InstructionSet set,
           Arithmetic arithmetic = Arithmetic::exact) {
  Found found;
  found.signs.resize(batch.mesh.triangles.size());
  classify(batch.mesh, batch.mesh.components[0], {batch.x_t0, batch.x_t1}, batch.primitive,
           found.signs, found.counts, set, arithmetic);
  return found;
}

// Families in which the integers decide much are slow, lines above all: fewer of them.
int batches_of(BatchFamily family, bool line) {
  switch (family) {
    case BatchFamily::small_motion:
      return 10000;
    case BatchFamily::generic:
    case BatchFamily::far:
      return line ? 200 : 4000;
    case BatchFamily::mixed_scales:
      return line ? 10 : 400;
    case BatchFamily::near_degenerate:
    case BatchFamily::degenerate:
      return line ? 10 : 60;
    default:
      return line ? 1 : 4;
  }
}

void compare(bool line) {
  BatchMaker maker(line ? 20112 : 20111);
  for (std::size_t f = 0; f < tests::batch_family_names.size(); ++f) {
    const auto family = static_cast<BatchFamily>(f);
    std::uint64_t zeros = 0;
    for (int b = 0; b < std::max(1, tests::usual(batches_of(family, line))); ++b) {
      // All lengths of the last group of lanes.
      const TriangleBatch batch = maker.make(family, 93 + static_cast<std::size_t>(b % 8), line);
      const Found first = find(batch, InstructionSet::baseline);
      ViewCounts alone;
      for (std::size_t t = 0; t < first.signs.size(); ++t) {
        ASSERT_EQ(first.signs[t], view_sign(batch.triangle(t), batch.primitive, alone))
            << tests::batch_family_names[f] << ", batch " << b << ", triangle " << t;
        zeros += first.signs[t] == ViewSign::zero;
      }
      for (const auto set : all_sets) {
        if (!is_available(set)) continue;
        ASSERT_TRUE(find(batch, set) == first) << "instruction set " << static_cast<int>(set);
      }
    }
    EXPECT_GT(zeros, 0u) << tests::batch_family_names[f];
  }
}

TEST(ViewLanes, L2_PointSignsAreThoseOfOneTriangleAlone) { compare(false); }
TEST(ViewLanes, L1_LineSignsAreThoseOfOneTriangleAlone) { compare(true); }

TEST(ViewLanes, TheBaselineIsThereAndTheBestIsAvailable) {
  EXPECT_TRUE(is_available(InstructionSet::baseline));
  EXPECT_TRUE(is_available(best_instruction_set()));
  for (const auto set : all_sets) {
    EXPECT_FALSE(is_available(set) && set > best_instruction_set());
    if (!is_available(set)) continue;
    EXPECT_EQ(lane_kernels(set).lanes, std::size_t{2} << static_cast<int>(set));
    for (const auto other : all_sets) {
      if (set == other || !is_available(other)) continue;
      EXPECT_NE(lane_kernels(set).point, lane_kernels(other).point) << "each has its own";
    }
  }
}

template <class Change>
TriangleBatch changed(TriangleBatch batch, Change change) {
  for (auto* x : {&batch.x_t0, &batch.x_t1}) *x = x->unaryExpr(change);
  for (auto* q : {&batch.primitive.q0, &batch.primitive.q1}) {
    for (std::size_t k = 0; k < 3; ++k) q->t0[k] = change(q->t0[k]), q->t1[k] = change(q->t1[k]);
  }
  return batch;
}

// A power of two changes no rounding, so no rung settles more or less.
TEST(ViewLanes, PowersOfTwoChangeNothing) {
  BatchMaker maker(6);
  int batches = 0;
  for (const auto family : {BatchFamily::generic, BatchFamily::small_motion,
                            BatchFamily::near_degenerate, BatchFamily::degenerate}) {
    for (int b = 0; b < 40; ++b, ++batches) {
      const TriangleBatch batch =
          changed(maker.make(family, 96, b % 4 != 0),  // denormals would lose bits
                  [](double c) { return std::abs(c) < 0x1p-1000 ? 0 : c; });
      for (const auto arithmetic :
           {Arithmetic::exact, Arithmetic::bounded, Arithmetic::double_precision}) {
        const Found found = find(batch, best_instruction_set(), arithmetic);
        for (const double scale : {0x1p-20, 0x1p20}) {
          const TriangleBatch scaled = changed(batch, [=](double c) { return scale * c; });
          const Found other = find(scaled, best_instruction_set(), arithmetic);
          ASSERT_TRUE(other == found) << "batch " << batches;
        }
      }
    }
  }
}

TEST(ViewLanes, RowsMayHaveAnyStride) {
  BatchMaker maker(5);
  TriangleBatch batch = maker.make(BatchFamily::generic, 101, true);
  const Found packed = find(batch, best_instruction_set());
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> wide(batch.x_t0.rows(), 7);
  wide.setConstant(std::nan(""));
  wide.leftCols<3>() = batch.x_t0;
  Found found;
  found.signs.resize(packed.signs.size());
  classify(batch.mesh, batch.mesh.components[0], {wide.leftCols<3>(), batch.x_t1}, batch.primitive,
           found.signs, found.counts);
  EXPECT_TRUE(found == packed);
}

// The bounds of the lanes hold: what a lane computes against the same in exact numbers, in units of
// the scales of the component's box. Prints the largest error beside what is allowed.

constexpr std::array families = {BatchFamily::generic, BatchFamily::small_motion,
                                 BatchFamily::near_degenerate, BatchFamily::far,
                                 BatchFamily::mixed_scales};

// Coefficients of (p0-q).N, the middle ones times 3, as the lanes have them.
std::array<Exact, 4> exact_cubic(const std::array<MovingPoint, 3>& p, const MovingPoint& q) {
  const MovingExact e1 = exact_difference(p[1], p[0]), e2 = exact_difference(p[2], p[0]),
                    w = exact_difference(p[0], q);
  const ExactVector n0 = cross(e1.t0, e2.t0), n2 = cross(e1.t1, e2.t1);
  const ExactVector n1_twice = cross(e1.t0, e2.t1) + cross(e1.t1, e2.t0);
  return {dot(w.t0, n0), dot(w.t0, n1_twice) + dot(w.t1, n0), dot(w.t0, n2) + dot(w.t1, n1_twice),
          dot(w.t1, n2)};
}

// An error in parts of what is allowed.
double part_of(double allowed, double off) { return off == 0 ? 0 : off / allowed; }
double part_of(double allowed, double computed, const Exact& exact) {
  return part_of(allowed, magnitude(Exact(computed) - exact));
}

Exact value(const Exact& b0, const Exact& b1, double s) { return b0 + Exact(s) * (b1 - b0); }

LaneInput input_of(const TriangleBatch& batch) {
  LaneInput in{};
  EXPECT_TRUE(make_lane_input(batch.mesh.components[0].vertices, {batch.x_t0, batch.x_t1},
                              batch.primitive, in));
  return in;
}

TEST(ViewBounds, L2_CubicsAndValuesOfLanes) {
  BatchMaker maker(20113);
  std::mt19937_64 engine(3);
  double worst_cubic = 0, worst_value = 0;
  for (int n = 0; n < 2000; ++n) {
    const TriangleBatch batch =
        maker.make(families[static_cast<std::size_t>(n) % families.size()], 8, true);
    LaneInput in = input_of(batch);
    in.corners = batch.mesh.triangles[0].data();
    for (std::int32_t t = 0; t < 8; t += 2) {
      const std::int32_t two[2] = {t, t + 1};
      view_kernel::LaneLine line;
      view_kernel::cubics(line, in, two);
      for (std::size_t lane = 0; lane < 2; ++lane) {
        const auto triangle = batch.triangle(static_cast<std::size_t>(two[lane]));
        const auto h0 = exact_cubic(triangle, batch.primitive.q0);
        const auto h1 = exact_cubic(triangle, batch.primitive.q1);
        const auto in_lane = [&](const auto& h) {
          return std::array<double, 4>{h.b0[lane], h.b1[lane], h.b2[lane], h.b3[lane]};
        };
        const auto c0 = in_lane(line.h0), c1 = in_lane(line.h1);
        for (std::size_t j = 0; j < 4; ++j) {
          worst_cubic = std::max({worst_cubic, part_of(in.cubic_error, c0[j], h0[j]),
                                  part_of(in.cubic_error, c1[j], h1[j])});
          // As in middle_group, at a given s.
          const double s = static_cast<double>(engine() >> 11) * 0x1p-53;
          const double v = c0[j] + s * (c1[j] - c0[j]);
          worst_value = std::max(worst_value, part_of(in.value_error, v, value(h0[j], h1[j], s)));
        }
      }
    }
  }
  std::printf("worst error in parts of what is allowed: cubic %.3f, value %.3f\n", worst_cubic,
              worst_value);
  EXPECT_LT(worst_cubic, 1);
  EXPECT_LT(worst_value, 1);
  EXPECT_GT(worst_cubic, 0.01) << "errors were there to be seen";
  EXPECT_GT(worst_value, 0.01);
}

TEST(ViewBounds, L1_RatiosOfCoefficientsOfLanes) {
  BatchMaker maker(20114);
  double worst = 0;
  int measured = 0;
  for (int n = 0; n < 4000; ++n) {
    const TriangleBatch batch =
        maker.make(families[static_cast<std::size_t>(n) % families.size()], 4, true);
    const LaneInput in = input_of(batch);
    if (in.axial_error >= 2) continue;  // s may be anything
    const MovingExact d = exact_difference(batch.primitive.q1, batch.primitive.q0);
    const Exact length2[3] = {dot(d.t0, d.t0), dot(d.t0, d.t1) + dot(d.t1, d.t0), dot(d.t1, d.t1)};
    for (const auto v : batch.mesh.components[0].vertices) {
      const MovingPoint p = SteppedMesh{batch.x_t0, batch.x_t1}.path(v);
      const MovingExact w = exact_difference(p, batch.primitive.q0);
      const Exact along[3] = {dot(w.t0, d.t0), dot(w.t0, d.t1) + dot(w.t1, d.t0), dot(w.t1, d.t1)};
      // As in middle_group.
      const MovingVector c = difference(p, batch.primitive.q0);
      const Vector d0 = {in.d_t0[0], in.d_t0[1], in.d_t0[2]},
                   d1 = {in.d_t1[0], in.d_t1[1], in.d_t1[2]};
      const double s[3] = {
          detector::dot(c.t0, d0) * in.length2_reciprocals[0],
          (detector::dot(c.t0, d1) + detector::dot(c.t1, d0)) * in.length2_reciprocals[1],
          detector::dot(c.t1, d1) * in.length2_reciprocals[2]};
      for (std::size_t j = 0; j < 3; ++j) {
        // |s - along / length2| = |s length2 - along| / length2
        const double off = magnitude(Exact(s[j]) * length2[j] - along[j]) / magnitude(length2[j]);
        worst = std::max(worst, part_of(in.axial_error, off));
        ++measured;
      }
    }
  }
  std::printf("%d ratios, worst error in parts of what is allowed: %.3f\n", measured, worst);
  EXPECT_GT(measured, 10000);
  EXPECT_LT(worst, 1);
  EXPECT_GT(worst, 0.01) << "errors were there to be seen";
}

TEST(ViewBounds, OutOfRangeIsRefused) {
  BatchMaker maker(7);
  TriangleBatch batch = maker.make(BatchFamily::generic, 4, false);
  LaneInput in = input_of(batch);
  const auto& vertices = batch.mesh.components[0].vertices;
  batch.x_t1(2, 1) = 0x1p305;
  EXPECT_FALSE(make_lane_input(vertices, {batch.x_t0, batch.x_t1}, batch.primitive, in));
  batch.x_t0 *= 0x1p-320;
  batch.x_t1 = batch.x_t0;
  batch.primitive = {};
  EXPECT_FALSE(make_lane_input(vertices, {batch.x_t0, batch.x_t1}, batch.primitive, in));
}

// The middle coefficient of |d|^2 is d0.d1. Where that is not positive the range of s has no bound,
// however long the line is at both ends.
TEST(ViewBounds, L1_LinesThatTurnHaveAnyAxialCoordinate) {
  BatchMaker maker(8);
  TriangleBatch batch = maker.make(BatchFamily::generic, 4, true);
  const auto axial_error = [&](const Point& d0, const Point& d1) {
    batch.primitive = {{{0, 0, 0}, {0, 0, 0}}, {d0, d1}};
    return input_of(batch).axial_error;
  };
  EXPECT_EQ(axial_error({1, 0, 0}, {-1, 0, 0}), 2);
  EXPECT_EQ(axial_error({1, 0, 0}, {0, 1, 0}), 2) << "a right angle";
  for (int degrees = 91; degrees <= 180; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    EXPECT_EQ(axial_error({1, 0, 0}, {std::cos(angle), std::sin(angle), 0}), 2) << degrees;
    EXPECT_EQ(axial_error({0, 3, 0}, {0, std::cos(angle), std::sin(angle)}), 2) << degrees;
  }
  // One that turns by less has a bound, which grows without limit towards the right angle.
  double before = 0;
  for (int degrees = 0; degrees < 90; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double error = axial_error({1, 0, 0}, {std::cos(angle), std::sin(angle), 0});
    EXPECT_LT(error, 1e-6) << degrees;
    EXPECT_TRUE(degrees <= 60 || error > before) << degrees << ": d0.d1 is less than it was";
    before = error;
  }
}

}  // namespace
}  // namespace assay::detector
