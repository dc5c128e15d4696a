// assay check --separation, as a user runs it: two triangles whose distance is known.
#include "tests/reports/program.h"

namespace assay::tests {
namespace {

using nlohmann::json;

// A triangle at rest in the plane z = 0 and one above it, whose corner moves from z = 3 to z = 1
// above the inside of the first; its other two corners are at z = 4.
class SeparationCommand : public testing::Test {
 protected:
  std::string frame(const std::string& name, const std::string& z) {
    return scratch.write(
        name, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 " + z + "\nv 2 1 4\nv 1 2 4\nf 1 2 3\nf 4 5 6\n");
  }
  Outcome check(const std::string& options) {
    return run_assay("check " + frame("a.obj", "3") + " " + frame("b.obj", "1") + " " + options);
  }
  const Scratch scratch;
};

TEST_F(SeparationCommand, SaysWhenFirstAndHowNear) {
  const auto near = check("--separation 2 --json " + (scratch / "r.json"));
  EXPECT_EQ(near.exit_code, 0) << near.err;
  EXPECT_TRUE(says(near.out, "step 1: near at t = 0.5, 1 pair\n"));
  EXPECT_TRUE(says(near.out, "least distance 1: triangles 0 and 1 at t = 1 (vertex-face)"));
  EXPECT_TRUE(says(near.out, "near at t = 0.5 of step 1; least distance 1\n"));
  const auto report = json::parse(read_text(scratch / "r.json"));
  EXPECT_EQ(report["separation"], 2.0);
  EXPECT_EQ(report["outcome"], "near");
  const auto& step = report["steps"][0];
  EXPECT_EQ(step["answer"], "near");
  EXPECT_EQ(step["first_time"], json::array({0.5, 0.5}));
  EXPECT_EQ(step["near_at_start"], 0);
  EXPECT_EQ(step["least_distance"], 1.0);
  EXPECT_EQ(step["pairs"].size(), 1u);
}

TEST_F(SeparationCommand, TellsADistanceFromTheDoubleBelowIt) {
  EXPECT_TRUE(says(check("--separation 1").out, "near at t = 1 of step 1"));
  EXPECT_TRUE(says(check("--separation 0.9999999999999999").out,
                   "apart: never within 0.9999999999999999; least distance 1\n"));
  EXPECT_TRUE(says(check("--separation 3").out, "1 near at the start"));
}

TEST_F(SeparationCommand, TheExitCodeSaysWhatIsAskedFor) {
  EXPECT_EQ(check("--separation 2 --fail-on-collision").exit_code, 5);
  EXPECT_EQ(check("--separation 0.5 --fail-on-collision").exit_code, 0);
  for (const char* wrong :
       {"--separation -1", "--separation nan", "--separation 1e999", "--separation x",
        "--separation 1 --culling bvh", "--separation 1 --no-oracle"}) {
    const auto outcome = check(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
}  // namespace assay::tests
