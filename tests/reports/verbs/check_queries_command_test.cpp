// assay check-queries with a separation, as a user runs it: a query whose distance is known.
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using nlohmann::json;

class QueriesWithin : public testing::Test {
 protected:
  // A vertex that sinks from z = 3 to z = 1 above the inside of a face at rest.
  static std::string rows(const std::string& ending) {
    std::string text;
    for (const char* vertex : {"1,1,1,1,3,1", "1,1,1,1,1,1"}) {
      for (const char* row : {vertex, "0,1,0,1,0,1", "4,1,0,1,0,1", "0,1,4,1,0,1"})
        text += row + ending + "\n";
    }
    return text;
  }
  Outcome check(const std::string& text, const std::string& options) const {
    return run_assay("check-queries " + scratch.write("vf.csv", text) + " --json " +
                     (scratch / "q.json") + " " + options);
  }
  json report() const { return json::parse(read_text(scratch / "q.json")); }
  const Scratch scratch;
};

TEST_F(QueriesWithin, EveryMethodThatKnowsDistanceTellsItFromTheDoubleBelow) {
  for (const std::string method : {"oracle", "referee", "detector-exact"}) {
    SCOPED_TRACE(method);
    const auto near = check(rows(",1"), "--separation 1 --method " + method);
    EXPECT_EQ(near.exit_code, 0) << near.out << near.err;
    EXPECT_TRUE(says(near.out, method + ": 1 queries (1 within 1), 1 yes, 0 without a label"));
    EXPECT_EQ(report()["separation"], json::array({1.0, 1.0}));
    EXPECT_EQ(report()["yes"], 1);
    const auto apart = check(rows(",0"), "--separation 0.9999999999999999 --method " + method);
    EXPECT_EQ(apart.exit_code, 0) << apart.out << apart.err;
    EXPECT_EQ(report()["yes"], 0);
    EXPECT_EQ(report()["open"], 0);
    // Distance 0 is contact.
    EXPECT_EQ(check(rows(",0"), "--separation 0 --method " + method).exit_code, 0);
    EXPECT_EQ(check(rows(",0"), "--method " + method).exit_code, 0);
    EXPECT_EQ(report()["separation"], nullptr);
  }
}

TEST_F(QueriesWithin, RowsWithASeparationGoBeforeTheOption) {
  const auto text = rows(",0,0.5") + rows(",1,2") + rows(",1,0.75") + rows(",1");
  const auto wrong = check(text, "--separation 1");
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out << wrong.err;
  EXPECT_TRUE(says(wrong.out, "oracle: 4 queries (4 within 0.5 to 2), 2 yes"));
  EXPECT_TRUE(says(wrong.out, "vf.csv query 2 within 0.75: answer false, label true\n"));
  EXPECT_EQ(report()["separation"], json::array({0.5, 2.0}));
  EXPECT_EQ(report()["differences"][0]["separation"], 0.75);
  // Without the option a row that says none asks for contact.
  const auto contact = check(rows(",1,2") + rows(",1"), "");
  EXPECT_EQ(contact.exit_code, 1) << contact.out << contact.err;
  EXPECT_TRUE(says(contact.out, "2 queries (1 within 2), 1 yes"));
  EXPECT_TRUE(says(contact.out, "vf.csv query 1: answer false, label true\n"));
  EXPECT_EQ(report()["differences"][0]["separation"], nullptr);
}

TEST_F(QueriesWithin, WhatKnowsNoDistanceIsRefusedInOneLine) {
  const auto expect_refused = [&](const std::string& text, const std::string& options,
                                  const std::string& word) {
    const auto outcome = check(text, options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(says(outcome.err, word));
  };
  for (const std::string method : {"detector-bounded", "detector-double", "detector-float"}) {
    const auto knows_none = "--method " + method + " knows no separation";
    expect_refused(rows(",1"), "--separation 1 --method " + method, "query 0: " + knows_none);
    expect_refused(rows("") + rows(",1,2"), "--method " + method, "query 1: " + knows_none);
  }
  for (const std::string word : {"-1", "nan", "1e999", "x"})
    expect_refused(rows(",1"), "--separation=" + word, "--separation");
}

}  // namespace
}  // namespace assay::tests
