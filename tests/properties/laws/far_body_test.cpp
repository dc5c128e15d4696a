#include <gtest/gtest.h>

#include <algorithm>

#include "detector/assembly.h"
#include "properties/generators/added_bodies.h"
#include "tests/properties/laws/judged_case.h"

namespace assay::properties {
namespace {

// Notes the most pieces of one loop; two lanes take them in turns.
class CountingArena : public detector::ThreadArena {
 public:
  explicit CountingArena(std::size_t& most) : most_(most) {}
  void run(std::size_t count, const Work& work) override {
    for (std::size_t i = 0; i < count; ++i) work.run(i, i % 2);
    most_ = std::max(most_, count);
  }

 private:
  std::size_t& most_;
};

TEST(FarBody, SharesWorkOutAndChangesNoAnswer) {
  int collisions = 0;
  for (int i = 0; i < 20; ++i) {
    const auto small = test::case_of("test:1:unclosed-generic:" + std::to_string(i)).c;
    const auto large = with_far_body(small, 0);
    ASSERT_TRUE(large);
    detector::Options options;
    options.culling = detector::Culling::bvh;
    std::size_t most = 0;
    auto alone = detector::assemble(small.triangles, small.frames[0], options,
                                    detector::standard_stages(options));
    auto shared = detector::assemble(large->triangles, large->frames[0], options,
                                     detector::standard_stages(options), {},
                                     detector::Workers(std::make_unique<CountingArena>(most), 2));
    ASSERT_TRUE(alone && shared);
    most = 0;
    const auto expected = alone.value().step(small.frames[0], small.frames[1]);
    const auto found = shared.value().step(large->frames[0], large->frames[1]);
    EXPECT_EQ(found.answer, expected.answer);
    EXPECT_TRUE(std::equal(
        found.pairs.begin(), found.pairs.end(), expected.pairs.begin(), expected.pairs.end(),
        [](const auto& a, const auto& b) { return a.pair == b.pair && a.time == b.time; }));
    EXPECT_GE(most, 4u);
    collisions += expected.answer == detector::Answer::collision ? 1 : 0;
  }
  EXPECT_GT(collisions, 0);
}

}  // namespace
}  // namespace assay::properties
