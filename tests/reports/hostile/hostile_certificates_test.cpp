// The complete table of what a plug-in may try, through `run` and `certify`: none holds, none is
// certified, and nothing beside is harmed.
#include "tests/reports/hostile_fixture.h"

namespace assay::tests {
namespace {

TEST_F(HostilePlugin, NoneIsCertified) {
  std::size_t tried = 0;
  for (const auto* modes : {&quick_modes(), &hanging_modes()}) {
    for (const auto& mode : *modes) {
      const auto ended = judge("certify", mode.name);
      expect_no_verdict_bought("certify", mode, ended);
      std::printf("certify %-26s exit code %d\n", mode.name, ended.exit_code);
      std::fflush(stdout);
      ++tried;
    }
  }
  EXPECT_GE(tried, 40u);
}

TEST_F(HostilePlugin, NoneHoldsInACampaignHoweverLongItTakes) {
  const std::vector<HostileMode> patient = {
      {"stop-itself", {3}}, {"hang-at-load", {2}}, {"hang-at-describe", {2}}};
  std::size_t tried = 0;
  for (const auto* modes : {&quick_modes(), &hanging_modes(), &patient}) {
    for (const auto& mode : *modes) {
      const auto ended = judge("run", mode.name);
      expect_no_verdict_bought("run", mode, ended);
      std::printf("run %-26s exit code %d\n", mode.name, ended.exit_code);
      std::fflush(stdout);
      ++tried;
    }
  }
  EXPECT_GE(tried, 40u);
}

TEST_F(HostilePlugin, LimitsOfTheUserBuyNoCertificate) {
  for (const char* limit : {"--nofile=8", "--nofile=10", "--nofile=16", "--as=46000000",
                            "--as=100000000", "--fsize=512", "--fsize=50000", "--fsize=500000"}) {
    for (const char* mode : {"forge-lies", "exit-at-evaluate"}) {
      const int code = expect_no_excuse("certify", mode, limit);
      std::printf("certify %s under %-16s exit code %d\n", mode, limit, code);
      std::fflush(stdout);
    }
  }
}

TEST_F(HostilePlugin, WhatTheSystemLacksStandsInTheCertificate) {
  const auto made = judge("certify", "", "--isolation best", without_landlock);
  EXPECT_EQ(made.exit_code, 1) << made.out << made.err;
  EXPECT_TRUE(contains(made.out, "isolation partial: lacks files;")) << made.out;
  EXPECT_TRUE(
      contains(read_text(out + "/certificate.json"), "\"isolation\": \"partial: lacks files\""));
  expect_refused(judge("certify", "", "--isolation required", without_landlock + "-n "),
                 "isolation is required, and this system's is partial: lacks files, processes");
}

}  // namespace
}  // namespace assay::tests
