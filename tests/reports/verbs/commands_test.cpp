// The verbs that make and check scenes, on the command line: output, exit codes, JSON.
#include <fmt/format.h>

#include "corpus/scenes/scenes.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

class Commands : public testing::Test {
 protected:
  std::string make_scene(const std::string& name, int size, int frames) const {
    return tests::make_scene(scratch, name, size, frames);
  }
  auto report() const { return read_json(scratch / "r.json"); }
  const Scratch scratch;
};

TEST_F(Commands, L5_BreathingSphereIsFreeAllPositiveWithoutBoxTests) {
  const auto frames = make_scene("breathing-sphere", 1280, 6);
  for (const std::string culling : {"view-point", "view-line"}) {
    expect_ended("check " + frames + " --culling " + culling + " --json " + (scratch / "r.json"), 0,
                 {"no collision; detector and oracle agree"});
    const auto written = report();
    EXPECT_EQ(written["schema"], "assay-check/1");
    ASSERT_EQ(written["steps"].size(), 5u);
    for (const auto& step : written["steps"]) {
      EXPECT_EQ(step["answer"], "free");
      EXPECT_EQ(step["first_time"], nullptr);
      EXPECT_EQ(step["view_positive"], written["triangles"]);
      EXPECT_EQ(step["box_tests"], 0);
      EXPECT_EQ(step["diff"]["outcome"], "holds");
    }
  }
}

TEST_F(Commands, EverySceneAgreesAndSaysWhetherItCollides) {
  const auto free = words(
                 "breathing-sphere two-spheres twist open-tube arm-in-box ball-in-tube "
                 "inverted-sleeve crossing-fans winding-spiral"),
             colliding = words(
                 "dented-sphere bend pinching-torus folding-sheet crumpling-sphere layered-cloth "
                 "pile-of-bodies tightening-knot combed-hair");
  ASSERT_EQ(free.size() + colliding.size(), corpus::scenes().size());
  for (const auto& scene : corpus::scenes()) {
    const std::string name(scene.name);
    SCOPED_TRACE(name);
    const bool collides = std::count(colliding.begin(), colliding.end(), name) > 0;
    ASSERT_TRUE(collides || std::count(free.begin(), free.end(), name) > 0);
    expect_ended(
        "check " + make_scene(name, 500, std::max(8, scene.least_frames)) + " --fail-on-collision",
        collides ? 5 : 0, {"detector and oracle agree"});
  }
}

TEST_F(Commands, ReportHoldsWhatGhostsAndReleaseCost) {
  const auto frames = make_scene("arm-in-box", 800, 31);
  expect_ended(
      "check " + frames + " --culling view-auto --no-oracle --json " + (scratch / "r.json"), 0);
  const auto steps = report()["steps"];
  int in_doubt = 0, released = 0, pairs = 0;
  for (const auto& step : steps) {
    const auto &ghosts = step["ghosts"], &release = step["release"];
    EXPECT_GE(ghosts["near_triangles"], step["violated"]);
    EXPECT_LE(ghosts["near_triangles"], ghosts["pairs"]);
    EXPECT_EQ(release["in_doubt"].get<int>() - release["released"].get<int>(), step["dirty"]);
    in_doubt += release["in_doubt"].get<int>();
    released += release["released"].get<int>();
    pairs += release["pairs"].get<int>();
  }
  EXPECT_GT(in_doubt, released);
  EXPECT_GT(released, 0);
  EXPECT_GT(pairs, 0);
  EXPECT_EQ(steps.back()["dirty"], 0);
}

TEST_F(Commands, ReportHoldsTheContactsAndTimes) {
  const auto frames = make_scene("folding-sheet", 200, 6);
  expect_ended("check " + frames + " --json " + (scratch / "r.json"), 0, {"  ms:   create "});
  const auto written = report();
  EXPECT_GT(written["times_ms"]["create"], 0);
  bool collided = false;
  for (const auto& step : written["steps"]) {
    if (step["answer"] != "collision") continue;
    collided = true;
    EXPECT_EQ(step["pairs"].size(), step["oracle"]["pairs"]);
    EXPECT_EQ(step["first_time"], step["oracle"]["first_time"]);
    for (const auto& pair : step["pairs"]) {
      EXPECT_GE(pair["time"][0], step["first_time"][0]);
      EXPECT_LT(pair["triangles"][0], pair["triangles"][1]);
    }
  }
  EXPECT_TRUE(collided);
}

TEST_F(Commands, WithoutAnOracleNothingIsJudged) {
  const auto outcome =
      expect_ended("check " + make_scene("bend", 300, 3) + " --no-oracle", 0, {"not judged"});
  EXPECT_FALSE(says(outcome.out, "agree"));
}

TEST_F(Commands, LimitsEndInUndecided) {
  const auto frames = make_scene("crumpling-sphere", 5000, 3);
  for (const std::string limit : {"--time 0.000001", "--memory 1KB"}) {
    SCOPED_TRACE(limit);
    expect_ended("check " + frames + " " + limit + " --json " + (scratch / "r.json"), 3,
                 {"undecided"});
    EXPECT_EQ(report()["outcome"], "undecided");
    EXPECT_TRUE(report()["limit_reached"].is_string());
    EXPECT_EQ(report()["steps"].back()["diff"]["partial"], true);
  }
}

// The limit holds while the detector is made, too, which takes longer than a short limit. The
// least of three times is compared, because other programs may delay one.
TEST_F(Commands, ALimitOfTimeEndsCreating) {
  const auto frames = make_scene("breathing-sphere", 40'000, 2);
  const auto create_ms = [&](const std::string& limit) {
    run_assay("check --no-oracle --culling view-line " + frames + limit + " --json " +
              (scratch / "r.json"));
    return report()["times_ms"]["create"].get<double>();
  };
  const std::string limit = " --time 0.000001";
  EXPECT_LT(std::min({create_ms(limit), create_ms(limit), create_ms(limit)}), create_ms("") / 3);
}

TEST_F(Commands, ALimitOfMemoryIsReadInEveryUnit) {
  const std::string check = "check --no-oracle " + make_scene("bend", 100, 2) + " --memory ";
  for (const auto& size : words("8G 8GB 900M 900MB 900000K 900000KB 999999999B 999999999"))
    EXPECT_EQ(run_assay(check + size).exit_code, 0) << size;
  expect_problem(run_assay(check + "8X"), "a whole number above 0, perhaps with K, M or G");
}

// What lies upon each other makes M^2 / 2 pairs: far more than the limit holds. The caller's thread
// alone is asked whether to stop, so others may go on a little beyond the limit: here there are
// none.
TEST_F(Commands, TheLimitOfMemoryHolds) {
  constexpr int count = 2000;
  std::string mesh = fmt::format("OFF\n{} {} 0\n", 3 * count, count);
  for (int i = 0; i < count; ++i) mesh += "0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < count; ++i) mesh += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  const auto a = scratch.write("a.off", mesh), b = scratch.write("b.off", mesh);
  expect_ended("check --no-oracle --threads 1 --memory 30M --json " + (scratch / "r.json") + " " +
                   a + " " + b,
               3);
  EXPECT_EQ(report()["limit_reached"], "memory limit of 30 MiB");
  EXPECT_LE(report()["peak_memory_bytes"].get<double>(), 1.05 * (30 << 20));
  EXPECT_EQ(report()["steps"][0]["answer"], "undecided");
  EXPECT_TRUE(report()["steps"][0]["pairs"].empty());
}

TEST_F(Commands, ResultDoesNotDependOnJobs) {
  const auto frames = make_scene("crumpling-sphere", 1000, 4);
  const auto without_times = [&](const std::string& jobs) {
    expect_ended("check " + frames + " --jobs " + jobs + " --json " + (scratch / "r.json"), 0);
    auto written = report();
    written.erase("peak_memory_bytes"), written.erase("times_ms");
    for (auto& step : written["steps"]) step.erase("times_ms"), step["oracle"].erase("time_ms");
    return written;
  };
  EXPECT_EQ(without_times("1"), without_times("3"));
}

TEST_F(Commands, CaseFilesAreChecked) {
  expect_ended("check " + curated("B1_one_vertex_own_nearest"), 0, {"collision at t = 0.91509"});
  // With facts that do not hold.
  auto text = read_text(curated("A4_endpoints_only"));
  for (std::size_t at; (at = text.find("\"collision\"")) != std::string::npos;)
    text.replace(at, 11, "\"free\"");
  expect_ended("check " + scratch.write("wrong.json", text), 1, {"expected facts"});
}

TEST_F(Commands, QueriesAreScored) {
  for (const std::string method : {"oracle", "detector-exact"}) {
    expect_ended(
        "check " + example_queries() + " --method " + method + " --json " + (scratch / "r.json"),
        0);
    EXPECT_EQ(report()["schema"], "assay-queries/1");
    EXPECT_EQ(report()["count"], 5);
    EXPECT_EQ(report()["yes"], 3);
  }
  std::string wrong = read_text(example_queries());
  for (std::size_t at = 0; (at = wrong.find(",1\n", at)) != std::string::npos; at += 3)
    wrong.replace(at, 3, ",0\n");
  expect_ended("check " + scratch.write("wrong_vf.csv", wrong), 1,
               {"2 false positives, 0 false negatives, 1 disputed"});
}

TEST_F(Commands, SceneFromAMeshAndBack) {
  const auto frames = make_scene("breathing-sphere", 320, 2);
  const auto mesh = scratch / "breathing-sphere/frame_0000.ply";
  expect_ended("scene bend --mesh " + mesh + " --frames 4 --out " + (scratch / "bent"), 0,
               {"/assay check"});
  EXPECT_EQ(run_assay("check " + (scratch / "bent") + "/frame_*.ply").exit_code, 0);
}

}  // namespace
}  // namespace assay::tests
