// `run --corpus DIR`: cases of the detector's owner, judged beside the campaign's.
#include "corpus/cases/case_file.h"
#include "properties/campaign/gates/findings.h"
#include "properties/campaign/gates/gates.h"
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

TEST_F(OwnCases, ThatFailMayBeWaivedUntilADay) {
  scratch.write("cases/known-to-fail.json", case_of_so_many("known-to-fail"));
  // Nothing smaller fails, so its shrinking would take all the time that it may have.
  const auto soon = scratch.write("soon.json", plan_text(16, R"(, "shrink_share": 0.001)"));
  const auto certify = [&](const std::string& name) {
    return run_assay("certify --campaign " + soon + " --out " + (scratch / name) + " --detector " +
                     plugin("misses_on_97") + " --corpus " + folder);
  };
  const auto predicate = [&](const std::string& name) {
    return nlohmann::json::parse(read_text(scratch / (name + "/certificate.json")))["predicate"];
  };
  const auto failed_in = [](const nlohmann::json& stated) {
    for (const auto& row : stated["corpus"]) {
      if (row["input"] == "own cases") return row["failed"];
    }
    return nlohmann::json();
  };
  const auto plain = certify("plain");
  ASSERT_EQ(plain.exit_code, 1) << plain.out << plain.err;
  auto failed = failed_in(predicate("plain"));
  ASSERT_EQ(failed.size(), 1u) << predicate("plain")["corpus"];
  EXPECT_EQ(failed[0]["id"], "own/known-to-fail");
  EXPECT_EQ(failed[0]["waived"], false);
  const auto waive = [&](const std::string& until) {
    const nlohmann::json waivers = {{"schema", "assay-known/1"},
                                    {"waivers",
                                     {{{"signature", failed[0]["signature"]},
                                       {"reason", "is being mended"},
                                       {"link", "https://example.org/7"},
                                       {"expires", until}}}}};
    scratch.write("cases/known.json", waivers.dump());
  };
  waive("2999-12-31");
  const auto waived = certify("waived");
  EXPECT_EQ(waived.exit_code, 0) << waived.out << waived.err;
  const auto stated = predicate("waived");
  EXPECT_EQ(stated["verdict"], "certified");
  EXPECT_EQ(failed_in(stated)[0]["waived"], true) << "the certificate says so";
  ASSERT_EQ(stated["waivers"].size(), 1u);
  EXPECT_EQ(stated["waivers"][0]["signature"], failed[0]["signature"]);
  EXPECT_EQ(stated["waivers"][0]["reason"], "is being mended");
  ASSERT_EQ(stated["failures"].size(), 1u);
  EXPECT_EQ(stated["failures"][0]["waived"], true);
  EXPECT_TRUE(contains(read_text(scratch / "waived/summary.md"), ", waived"));
  EXPECT_TRUE(contains(read_text(scratch / "waived/junit.xml"), "waived: "));
  EXPECT_EQ(run_assay("verify " + (scratch / "waived/certificate.json")).exit_code, 0);
  waive("2001-01-01");
  const auto expired = certify("expired");
  EXPECT_EQ(expired.exit_code, 1) << expired.out << expired.err;
  EXPECT_TRUE(contains(expired.out, "\" expired on 2001-01-01")) << expired.out;
}

TEST_F(OwnCases, GoWithTheFirstShard) {
  add(colliding);
  EXPECT_TRUE(contains(judge("wrapped_builtin", "--shard 1/2").out, "\nown cases "));
  EXPECT_FALSE(contains(judge("wrapped_builtin", "--shard 2/2").out, "\nown cases "));
}

TEST_F(OwnCases, ThatCannotBeReadAreRefused) {
  scratch.write("cases/torn.json", "{");
  expect_refused(judge("wrapped_builtin"), "torn.json");
}

// A gate names its folder before the first failure is kept there.
TEST_F(OwnCases, MayNotBeThereYet) {
  for (const bool is_there : {true, false}) {
    if (!is_there) std::filesystem::remove_all(folder);
    const auto ran = judge("wrapped_builtin");
    EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
    EXPECT_TRUE(contains(ran.out, "there is no case in it yet")) << ran.out;
  }
}

}  // namespace
}  // namespace assay::tests
