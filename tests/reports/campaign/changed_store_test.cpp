// Somebody rewrites the stores of a run while it is at work, hashes and all, as the code of a
// plug-in could that leaves a process behind: there is neither verdict nor certificate then.
#include <fmt/format.h>

#include "properties/campaign/ledger/record.h"
#include "tests/reports/campaign/started.h"
#include "tests/reports/run_fixture.h"

namespace assay::tests {
namespace {

using namespace properties;

class ChangedStore : public RunFixture {
 protected:
  ChangedStore() { plan = scratch.write("plan.json", plan_text(64)); }
  // The first trial that is stored says from then on that all holds, and its failures are gone.
  // True once it is so.
  static bool rewrite(const std::string& file) {
    try {
      const Database database(file, Database::Mode::write);
      std::vector<Row> rows;
      for_each_row(database, nullptr, "WHERE kind='trial' ORDER BY key LIMIT 1", {},
                   [&](const Row& row) { rows.push_back(row); });
      if (rows.empty()) return false;
      TrialRecord record = trial_of(rows[0]);
      for (char& letter : record.outcomes) letter = letter == 'H' ? 'D' : 'H';
      put_row(database, to_row(record));
      return true;
    } catch (const StoreProblem&) {
      return false;  // not there yet, or busy
    }
  }
  struct Ended {
    int code = -1;
    std::string output;
  };
  // Runs the words and rewrites the store once, in the middle.
  Ended run_and_rewrite(const std::vector<std::string>& words) const {
    const std::string file = out + "/run.sqlite", output = scratch / "output";
    Started program(words, output);
    bool is_rewritten = false;
    while (!program.has_ended() && !is_rewritten) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      is_rewritten = std::filesystem::exists(file) && rewrite(file);
    }
    EXPECT_TRUE(is_rewritten);
    const int status = program.end();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(output)};
  }
  void expect_no_verdict(const Ended& ended) const {
    EXPECT_EQ(ended.code, 4) << ended.output;
    const auto line = fmt::format("assay: {}/run.sqlite: trial tiny:1:", out);
    const auto at = ended.output.find(line);
    ASSERT_NE(at, std::string::npos) << ended.output;
    const auto end = ended.output.find('\n', at);
    EXPECT_TRUE(
        ended.output.substr(at, end - at).ends_with(" was changed while this run was at work"))
        << ended.output;
    EXPECT_FALSE(contains(ended.output, "verdict")) << ended.output;
    EXPECT_FALSE(std::filesystem::exists(out + "/certificate.json"));
    EXPECT_FALSE(std::filesystem::exists(out + "/summary.md"));
  }
};

TEST_F(ChangedStore, IsNoGroundForACertificate) {
  expect_no_verdict(run_and_rewrite(
      {"certify", "--campaign", plan, "--detector", plugin("wrapped_builtin"), "--out", out}));
}

TEST_F(ChangedStore, NorForTheVerdictOfARun) {
  expect_no_verdict(run_and_rewrite({"run", "--campaign", plan, "--out", out}));
}

}  // namespace
}  // namespace assay::tests
