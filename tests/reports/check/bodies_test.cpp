// `check --body`: several meshes become the bodies of one mesh, and meet or do not meet.
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using nlohmann::json;

class CheckedBodies : public testing::Test {
 protected:
  // A tetrahedron whose corner is here.
  std::string tetrahedron(const std::string& name, double x) const {
    const auto corner = [x](double dx, double y, double z) {
      return "v " + std::to_string(x + dx) + " " + std::to_string(y) + " " + std::to_string(z) +
             "\n";
    };
    return scratch.write(name, corner(0, 0, 0) + corner(1, 0, 0) + corner(0, 1, 0) +
                                   corner(0, 0, 1) + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  }
  const Scratch scratch;
  const std::string still = tetrahedron("still.obj", 0),
                    comes = tetrahedron("c0.obj", 3) + " " + tetrahedron("c1.obj", 0.5);
};

TEST_F(CheckedBodies, MeetByDefault) {
  expect_ended(
      "check --body " + still + " --body " + comes + " --json " + (scratch / "report.json"), 0,
      {"2 bodies: 8 triangles, 8 vertices, 2 components", "detector and oracle agree"});
  const auto report = json::parse(read_text(scratch / "report.json"));
  EXPECT_EQ(report["steps"][0]["answer"], "collision");
  EXPECT_EQ(report["files"].size(), 3u);
  EXPECT_EQ(report["bodies"], json::parse(R"([{"triangles": 4, "vertices": 4},
                                              {"triangles": 4, "vertices": 4}])"));
}

TEST_F(CheckedBodies, ApartDoNot) {
  const auto bodies = "check --body " + still + " --body " + comes;
  expect_ended(bodies + " --apart 1,0 --fail-on-collision", 0,
               {"no collision; detector and oracle agree"});
  // The oracle is asked for all pairs where other methods look at it.
  expect_ended(bodies + " --apart 1,0 --second-opinion 1", 0);
  // A plug-in that cannot be told is asked about all pairs, and says so.
  expect_ended(bodies + " --apart 1,0 --detector " + plugin("wrapped_builtin"), 0,
               {"has no function `count`, so all pairs count", "collision at t ="});
  expect_ended(bodies + " --apart 1,0 --detector " + plugin("takes_relations"), 0,
               {"no collision"});
}

TEST_F(CheckedBodies, NameTheTrianglesOfADefect) {
  expect_ended(run_assay("check --body " + comes + " --body " + still + " --apart 0,1 " +
                             "--detector " + plugin("takes_relations"),
                         "ASSAY_TAKES_RELATIONS=ignores "),
               1, {" of body 0 and triangle ", " of body 1) at t = "});
}

// A detector that cannot be told of bodies has its failures named by them all the same.
TEST_F(CheckedBodies, NameWhatAnyDetectorMissesOrHasLate) {
  const auto two = "check --body " + still + " --body " + comes + " --detector " +
                   plugin("wrong_wrapper") + " --keep " + (scratch / "kept") + " --json " +
                   (scratch / "r.json");
  const std::string named = " \\(triangle [0-3] of body 0 and triangle [0-3] of body 1\\)";
  const auto is_named = [&](const std::string& text, const std::string& before) {
    return std::regex_search(text, std::regex(before + "triangles [0-3] and [4-7]" + named));
  };
  const auto missing = expect_ended(run_assay(two, "ASSAY_TEST_WRONG=0 "), 1);
  EXPECT_TRUE(is_named(missing.out, "  missing: ")) << missing.out;
  EXPECT_TRUE(is_named(missing.out, "  contact: ")) << missing.out;
  EXPECT_TRUE(std::regex_search(read_text(scratch / "kept/step-1/case.json"), std::regex(named)));
  const auto report = json::parse(read_text(scratch / "r.json"));
  EXPECT_EQ(report["steps"][0]["diff"]["missing"][0]["bodies"][1]["body"], 1);
  EXPECT_EQ(report["bodies"].size(), 2u);
  const auto late = run_assay(two, "ASSAY_TEST_WRONG=2 ");
  EXPECT_TRUE(is_named(late.out, "  late: ")) << late.out;
  const auto spurious = run_assay(two, "ASSAY_TEST_WRONG=8 ");
  EXPECT_TRUE(std::regex_search(spurious.out, std::regex("  spurious: .* of body ")))
      << spurious.out;
}

// A soup: each triangle has three vertices of its own.
TEST_F(CheckedBodies, DoubledCornersAreToldAndLeftOut) {
  const std::string corners[] = {"v 0 0 0\n", "v 1 0 0\n", "v 0 1 0\n", "v 0 0 1\n"};
  std::string faces;
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    for (const int v : face) faces += corners[v];
    faces += "f -3 -2 -1\n";
  }
  const auto soup = scratch.write("soup.obj", faces);
  const auto expect = [&](const std::string& options, int exit_code, const std::string& words) {
    const auto outcome = run_assay("check " + soup + " " + soup + options + " --fail-on-collision");
    EXPECT_EQ(outcome.exit_code, exit_code) << options << outcome.out << outcome.err;
    EXPECT_TRUE(contains(outcome.out + outcome.err, words)) << options << outcome.out;
  };
  expect("", 5, "12 vertices are at 4 places: neighbouring triangles share none, so they touch");
  expect(" --weld", 0, "welded: 12 vertices are at 4 places and count as 4 vertices");
  expect(" --weld --detector " + plugin("wrapped_builtin"), 0, "welded: 12 vertices");
  expect(" --weld --separation 0", 0, "welded: 12 vertices");
  expect(" --rest-distance 0.001", 0, "no collision");
  expect(" --rings 1", 5, "collision at t = 0");
  // Welded, all four faces have an edge in common.
  expect(" --weld --rings 1 --separation 0", 0, "least distance: none: no pair counts");
}

TEST_F(CheckedBodies, BadWordsAreOneLine) {
  expect_problem(run_assay("check "), "INPUT is required");
  expect_problem(run_assay("check --body " + comes + " --apart 0"), "A,B: two bodies by number");
}

}  // namespace
}  // namespace assay::tests
