// The complete table of what can go wrong in a plug-in, through `run` and `certify`: no such
// plug-in holds or is certified, and nothing else is harmed.
#include "tests/reports/hostile_fixture.h"

namespace assay::tests {
namespace {

TEST_F(HostilePlugin, NoneIsCertified) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  expect_none_holds("certify", {});
}

TEST_F(HostilePlugin, NoneHoldsInACampaignHoweverLongItTakes) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  expect_none_holds("run",
                    {{"stop-itself", {3}}, {"hang-at-load", {2}}, {"hang-at-describe", {2}}});
}

TEST_F(HostilePlugin, LimitsOfTheUserBuyNoCertificate) {
  if (is_let_loose()) GTEST_SKIP() << properties::fault_of_bubblewrap();
  for (const char* limit : {"--nofile=8", "--nofile=10", "--nofile=16", "--as=46000000",
                            "--as=100000000", "--fsize=512", "--fsize=50000", "--fsize=500000"}) {
    for (const char* mode : {"overwrite", "exit-at-evaluate"})
      expect_no_excuse("certify", mode, limit);
  }
}

TEST_F(HostilePlugin, LimitsAloneStandInTheCertificate) {
  expect_ended(judge("certify", "", "", forbidden_bwrap), 1, {"isolation limits alone;"});
  EXPECT_TRUE(contains(read_text(out + "/certificate.json"), "\"isolation\": \"limits alone\""));
}

}  // namespace
}  // namespace assay::tests
