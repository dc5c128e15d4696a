// Two results of one step in which the same pairs are in contact at the same times.
#pragma once

#include "detector/options.h"
#include "detector/step_result.h"
#include "tests/test.h"

namespace assay::tests {

inline void expect_same_contacts(const detector::StepResult& a, const detector::StepResult& b) {
  EXPECT_EQ(a.answer, b.answer);
  EXPECT_EQ(a.first, b.first);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    EXPECT_EQ(a.pairs[i].pair, b.pairs[i].pair);
    EXPECT_EQ(a.pairs[i].time, b.pairs[i].time);
  }
}

}  // namespace assay::tests
