#include "properties/judging/contracted_case.h"

#include <gtest/gtest.h>

#include "properties/campaign/trials/planned_case.h"

namespace assay::properties {
namespace {

// Two triangles, the second at these heights in the frames: in contact where the height is 0.
corpus::Case at_heights(const std::vector<double>& heights) {
  corpus::Case c;
  c.id = "heights";
  c.triangles.resize(2, 3);
  c.triangles << 0, 1, 2, 3, 4, 5;
  for (const double z : heights) {
    detector::Positions x(6, 3);
    x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, z, 2, 1, z, 1, 2, z;
    c.frames.push_back(x);
  }
  return c;
}

const Contract free_start = {.start = StartRule::free};

TEST(ContractedCase, WithoutAContractIsTheCase) {
  const auto c = at_heights({1, 0, 1});
  EXPECT_EQ(corpus::case_text(*contracted(c, {})), corpus::case_text(c));
}

TEST(ContractedCase, LeavesOutStepsThatStartInContact) {
  const auto c = at_heights({0, 2, 1, 0, 3});
  const auto seen = contracted(c, free_start);
  ASSERT_TRUE(seen);
  // From height 2 to 1, and from 1 to 0: a detector is made at height 2.
  EXPECT_EQ(corpus::steps_of(*seen), (std::vector<corpus::CaseStep>{{0, 1, true}, {1, 2, true}}));
  EXPECT_EQ(seen->frames[0](3, 2), 2);
  EXPECT_EQ(seen->frames.size(), 3u);
  EXPECT_EQ(corpus::case_text(*contracted(*seen, free_start)), corpus::case_text(*seen));
  EXPECT_FALSE(contracted(at_heights({0, 1}), free_start));
}

TEST(ContractedCase, LeavesOutStepsThatStartTooNear) {
  const Contract apart = {.start = StartRule::apart, .start_distance = 1.5};
  const auto seen = contracted(at_heights({1, 2, 1}), apart);
  ASSERT_TRUE(seen);
  EXPECT_EQ(corpus::steps_of(*seen).size(), 1u);
  EXPECT_EQ(seen->frames[0](3, 2), 2);
  EXPECT_TRUE(contracted(at_heights({1.5, 0}), apart));
  EXPECT_FALSE(contracted(at_heights({1.25, 0}), apart));
}

TEST(ContractedCase, IsNoneBeyondTheRange) {
  const Contract range = {.least_nonzero = 0.5, .largest = 4};
  EXPECT_TRUE(contracted(at_heights({0.5, 0}), range));
  EXPECT_FALSE(contracted(at_heights({0.25, 0}), range));
  EXPECT_FALSE(contracted(at_heights({1, -5}), range));
}

TEST(ContractedCase, IsBroughtIntoTheRange) {
  const Contract range = {.least_nonzero = 1e-3, .largest = 2};
  const auto c = brought_into_range(at_heights({1024, 1e-3}), range);
  EXPECT_EQ(c.frames[0](3, 2), 2);
  EXPECT_EQ(c.frames[0](1, 0), 4. / 512);
  EXPECT_EQ(c.frames[1](3, 2), 0);  // too small now
  EXPECT_TRUE(contracted(c, range));
}

TEST(ContractedCase, OfEveryFamilyThereIsOneWithinEveryContract) {
  const Contract narrow = {.coordinates = Coordinates::float32,
                           .start = StartRule::free,
                           .least_nonzero = 1e-6,
                           .largest = 1e6};
  for (const auto& family : families()) {
    for (int i = 0; i < 10; ++i) {
      const auto id = "within:1:" + std::string(family.name) + ":" + std::to_string(i);
      const auto planned = case_within(narrow, family, id);
      EXPECT_TRUE(planned.seen) << id;
      EXPECT_EQ(case_within({}, family, id).made.c.id, id);
    }
  }
}

}  // namespace
}  // namespace assay::properties
