// Lanes against one triangle after the other, and each instruction set against the others.
#include "detector/view/view_lanes.h"

#include "detector/view/view_signs.h"
#include "tests/detector/view/triangle_batches.h"
#include "tests/test.h"

namespace assay::detector {
namespace {

using tests::BatchFamily, tests::BatchMaker, tests::TriangleBatch;

constexpr std::array<InstructionSet, 3> all_sets = {InstructionSet::baseline, InstructionSet::avx2,
                                                    InstructionSet::avx512};

struct Found {
  std::vector<ViewSign> signs;
  ViewCounts counts;
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
    std::uint64_t triangles = 0, in_lanes = 0, signs[3] = {0, 0, 0};
    for (int b = 0; b < batches_of(family, line); ++b) {
      // All lengths of the last group of lanes.
      const TriangleBatch batch = maker.make(family, 93 + static_cast<std::size_t>(b % 8), line);
      const Found first = find(batch, InstructionSet::baseline);
      ViewCounts alone;
      for (std::size_t t = 0; t < first.signs.size(); ++t) {
        ASSERT_EQ(first.signs[t], view_sign(batch.triangle(t), batch.primitive, alone))
            << tests::batch_family_names[f] << ", batch " << b << ", triangle " << t;
        ++signs[static_cast<int>(first.signs[t]) + 1];
      }
      for (const auto set : all_sets) {
        if (!is_available(set)) continue;
        const Found other = find(batch, set);
        ASSERT_EQ(other.signs, first.signs) << "instruction set " << static_cast<int>(set);
        ASSERT_EQ(other.counts.lanes, first.counts.lanes);
        ASSERT_EQ(other.counts.filter, first.counts.filter);
        ASSERT_EQ(other.counts.exact, first.counts.exact);
      }
      triangles += first.signs.size();
      in_lanes += first.counts.lanes;
    }
    std::printf("%-16s %7llu triangles, settled in lanes %.3f; negative %.3f, zero %.3f\n",
                tests::batch_family_names[f], static_cast<unsigned long long>(triangles),
                static_cast<double>(in_lanes) / static_cast<double>(triangles),
                static_cast<double>(signs[0]) / static_cast<double>(triangles),
                static_cast<double>(signs[1]) / static_cast<double>(triangles));
    EXPECT_GT(signs[1], 0u);
  }
}

TEST(ViewLanes, L2_PointSignsAreThoseOfOneTriangleAlone) { compare(false); }
TEST(ViewLanes, L1_LineSignsAreThoseOfOneTriangleAlone) { compare(true); }

TEST(ViewLanes, TheBaselineIsThereAndTheBestIsAvailable) {
  EXPECT_TRUE(is_available(InstructionSet::baseline));
  EXPECT_TRUE(is_available(best_instruction_set()));
  for (const auto set : all_sets) {
    if (is_available(set)) std::printf("instruction set %d is here\n", static_cast<int>(set));
    EXPECT_FALSE(is_available(set) && set > best_instruction_set());
    if (is_available(set)) {
      EXPECT_EQ(lane_kernels(set).lanes, std::size_t{2} << static_cast<int>(set));
    }
    for (const auto other : all_sets) {
      if (set == other || !is_available(set) || !is_available(other)) continue;
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
          ASSERT_EQ(other.signs, found.signs) << "batch " << batches;
          ASSERT_EQ(other.counts.lanes, found.counts.lanes) << "batch " << batches;
          ASSERT_EQ(other.counts.exact, found.counts.exact) << "batch " << batches;
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
  EXPECT_EQ(found.signs, packed.signs);
  EXPECT_EQ(found.counts.lanes, packed.counts.lanes);
}

}  // namespace
}  // namespace assay::detector
