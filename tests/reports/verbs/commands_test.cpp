// The verbs on scenes, as a user runs them: output, exit codes, JSON.
#include <fmt/format.h>

#include "corpus/scenes/scenes.h"
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using nlohmann::json;

class Commands : public testing::Test {
 protected:
  std::string make_scene(const std::string& name, int size, int frames) {
    const std::string folder = scratch / name;
    expect_ended("scene " + name + " --size " + std::to_string(size) + " --frames " +
                     std::to_string(frames) + " --out " + folder,
                 0);
    return folder + "/frame_*.ply";
  }
  const Scratch scratch;
};

TEST_F(Commands, L5_BreathingSphereIsFreeAllPositiveWithoutBoxTests) {
  const auto frames = make_scene("breathing-sphere", 1280, 6);
  for (const std::string culling : {"view-point", "view-line"}) {
    expect_ended(
        "check " + frames + " --culling " + culling + " --json " + (scratch / "report.json"), 0,
        {"no collision; detector and oracle agree"});
    const auto report = json::parse(read_text(scratch / "report.json"));
    EXPECT_EQ(report["schema"], "assay-check/1");
    ASSERT_EQ(report["steps"].size(), 5u);
    for (const auto& step : report["steps"]) {
      EXPECT_EQ(step["answer"], "free");
      EXPECT_EQ(step["first_time"], nullptr);
      EXPECT_EQ(step["view_positive"], report["triangles"]);
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
  const auto outcome = expect_ended(
      "check " + frames + " --culling view-auto --no-oracle --json " + (scratch / "r.json"), 0);
  const auto report = json::parse(read_text(scratch / "r.json"));
  int in_doubt = 0, released = 0, pairs = 0;
  for (const auto& step : report["steps"]) {
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
  EXPECT_EQ(report["steps"].back()["dirty"], 0);
}

TEST_F(Commands, ReportHoldsTheContactsAndTimes) {
  const auto frames = make_scene("folding-sheet", 200, 6);
  const auto outcome = expect_ended("check " + frames + " --json " + (scratch / "r.json"), 0);
  const auto report = json::parse(read_text(scratch / "r.json"));
  EXPECT_GT(report["times_ms"]["create"], 0);
  EXPECT_NE(outcome.out.find("  ms:   create "), std::string::npos);
  bool collided = false;
  for (const auto& step : report["steps"]) {
    if (step["answer"] != "collision") continue;
    collided = true;
    EXPECT_EQ(step["pairs"].size(), step["oracle"]["pairs"]);
    EXPECT_EQ(step["first_time"], step["oracle"]["first_time"]);
    for (const auto& pair : step["pairs"]) {
      EXPECT_GE(pair["time"][0], step["first_time"][0]);
      EXPECT_LT(pair["triangles"][0], pair["triangles"][1]);
    }
    for (const char* key :
         {"view_positive", "view_negative", "view_zero", "violated", "dirty", "box_tests",
          "candidate_pairs", "elementary_tests", "closure_rounds", "times_ms"}) {
      EXPECT_TRUE(step.contains(key)) << key;
    }
  }
  EXPECT_TRUE(collided);
}

TEST_F(Commands, WithoutAnOracleNothingIsJudged) {
  const auto outcome =
      expect_ended("check " + make_scene("bend", 300, 3) + " --no-oracle", 0, {"not judged"});
  EXPECT_EQ(outcome.out.find("agree"), std::string::npos);
}

TEST_F(Commands, LimitsEndInUndecided) {
  const auto frames = make_scene("crumpling-sphere", 5000, 3);
  for (const std::string limit : {"--time 0.000001", "--memory 1KB"}) {
    SCOPED_TRACE(limit);
    expect_ended("check " + frames + " " + limit + " --json " + (scratch / "u.json"), 3,
                 {"undecided"});
    const auto report = json::parse(read_text(scratch / "u.json"));
    EXPECT_EQ(report["outcome"], "undecided");
    EXPECT_TRUE(report["limit_reached"].is_string());
    EXPECT_EQ(report["steps"].back()["diff"]["partial"], true);
  }
}

// The limit holds while the detector is made, too, which takes longer than a short limit. The
// least of three times is compared, because other programs may delay one.
TEST_F(Commands, ALimitOfTimeEndsCreating) {
  const auto frames = make_scene("breathing-sphere", 40'000, 2);
  const auto create_ms = [&](const std::string& limit) {
    run_assay("check --no-oracle --culling view-line " + frames + limit + " --json " +
              (scratch / "c.json"));
    return json::parse(read_text(scratch / "c.json"))["times_ms"]["create"].get<double>();
  };
  const std::string limit = " --time 0.000001";
  EXPECT_LT(std::min({create_ms(limit), create_ms(limit), create_ms(limit)}), create_ms("") / 3);
}

TEST_F(Commands, ALimitOfMemoryIsReadInEveryUnit) {
  const std::string check = "check --no-oracle " + make_scene("bend", 100, 2) + " --memory ";
  for (const std::string size :
       {"8G", "8GB", "900M", "900MB", "900000K", "900000KB", "999999999B", "999999999"})
    EXPECT_EQ(run_assay(check + size).exit_code, 0) << size;
  expect_problem(run_assay(check + "8X"), "a whole number above 0, alone or with K, M or G");
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
  expect_ended("check --no-oracle --threads 1 --memory 30M --json " + (scratch / "m.json") + " " +
                   a + " " + b,
               3);
  const auto report = json::parse(read_text(scratch / "m.json"));
  EXPECT_EQ(report["limit_reached"], "memory limit of 30 MiB");
  EXPECT_LE(report["peak_memory_bytes"].get<double>(), 1.05 * (30 << 20));
  EXPECT_EQ(report["steps"][0]["answer"], "undecided");
  EXPECT_TRUE(report["steps"][0]["pairs"].empty());
}

TEST_F(Commands, ResultDoesNotDependOnJobs) {
  const auto frames = make_scene("crumpling-sphere", 1000, 4);
  const auto without_times = [&](const std::string& jobs) {
    expect_ended("check " + frames + " --jobs " + jobs + " --json " + (scratch / "j.json"), 0);
    auto report = json::parse(read_text(scratch / "j.json"));
    report.erase("peak_memory_bytes");
    report.erase("times_ms");
    for (auto& step : report["steps"]) {
      step.erase("times_ms");
      step["oracle"].erase("time_ms");
    }
    return report;
  };
  EXPECT_EQ(without_times("1"), without_times("3"));
}

TEST_F(Commands, CaseFilesAreChecked) {
  const std::string cases = std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/";
  expect_ended("check " + cases + "B1_one_vertex_own_nearest.json", 0,
               {"collision at t = 0.91509"});
}

TEST_F(Commands, ACaseWhoseFactsDoNotHoldIsADefect) {
  std::string text =
      read_text(std::string(ASSAY_SOURCE_DIR) + "/corpus/curated/A4_endpoints_only.json");
  for (std::size_t at; (at = text.find("\"collision\"")) != std::string::npos;)
    text.replace(at, 11, "\"free\"");
  expect_ended("check " + scratch.write("wrong.json", text), 1, {"expected facts"});
}

TEST_F(Commands, QueriesAreScored) {
  const std::string queries = std::string(ASSAY_SOURCE_DIR) + "/corpus/queries/example_vf.csv";
  for (const std::string method : {"oracle", "detector-exact"}) {
    expect_ended("check " + queries + " --method " + method + " --json " + (scratch / "q.json"), 0);
    const auto report = json::parse(read_text(scratch / "q.json"));
    EXPECT_EQ(report["schema"], "assay-queries/1");
    EXPECT_EQ(report["count"], 5);
    EXPECT_EQ(report["yes"], 3);
  }
  std::string wrong = read_text(queries);
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

TEST_F(Commands, VersionNamesTheLibraries) {
  expect_ended(
      "--version", 0,
      {"assay 0.", "CGAL 5", "GMP ", "MPFR ", "MPFI ", "Eigen 3", "Boost 1", "fmt ", "CLI11 "});
}

TEST_F(Commands, ListNamesEveryScene) { expect_ended("list scenes", 0, {"arm-in-box"}); }

}  // namespace
}  // namespace assay::tests
