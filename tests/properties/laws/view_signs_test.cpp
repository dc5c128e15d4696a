// The detector's view signs, lanes and all, against the oracle's, for triangles without a mesh.
#include "detector/view/view_signs.h"

#include "oracle/view/view_sign.h"
#include "tests/detector/small_stack.h"
#include "tests/detector/view/triangle_batches.h"

namespace assay::properties {
namespace {

using namespace detector;
using tests::BatchFamily;

int batches_of(BatchFamily family, bool line) {
  switch (family) {
    case BatchFamily::generic:
    case BatchFamily::small_motion:
    case BatchFamily::far:
      return line ? 20 : 100;
    case BatchFamily::tiny:
    case BatchFamily::huge:
      return 1;
    default:
      return line ? 5 : 20;
  }
}

void compare(bool line) {
  tests::BatchMaker maker(line ? 20116 : 20115);
  for (std::size_t f = 0; f < tests::batch_family_names.size(); ++f) {
    const auto family = static_cast<BatchFamily>(f);
    std::size_t count = 0;
    std::uint64_t lanes = 0;
    for (int b = 0; b < batches_of(family, line); ++b) {
      const auto batch = maker.make(family, 100, line);
      std::vector<ViewSign> found(batch.mesh.triangles.size());
      ViewCounts counts;
      tests::on_small_stack([&] {
        classify(batch.mesh, batch.mesh.components[0], {batch.x_t0, batch.x_t1}, batch.primitive,
                 found, counts);
      });
      Triangles triangles(static_cast<Eigen::Index>(found.size()), 3);
      for (std::size_t t = 0; t < found.size(); ++t) {
        const auto& v = batch.mesh.triangles[t];
        triangles.row(static_cast<Eigen::Index>(t)) << v[0], v[1], v[2];
      }
      ASSERT_EQ(found, oracle::view_signs({batch.x_t0, batch.x_t1}, triangles,
                                          std::span(&batch.primitive, 1), 1))
          << tests::batch_family_names[f] << ", batch " << b;
      count += found.size();
      lanes += counts.lanes;
    }
    std::printf("%-16s %5zu triangles equal, %.3f of them settled in lanes\n",
                tests::batch_family_names[f], count,
                static_cast<double>(lanes) / static_cast<double>(count));
  }
}

TEST(ViewSigns, L2_PointSignsAreTheOracles) { compare(false); }
TEST(ViewSigns, L1_LineSignsAreTheOracles) { compare(true); }

}  // namespace
}  // namespace assay::properties
