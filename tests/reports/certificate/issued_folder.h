// Makes a folder with a certificate that verifies, without running a campaign.
#pragma once

#include "reports/certificate/statement.h"
#include "tests/reports/program.h"
#include "tests/reports/stored_run.h"

namespace assay::tests {

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// Writes the certificate of the present stores of the folder.
inline void issue(const std::string& folder) {
  const auto statement = value_of(reports::make_statement(folder));
  write_bytes(properties::certificate_file(folder), reports::statement_text(statement));
  ASSERT_TRUE(reports::write_for_ci(statement["predicate"], folder));
}

// Stores the run, the paths with which its certificate is issued, and the certificate.
inline void store_and_issue(const RunToStore& run, const std::string& folder,
                            const properties::Issuance& paths) {
  run.store(folder);
  auto store = value_of(
      properties::Store::open(properties::store_file(folder), properties::binding_of(run.request)));
  store.set(to_row(paths));
  store.set(to_row(properties::asked_of_a_run()));
  ASSERT_TRUE(store.seal());
  write_bytes(properties::campaign_file(folder), properties::plan_text(run.request.plan) + "\n");
  issue(folder);
}

// Returns a run in which everything holds, so that `assay verify` ends with 0.
inline RunToStore good_run() {
  return RunToStore().meet_canary(3).judge("closed-generic", 10, 'H').judge("broken", 10, 'H');
}

}  // namespace assay::tests
