// `run --corpus DIR`: cases that belong to the detector's owner, judged beside the cases of the
// campaign.
#include "corpus/cases/case_file.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
#include "tests/reports/tiny_campaign.h"

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
  expect_ended(judge("wrapped_builtin"), 0, {"\nown cases ", "\ncorpus     holds\n"});
  const auto findings = properties::read_findings(out).value();
  ASSERT_EQ(findings.evidence.sources.size(), 1u);
  EXPECT_EQ(findings.evidence.sources[0].cases, 1u);
  EXPECT_GE(findings.evidence.sources[0].collisions, 1u);
  // Without them the gate is not asked for.
  const auto plain = run_assay("run --campaign " + plan + " --out " + (scratch / "plain") +
                               " --detector " + plugin("wrapped_builtin"));
  EXPECT_TRUE(contains(plain.out, "\ncorpus     not judged\n")) << plain.out;
}

TEST_F(OwnCases, ThatFailAreADefectWithAMesh) {
  add(colliding);
  for (int i = 0; i < 2; ++i) {  // the second goes on with what is there
    expect_ended(judge("always_free"), 1,
                 {"\ncorpus     FAILS\n  own/" + colliding, "\nharness    holds\n"});
    EXPECT_TRUE(contains(read_text(out + "/junit.xml"), "own/" + colliding));
  }
  const auto findings = properties::read_findings(out).value();
  ASSERT_EQ(findings.evidence.sources.size(), 1u);
  ASSERT_EQ(findings.evidence.sources[0].failed.size(), 1u);
  const auto& failed = findings.evidence.sources[0].failed[0];
  EXPECT_EQ(failed.id, "own/" + colliding);
  bool is_stored = false;
  for (const auto& failure : findings.failures)
    is_stored |= failure.signature() == failed.signature;
  EXPECT_TRUE(is_stored);
  // Another set of cases is another run.
  add("A1_winding2_allpositive");
  expect_problem(judge("always_free"), "holds another run");
}

// A curated case with triangles far away beside it: no other case has as many as that on which
// plugin_misses_on_97 is wrong.
constexpr int triangles_of_own = 97;
std::string case_of_so_many(const std::string& id) {
  auto c = corpus::read_case(curated("D6_fast_passage")).value();
  const auto more = triangles_of_own - c.triangles.rows();
  const auto first = c.frames[0].rows(), triangles = c.triangles.rows();
  c.id = id;
  c.expected = {};
  c.view.reset();
  c.ghosts.reset();
  c.triangles.conservativeResize(triangles_of_own, 3);
  for (auto& frame : c.frames) frame.conservativeResize(first + 3 * more, 3);
  for (Eigen::Index t = 0; t < more; ++t) {
    for (int i = 0; i < 3; ++i) {
      const auto v = first + 3 * t + i;
      c.triangles(triangles + t, i) = static_cast<std::int32_t>(v);
      const double x = 1000. + 10. * static_cast<double>(t);
      for (auto& frame : c.frames) frame.row(v) << x + (i == 1), (i == 2), 0;
    }
  }
  return corpus::case_text(c);
}

TEST_F(OwnCases, ThatFailAreInTheCertificate) {
  scratch.write("cases/known-to-fail.json", case_of_so_many("known-to-fail"));
  // Nothing smaller fails, so its shrinking would take all the time that it may have.
  const auto soon = scratch.write("soon.json", plan_text(16, R"(, "shrink_share": 0.001)"));
  const auto issued = run_assay("certify --campaign " + soon + " --out " + (scratch / "plain") +
                                " --detector " + plugin("misses_on_97") + " --corpus " + folder);
  ASSERT_EQ(issued.exit_code, 1) << issued.out << issued.err;
  const auto judged = predicate_in(scratch / "plain")["corpus"];
  std::vector<nlohmann::ordered_json> failed;
  for (const auto& row : judged)
    failed.insert(failed.end(), row["failed"].begin(), row["failed"].end());
  ASSERT_EQ(failed.size(), 1u) << judged;
  EXPECT_EQ(failed[0]["id"], "own/known-to-fail");
}

TEST_F(OwnCases, ThatCannotBeReadAreRefused) {
  scratch.write("cases/torn.json", "{");
  expect_refused(judge("wrapped_builtin"), "torn.json");
}

// A gate names its folder before the first failure is kept there.
TEST_F(OwnCases, MayNotBeThereYet) {
  for (const bool is_there : {true, false}) {
    if (!is_there) std::filesystem::remove_all(folder);
    expect_ended(judge("wrapped_builtin"), 0, {"this folder has no case yet"});
  }
}

}  // namespace
}  // namespace assay::tests
