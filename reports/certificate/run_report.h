// What one run of `assay run` came to, for CI systems: JUnit XML and a Markdown summary.
#pragma once

#include <optional>
#include <string>

#include "properties/campaign/runner.h"

namespace assay::reports {

// Writes OUT/junit.xml and OUT/summary.md; of a shard of several, OUT/junit-shard-I-of-N.xml and so
// on. From the shard's store alone, under the gates of a certificate but for what only `certify`
// does (corpus, self-test, speed). A line for the user when that fails.
std::optional<std::string> write_run_report(const properties::CampaignRequest& request,
                                            const std::string& out);

}  // namespace assay::reports
