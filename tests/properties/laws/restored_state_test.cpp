// A restored detector that rests: what a step left in contact, and did not name, shows only there.
#include <gtest/gtest.h>

#include "tests/properties/laws/judged_case.h"

namespace assay::properties {
namespace {

// Cases on which a state whose bytes did not tell whether its contacts are complete went on
// otherwise: some 1 of 100 with view-point and first pairs.
TEST(RestoredState, GoesOnAlikeWhereFirstPairsLeftContactsUnnamed) {
  const Law* law = law_named("Change_RestoredStateGoesOn");
  ASSERT_NE(law, nullptr);
  test::Setting setting;
  setting.options.culling = detector::Culling::view_point;
  setting.options.pairs = detector::Pairs::first;
  LawTally tally;
  for (const char* id : {"874", "895", "1193", "1297", "1396"}) {
    const test::JudgedCase judged(test::case_of(std::string("test:1:closed-degenerate:") + id).c,
                                  setting);
    auto facts = judged.facts();
    law->check(facts, tally);
  }
  EXPECT_EQ(tally.broken, 0u) << tally.first_broken;
  EXPECT_GE(tally.premise, 5u);
}

}  // namespace
}  // namespace assay::properties
