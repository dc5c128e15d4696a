// Limiters, and detectors that keep a distance. The right ones hold. For each wrong one a campaign
// finds a case, names the claim or the distance as its cause, and shrinks it to two or three
// triangles. The texts say how large a part of the possible steps limiters allow.

#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

// tests/plugins/limits_steps.cpp says what the words are.
class LimitsSteps : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string out = scratch / "out";

  std::string words(const std::string& said) const {
    return "ASSAY_LIMITS_STEPS=\"" + said + "\" ";
  }
  // With edges that are parallel, and neighbouring doubles. `part`: of the cases one in so many.
  Outcome run(const std::string& said, int part = 1) const {
    std::filesystem::remove_all(out);
    nlohmann::json campaign = {
        {"schema", "assay-campaign/1"}, {"name", "tiny"}, {"seconds", nullptr}};
    for (const auto& [family, cases] : {std::pair("closed-generic", 30),
                                        {"unclosed-generic", 20},
                                        {"unclosed-degenerate", 120},
                                        {"broken", 20}})
      campaign["strata"].push_back({{"family", family}, {"cases", cases / part}});
    const auto plan = scratch.write("plan.json", campaign.dump());
    return run_assay(
        "run --campaign " + plan + " --out " + out + " --detector " + plugin("limits_steps"),
        words(said));
  }
};

TEST_F(LimitsSteps, TheRightOnesHold) {
  for (const std::string said : {"", "positions", "share-alone", "separation=0.01"}) {
    SCOPED_TRACE(said);
    expect_ended(run(said), 0, {"time until the contact: median 0.95", "limits: 0 of "});
  }
}

TEST_F(LimitsSteps, EachFaultIsFoundWithTheRightClaimAndShrunk) {
  struct Fault {
    const char *said, *claim;
    int part;  // the more it shows in, the fewer cases find it, and the fewer are shrunk
  };
  for (const auto& [said, claim, part] : {Fault{"rounds-up", "path-free", 3},
                                          {"nearest-vertex", "commit-free", 10},
                                          {"forgets-one", "commit-free", 3},
                                          {"ignores-it separation=0.01", "commit-free", 10},
                                          {"last-pair", "commit-free", 3},
                                          {"float-end", "commit-free", 1},
                                          {"stale-start", "commit-free", 5},
                                          {"at-contact", "commit-free", 10},
                                          {"parallel-zero", "progress", 1},
                                          {"by-order", "commit-free", 1}}) {
    SCOPED_TRACE(said);
    expect_ended(run(said, part), 1, {std::string("DEFECT ") + claim + ": "});
    EXPECT_LE(triangles_of_smallest(out), 3);
  }
}

// One step of two triangles: what check, its report, replay and the picture say of it.
TEST_F(LimitsSteps, AFailureIsShownWithTheWayThatWasAllowed) {
  const auto folder = scratch / "frames";
  std::filesystem::create_directory(folder);
  const auto frame = [&](double z) {
    const auto file = folder + "/" + std::to_string(z) + ".obj";
    std::ofstream(file) << "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 " << z
                        << "\nv 2 1 4\nv 1 2 4\nf 1 2 3\nf 4 5 6\n";
    return file;
  };
  const std::string asked = "check " + frame(3) + " " + frame(-1) + " --detector " +
                            plugin("limits_steps") + " --json " + (scratch / "report.json");
  expect_ended(run_assay(asked, words("")), 0,
               {"limit: 0.7125 of the step, contact ahead at t = 0.75"});
  expect_ended(run_assay(asked, words("at-contact")), 1,
               {"contact at t = 1 of the way there", "broken: commit-free path-free"});
  const auto limit = read_json(scratch / "report.json")["steps"][0]["diff"]["limit"];
  EXPECT_EQ(limit["share"], 0.75);
  EXPECT_EQ(limit["contact_on_the_way"].dump(), "[1.0,1.0]") << limit;

  ASSERT_EQ(run("at-contact").exit_code, 1);
  std::string smallest;
  for (const auto& file : std::filesystem::directory_iterator(out + "/failures")) {
    if (contains(file.path().filename().string(), "-smallest.json")) smallest = file.path();
  }
  expect_ended(run_assay("replay " + smallest + " --detector " + plugin("limits_steps"),
                         words("at-contact")),
               1, {"commit-free"});
  const auto svg = read_text(std::filesystem::path(smallest).replace_extension(".svg").string());
  EXPECT_TRUE(contains(svg, "t = 1<")) << "the contact is at the end of the way\n" << svg;
}

// tests/plugins/keeps_distance.cpp says what the words are.
class KeptDistance : public testing::Test {
 protected:
  const Scratch scratch;
  const std::string out = scratch / "out";

  Outcome run(const std::string& words, const std::string& more = "") const {
    return run_assay("run --campaign " + scratch.write("plan.json", plan_text(16)) + " --out " +
                         out + " --time 600 --detector " + plugin("keeps_distance") + " " + more,
                     "ASSAY_KEEPS_DISTANCE=\"separation=0.01 " + words + "\" ");
  }
};

TEST_F(KeptDistance, TheOraclesOwnAnswersHold) {
  expect_ended(run(""), 0, {"contract: neighbours no-shared-vertex, within 0.01"});
}

TEST_F(KeptDistance, TheBuiltInDetectorsAnswersHold) { expect_ended(run("ours"), 0); }

TEST_F(KeptDistance, OneThatAlarmsWithinASlackSaysSo) {
  EXPECT_EQ(run("squares-it margin=0.2").exit_code, 0);
  std::filesystem::remove_all(out);
  EXPECT_EQ(run("squares-it margin=0.01").exit_code, 1);
}

TEST_F(KeptDistance, EachFaultIsFoundAndShrunkToTwoTriangles) {
  for (const std::string fault : {"ignores-it", "squares-it", "half-boxes", "no-edges"}) {
    SCOPED_TRACE(fault);
    std::filesystem::remove_all(out);
    expect_ended(run(fault), 1);
    int named = 0;
    for (const auto& [signature, count] : signatures_of(out))
      named += contains(signature, "distance") ? 1 : 0;
    EXPECT_GT(named, 0);
    EXPECT_EQ(triangles_of_smallest(out), 2);
  }
}

// A detector of displacements in float32 is judged on the path that it was given: exact in its own
// terms it is accused of nothing; one that rounds the end first is, by an ulp.
TEST(Displacements, AreJudgedOnThePathThatWasGiven) {
  const Scratch scratch;
  const std::string out = scratch / "out";
  const auto run = [&](const std::string& said) {
    std::filesystem::remove_all(out);
    return run_assay(
        "run --campaign " + scratch.write("plan.json", plan_text(60)) + " --out " + out +
            " --time 600 --detector " + plugin("by_contract"),
        "ASSAY_BY_CONTRACT=\"strangers start=free float32 displacement " + said + "\" ");
  };
  expect_ended(run(""), 0, {"motion displacement"});
  const auto rounded = expect_ended(run("rounds-end"), 1);
  EXPECT_TRUE(contains(rounded.out, "DEFECT first-time: ") ||
              contains(rounded.out, "DEFECT not-late: "))
      << rounded.out;
  // The case holds the exact end, which is no float32.
  bool shows_it = false;
  for (const auto& c : smallest_cases(out)) {
    for (const auto& frame : c.frames) shows_it |= frame != frame.cast<float>().cast<double>();
  }
  EXPECT_TRUE(shows_it);
}

}  // namespace
}  // namespace assay::tests
