// `assay replay`: by id, by file, with --why, and with --export.

#include "corpus/cases/case_file.h"
#include "properties/campaign/trials/trials.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

const char* const some_id = "tiny:1:closed-generic:5";

TEST(Replay, ByIdGoesThroughEveryConfiguration) {
  const auto outcome = expect_ended(std::string("replay ") + some_id, 0);
  EXPECT_EQ(outcome.out.find(some_id), 0u);
  for (const std::string name : {"view-auto", "view-point", "view-line", "normal-cone", "bvh",
                                 "none", "view-point/first", "view-line/bounded"}) {
    EXPECT_TRUE(
        std::regex_search(outcome.out, std::regex("(^|, |\n)" + name + "(, [^:\n]*)?: holds\n")))
        << name << outcome.out;
  }
  EXPECT_TRUE(contains(outcome.out, "step 1 (frame 0 to 1, committed): oracle ")) << outcome.out;
  EXPECT_EQ(run_assay(std::string("replay ") + some_id).out, outcome.out);
  // Of other rounds of a campaign.
  EXPECT_EQ(run_assay("replay quick:7.canary:broken:12").exit_code, 0);
}

TEST(Replay, SaysOnceWhatSeveralConfigurationsComeTo) {
  const auto outcome = expect_ended(std::string("replay ") + some_id + " --why 0,1", 0);
  std::set<std::string> stories;
  std::size_t told = 0;
  for (auto at = outcome.out.find("\n  step 1: "); at != std::string::npos; ++told) {
    const auto end = outcome.out.find("\n  step 1: ", at + 1);
    // Behind it stand the names of the next ones.
    const auto story = outcome.out.substr(at, end - at);
    stories.insert(story.substr(0, story.rfind("detector: ")));
    at = end;
  }
  EXPECT_GE(told, 2u) << outcome.out;
  EXPECT_LE(told, 4u) << outcome.out;
  EXPECT_EQ(stories.size(), told) << outcome.out;
}

TEST(Replay, ByFileTakesTheFilesOptions) {
  const auto outcome =
      expect_ended("replay " + curated("A4_endpoints_only"), 0, {"view-point: holds"});
  EXPECT_FALSE(contains(outcome.out, "bvh: ")) << outcome.out;
}

TEST(Replay, WhatACaseSaysOfItselfGivesNoOrders) {
  const Scratch scratch;
  auto text = read_text(curated("A4_endpoints_only"));
  const auto about = text.find("\"about\": \"");
  ASSERT_NE(about, std::string::npos);
  text.insert(about + 10, "\\u001b[2Jgone");
  const auto outcome = expect_ended("replay " + scratch.write("case.json", text), 0, {"?[2Jgone"});
  EXPECT_FALSE(says(outcome.out, "\033"));
}

TEST(Replay, GivesTheStartAsTheCampaignDid) {
  const std::string line = "\nas in the campaign, the detector is told that the start is clean\n";
  int told = 0, clean_but_even = 0, odd_but_not_clean = 0;
  for (const std::string name : {"closed-generic", "broken"}) {
    for (std::uint64_t index = 0; index < 6; ++index) {
      const std::string id = "tiny:1:" + name + ":" + std::to_string(index);
      SCOPED_TRACE(id);
      bool clean = false;
      for (const auto& family : properties::families()) {
        if (family.name == name) clean = properties::starts_clean(make_case(family, id).c);
      }
      const bool odd = index % 2 == 1;
      EXPECT_EQ(contains(run_assay("replay " + id).out, line), odd && clean);
      told += odd && clean;
      clean_but_even += !odd && clean;
      odd_but_not_clean += odd && !clean;
      if (told == 1 && odd && clean) {
        EXPECT_FALSE(contains(
            run_assay("replay " + id + " --detector " + plugin("wrapped_builtin")).out, line));
      }
    }
  }
  EXPECT_GT(told, 0);
  EXPECT_GT(clean_but_even, 0);
  EXPECT_GT(odd_but_not_clean, 0);
}

TEST(Replay, OfAPlugInShowsItsDefect) {
  expect_ended("replay " + curated("A4_endpoints_only") + " --detector " + plugin("always_free"), 1,
               {"DEFECT free-sound: answered free"});
  expect_ended("replay tiny:1:broken:1 --detector " + plugin("exit"), 1, {"exited with code 0"});

  const auto wrong =
      run_assay("replay " + curated("A4_endpoints_only") + " --detector " + plugin("no_interval"));
  EXPECT_TRUE(says(wrong.out, "DEFECT total: error in step 1: its first time, [1, 0], is no"));
}

TEST(Replay, WhatIsNeitherIdNorFileIsRefused) {
  for (const std::string id :
       {"nowhere.json", "tiny:1:closed:5", "tiny:1:closed-generic:", "tiny:1:closed-generic:x",
        "tiny::closed-generic:5", "tiny:x:closed-generic:5", "tiny:1:closed-generic",
        "tiny:1:closed-generic:5:6", ":1:closed-generic:5", "tiny:1:closed-generic:-5"}) {
    SCOPED_TRACE(id);
    expect_refused("replay " + id, id);
  }
  expect_refused("replay tiny:1:closed:5", "CAMPAIGN:SEED:FAMILY:INDEX");
  // A campaign of a file may be called so.
  expect_ended("replay smok:1:closed-generic:5", 0,
               {"no built-in campaign is called smok; did you mean smoke?"});
  expect_refused("replay", "CASE is required");
  expect_refused("replay /tmp", "directory");
  const Scratch scratch;
  expect_refused("replay " + scratch.write("bad.json", "{"), "bad.json");
}

TEST(Replay, WhyTellsOfAPair) {
  const auto file = curated("A4_endpoints_only");
  const auto outcome =
      expect_ended("replay " + file + " --why 0,1", 0,
                   {"why 0, 1:", "triangle 0: component 0", "triangle 1: component ",
                    "moving boxes ", "oracle: ", "detector: "});
  EXPECT_EQ(run_assay("replay " + file + " --why 1,0").out, outcome.out);
  // What it says of being reported is what the step says.
  const bool reported = contains(outcome.out, "detector: reported");
  EXPECT_EQ(reported, contains(outcome.out, "oracle: in contact at t = ")) << outcome.out;
  for (const std::string pair : {"0,99", "-1,2", "1,1", "1", "a,b", "1,2,3", "'1;2'", "''"}) {
    SCOPED_TRACE(pair);
    expect_refused("replay " + file + " --why=" + pair, "--why");
  }
  expect_refused("replay " + file + " --why 0,1 --detector " + plugin("always_free"), "--why");
}

// Triangle 1 sinks from 3 to 1 above triangle 0; triangle 2 lies beside that, beyond an edge.
TEST(Replay, WhyTellsOfADistanceWhereTheCaseHasASeparation) {
  corpus::Case c;
  c.id = "above";
  c.triangles.resize(3, 3);
  c.triangles << 0, 1, 2, 3, 4, 5, 1, 6, 2;
  for (const double z : {3, 1}) {
    auto& x = c.frames.emplace_back(7, 3);
    x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, z, 2, 1, 4, 1, 2, 4, 9, 9, 0;
  }
  const Scratch scratch;
  const auto expect_why = [&](const std::string& separation, const std::string& pair,
                              const std::vector<std::string>& said) {
    SCOPED_TRACE(separation + " " + pair);
    c.options = {{"culling", "bvh"}, {"separation", separation}};
    EXPECT_TRUE(corpus::write_case(scratch / "above.json", c));
    expect_ended("replay " + (scratch / "above.json") + " --why " + pair, 0, said);
  };
  expect_why("2", "0,1",
             {"oracle collision at t = 0.5, 2 pairs within 2\n", "moving boxes grown by 2 meet\n",
              "oracle: within 2 at t = 0.5 (vertex-face)\n", "detector: reported\n"});
  expect_why("0.5", "0,1",
             {"moving boxes grown by 0.5 are apart: never tested\n",
              "oracle: never within 0.5; least distance 1\n", "detector: not reported\n"});
  expect_why("1.5", "1,2",
             {"moving boxes grown by 1.5 meet\n",
              "oracle: never within 1.5; least distance 1.7320508075688774\n"});
  expect_why("1.5", "0,2",
             {"a common vertex: a separation leaves such pairs out; ", "oracle: not asked\n"});
}

TEST(Replay, EveryPairOfACaseHasAStoryThatAgreesWithTheOracle) {
  // All pairs of a small mesh in contact: those that the oracle has are reported, the others not.
  const auto file = curated("A4_endpoints_only");
  const auto c = value_of(corpus::read_case(file));
  int met = 0, apart = 0;
  for (int a = 0; a < c.triangles.rows(); ++a) {
    for (int b = a + 1; b < c.triangles.rows(); ++b) {
      const auto out =
          run_assay("replay " + file + " --why " + std::to_string(a) + "," + std::to_string(b)).out;
      const bool contact = contains(out, "oracle: in contact at t = ");
      EXPECT_EQ(contains(out, "detector: reported"), contact) << out;
      EXPECT_EQ(contains(out, "detector: not reported"), !contact) << out;
      (contact ? met : apart) += 1;
    }
  }
  EXPECT_GT(met + apart, 1);
}

TEST(Replay, ExportedFramesAreTheCaseBitByBit) {
  const Scratch scratch;
  int collisions = 0;
  for (const std::string id : {"tiny:1:closed-generic:5", "tiny:1:closed-generic:7",
                               "tiny:1:broken:1", "tiny:1:closed-far-large-step:2"}) {
    SCOPED_TRACE(id);
    const std::string folder = scratch / id;
    const auto outcome = expect_ended("replay " + id + " --export " + folder, 0);
    EXPECT_TRUE(contains(outcome.out, "exported to " + folder)) << outcome.out;
    const auto c = value_of(corpus::read_case(folder + "/case.json"));
    for (std::size_t f = 0; f < c.frames.size(); ++f) {
      const auto frame =
          value_of(corpus::read_mesh(folder + "/frame_000" + std::to_string(f) + ".obj"));
      EXPECT_EQ(frame.positions, c.frames[f]);
      EXPECT_EQ(frame.triangles, c.triangles);
    }
    // check reads them and comes to the oracle's answer of the first step.
    const auto checked = run_assay("check " + folder + "/frame_0000.obj " + folder +
                                   "/frame_0001.obj --fail-on-collision");
    const bool collides =
        contains(outcome.out, "step 1 (frame 0 to 1, committed): oracle collision");
    EXPECT_EQ(checked.exit_code, collides ? 5 : 0) << checked.out << checked.err;
    collisions += collides;
    std::smatch time;
    const bool tells =
        std::regex_search(outcome.out, time, std::regex("oracle (collision at t = [^,]*), "));
    EXPECT_TRUE(!collides || !tells || contains(checked.out, time.str(1))) << checked.out;
  }
  EXPECT_GT(collisions, 0);
}

}  // namespace
}  // namespace assay::tests
