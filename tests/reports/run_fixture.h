// A folder, a tiny campaign, and `assay run` of it.
#pragma once

#include "tests/reports/tiny_campaign.h"

namespace assay::tests {

class RunFixture : public testing::Test {
 protected:
  const Scratch scratch;
  std::string plan = scratch.write("plan.json", plan_text(16));
  std::string out = scratch / "out";
  Outcome run(const std::string& more = "", const std::string& prefix = "") const {
    return run_assay("run --campaign " + plan + " --out " + out + " " + more, prefix);
  }
};

}  // namespace assay::tests
