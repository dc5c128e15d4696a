// `check --body`: several meshes as bodies of one, which meet or do not.
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
  void SetUp() override {
    still = tetrahedron("still.obj", 0);
    comes = tetrahedron("c0.obj", 3) + " " + tetrahedron("c1.obj", 0.5);
  }
  const Scratch scratch;
  std::string still, comes;
};

TEST_F(CheckedBodies, MeetByDefault) {
  const auto outcome = run_assay("check --body " + still + " --body " + comes + " --json " +
                                 (scratch / "report.json"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "2 bodies: 8 triangles, 8 vertices, 2 components"))
      << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "detector and oracle agree")) << outcome.out;
  const auto report = json::parse(read_text(scratch / "report.json"));
  EXPECT_EQ(report["steps"][0]["answer"], "collision");
  EXPECT_EQ(report["files"].size(), 3u);
  EXPECT_EQ(report["bodies"], json::parse(R"([{"triangles": 4, "vertices": 4},
                                              {"triangles": 4, "vertices": 4}])"));
}

TEST_F(CheckedBodies, ApartDoNot) {
  const auto bodies = "check --body " + still + " --body " + comes;
  const auto outcome = run_assay(bodies + " --apart 1,0 --fail-on-collision");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "no collision; detector and oracle agree")) << outcome.out;
  // The oracle is asked for all pairs where other methods look at it.
  const auto second = run_assay(bodies + " --apart 1,0 --second-opinion 1");
  EXPECT_EQ(second.exit_code, 0) << second.out << second.err;
  // A plug-in that cannot be told is asked about all pairs, and says so.
  const auto plug_in = run_assay(bodies + " --apart 1,0 --detector " + plugin("wrapped_builtin"));
  EXPECT_EQ(plug_in.exit_code, 0) << plug_in.out << plug_in.err;
  EXPECT_TRUE(contains(plug_in.out, "it cannot be told which pairs count, so that all do"));
  EXPECT_TRUE(contains(plug_in.out, "collision at t ="));
  const auto told = run_assay(bodies + " --apart 1,0 --detector " + plugin("takes_relations"));
  EXPECT_EQ(told.exit_code, 0) << told.out << told.err;
  EXPECT_TRUE(contains(told.out, "no collision"));
}

TEST_F(CheckedBodies, NameTheTrianglesOfADefect) {
  const auto wrong = run_assay("check --body " + comes + " --body " + still + " --apart 0,1 " +
                                   "--detector " + plugin("takes_relations"),
                               "ASSAY_TAKES_RELATIONS=ignores ");
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out << wrong.err;
  EXPECT_TRUE(contains(wrong.out, " of body 0 and triangle ")) << wrong.out;
  EXPECT_TRUE(contains(wrong.out, " of body 1) at t = ")) << wrong.out;
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
  const auto missing = run_assay(two, "ASSAY_TEST_WRONG=0 ");
  EXPECT_EQ(missing.exit_code, 1) << missing.out << missing.err;
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
  std::string vertices, faces;
  int count = 0;
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    for (const int v : face) vertices += corners[v];
    faces += "f " + std::to_string(count + 1) + " " + std::to_string(count + 2) + " " +
             std::to_string(count + 3) + "\n";
    count += 3;
  }
  const auto soup = scratch.write("soup.obj", vertices + faces);
  const auto expect = [&](const std::string& options, int exit_code, const std::string& words) {
    const auto outcome = run_assay("check " + soup + " " + soup + options + " --fail-on-collision");
    EXPECT_EQ(outcome.exit_code, exit_code) << options << outcome.out << outcome.err;
    EXPECT_TRUE(contains(outcome.out + outcome.err, words)) << options << outcome.out;
  };
  expect("", 5,
         "12 vertices stand at 4 places: neighbours do not share their corners, so they touch");
  expect(" --weld", 0, "welded: 12 vertices stand at 4 places and count as 4");
  expect(" --weld --detector " + plugin("wrapped_builtin"), 0, "welded: 12 vertices");
  expect(" --weld --separation 0", 0, "welded: 12 vertices");
  expect(" --rest-distance 0.001", 0, "no collision");
  expect(" --rings 1", 5, "collision at t = 0");
  // Welded, all four faces have an edge in common.
  expect(" --weld --rings 1 --separation 0", 0, "no two triangles count");
  const auto of_a_case = run_assay("check corpus/curated/B1_one_vertex_own_nearest.json --weld");
  EXPECT_EQ(of_a_case.exit_code, 2);
  EXPECT_TRUE(contains(of_a_case.err, "a case file states what counts")) << of_a_case.err;
}

TEST_F(CheckedBodies, BadWordsAreOneLine) {
  const auto expect_refused = [&](const std::string& arguments, const std::string& why) {
    const auto refused = run_assay("check " + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_TRUE(contains(refused.err, why)) << refused.err;
  };
  expect_refused("", "FRAME is required");
  expect_refused(comes + " --apart 0,0", "--apart is of bodies");
  expect_refused(comes + " --body " + comes, "do not go together");
  expect_refused("--body " + comes + " --apart 0", "A,B: two bodies by number");
  expect_refused("--body " + comes + " --apart 0,3", "a pair of bodies names 3 of 1");
}

}  // namespace
}  // namespace assay::tests
