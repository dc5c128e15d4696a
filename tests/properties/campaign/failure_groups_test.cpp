// Kinds of failure are grouped by what they do; what those that lose a contact share is tested
// where cases that hold stand beside them (tests/reports/verbs/run_command_test.cpp).
#include "properties/campaign/gates/gates.h"
#include "tests/properties/campaign/good_findings.h"
#include "tests/test.h"

namespace assay::properties {
namespace {

RunFindings failing_by(const std::vector<std::string>& signatures) {
  auto findings = test::good_findings();
  for (const auto& signature : signatures)
    findings.failures.push_back(test::failure(signature, signature));
  return findings;
}

TEST(FailureGroups, WhatTheyDoComesFromTheKindNotFromTheStageOrALawBeforeIt) {
  auto findings = failing_by(
      {"all-pairs: late pair", "all-pairs: missing pair at view sets, edge-edge, t inside, moving",
       "free-sound: answered free, vertex-face, t at 0, moving",
       "law Change_Mirror, not-late: late, edge-edge, t inside, moving", "law L3_X",
       "no-spurious: answered collision, moving", "no-spurious: early alarm",
       "progress: share too small", "total: crashed", "deterministic: two runs differ",
       "total: refused"});
  findings.failures.back().flaky = true;
  const auto groups = failure_groups(findings);
  std::map<std::string, std::size_t> kinds;
  for (const auto& group : groups) kinds[group.does] = group.kinds.size();
  const std::map<std::string, std::size_t> wanted = {{"lose a contact", 4},
                                                     {"break a law", 1},
                                                     {"report what is not there, or too early", 2},
                                                     {"stop before they have to", 1},
                                                     {"end without an answer", 1},
                                                     {"answer otherwise when asked again", 2}};
  EXPECT_EQ(kinds, wanted);
  EXPECT_EQ(text_of(groups[0], 11), "4 of 11 kinds of failure lose a contact");
  EXPECT_TRUE(groups[0].shared.empty());
}

TEST(FailureGroups, ASingleKindIsInNone) {
  EXPECT_TRUE(failure_groups(failing_by({})).empty());
  EXPECT_TRUE(failure_groups(failing_by({"total: crashed"})).empty());
  const auto two = failure_groups(failing_by({"total: crashed", "total: refused"}));
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(text_of(two[0], 2), "all 2 kinds of failure end without an answer");
}

}  // namespace
}  // namespace assay::properties
