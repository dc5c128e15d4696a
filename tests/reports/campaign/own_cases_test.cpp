// `run --corpus DIR`: cases of the detector's owner, judged beside the campaign's.
#include <gtest/gtest.h>

#include "properties/campaign/gates/gates.h"
#include "properties/campaign/gates/read_findings.h"
#include "tests/reports/run_fixture.h"

namespace assay::tests {
namespace {

class OwnCases : public RunFixture {
 protected:
  OwnCases() { std::filesystem::create_directory(folder); }

  void add(const std::string& name) const {
    std::filesystem::copy_file(curated(name), folder + "/" + name + ".json");
  }
  Outcome judge(const std::string& library, const std::string& more = "") const {
    return run("--detector " + plugin(library) + " --corpus " + folder + " " + more);
  }

  const std::string folder = scratch / "cases";
  const std::string colliding = "D6_fast_passage";
};

TEST_F(OwnCases, HoldAndAreAGate) {
  add(colliding);
  scratch.write("cases/known.json", "not looked at by run");
  const auto made = judge("wrapped_builtin");
  EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
  EXPECT_TRUE(contains(made.out, "\nown cases ")) << made.out;
  EXPECT_TRUE(contains(made.out, "\ncorpus     holds\n")) << made.out;
  const auto findings = properties::read_findings(out).value();
  ASSERT_EQ(findings.evidence.corpus.size(), 1u);
  EXPECT_EQ(findings.evidence.corpus[0].cases, 1u);
  EXPECT_GE(findings.evidence.corpus[0].collisions, 1u);
  // Without them the gate is not asked for.
  const auto plain = run_assay("run --campaign " + plan + " --out " + (scratch / "plain") +
                               " --detector " + plugin("wrapped_builtin"));
  EXPECT_TRUE(contains(plain.out, "\ncorpus     not judged\n")) << plain.out;
}

TEST_F(OwnCases, ThatFailAreADefectWithAMesh) {
  add(colliding);
  for (int i = 0; i < 2; ++i) {  // the second goes on with what is there
    const auto made = judge("always_free");
    EXPECT_EQ(made.exit_code, 1) << made.out << made.err;
    EXPECT_TRUE(contains(made.out, "\ncorpus     FAILS\n  own/" + colliding)) << made.out;
    EXPECT_TRUE(contains(made.out, "\nharness    holds\n")) << made.out;
    EXPECT_TRUE(contains(read_text(out + "/junit.xml"), "own/" + colliding));
  }
  const auto findings = properties::read_findings(out).value();
  ASSERT_EQ(findings.evidence.corpus.size(), 1u);
  ASSERT_EQ(findings.evidence.corpus[0].failed.size(), 1u);
  const auto& failed = findings.evidence.corpus[0].failed[0];
  EXPECT_EQ(failed.id, "own/" + colliding);
  bool is_stored = false;
  for (const auto& failure : findings.failures) is_stored |= failure.signature == failed.signature;
  EXPECT_TRUE(is_stored);
  // Another set of cases is another run.
  add("A1_winding2_allpositive");
  const auto other = judge("always_free");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(contains(other.err, "holds another run")) << other.err;
}

TEST_F(OwnCases, GoWithTheFirstShard) {
  add(colliding);
  EXPECT_TRUE(contains(judge("wrapped_builtin", "--shard 1/2").out, "\nown cases "));
  EXPECT_FALSE(contains(judge("wrapped_builtin", "--shard 2/2").out, "\nown cases "));
}

TEST_F(OwnCases, ThatCannotBeReadAreRefused) {
  expect_refused(judge("wrapped_builtin"), "there is no case file in it");
  scratch.write("cases/torn.json", "{");
  expect_refused(judge("wrapped_builtin"), "torn.json");
  std::filesystem::remove_all(folder);
  expect_refused(judge("wrapped_builtin"), folder);
}

}  // namespace
}  // namespace assay::tests
