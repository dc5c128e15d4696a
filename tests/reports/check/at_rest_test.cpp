// `check` of meshes at rest on the command line, and the pairs in contact that it names.
#include "corpus/formats/mesh_reader.h"
#include "tests/reports/tiny_campaign.h"

namespace assay::tests {
namespace {

using nlohmann::json;

class AtRest : public testing::Test {
 protected:
  // A box from (x, y, z) with sides of this length, its normals outward. Its faces count their
  // corners from the last vertex, so that the texts of two boxes make one mesh.
  std::string box(const std::string& name, std::array<double, 3> from, double side) const {
    std::string text;
    for (int v = 0; v < 8; ++v) {
      text += "v";
      for (int k = 0; k < 3; ++k)
        text += " " + std::to_string(from[static_cast<std::size_t>(k)] + side * ((v >> k) & 1));
      text += "\n";
    }
    return scratch.write(name, text +
                                   "f -8 -6 -5\nf -8 -5 -7\nf -4 -3 -1\nf -4 -1 -2\n"
                                   "f -8 -7 -3\nf -8 -3 -4\nf -6 -2 -1\nf -6 -1 -5\n"
                                   "f -8 -4 -2\nf -8 -2 -6\nf -7 -5 -1\nf -7 -1 -3\n");
  }
  // A triangle in the plane z = 0, and one whose first corner is at this height above its inside.
  std::string pair(const std::string& name, const std::string& z) const {
    return scratch.write(
        name, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 2 " + z + "\nv 1 2 5\nv 2 2 5\nf 1 2 3\nf 4 5 6\n");
  }
  Outcome check(const std::string& arguments) const {
    return run_assay("check " + arguments + " --json " + (scratch / "r.json"));
  }
  json report() const { return read_json(scratch / "r.json"); }
  const Scratch scratch;
};

TEST_F(AtRest, OneFrameIsAskedWhetherItMeetsItself) {
  const auto meets =
      expect_ended(check(pair("crossing.obj", "-1")), 0,
                   {"2 components (2 unclosed); ", "at rest: collision, 1 pair in contact; agree\n",
                    "the mesh meets itself: 1 pair; detector and oracle agree\n"});
  EXPECT_FALSE(contains(meets.out, "t = ")) << meets.out;
  EXPECT_EQ(report()["at_rest"], true);
  EXPECT_EQ(report()["culling"], "bvh");
  check(pair("crossing.obj", "-1") + " --culling auto");
  EXPECT_EQ(report()["culling"], "auto");
  EXPECT_EQ(check(pair("crossing.obj", "-1") + " --fail-on-collision").exit_code, 5);

  expect_ended(check(pair("free.obj", "1") + " --fail-on-collision"), 0,
               {"the mesh does not meet itself; detector and oracle agree\n"});
  // The same frame twice is a motion, and its answer is the same.
  const auto twice = check(pair("crossing.obj", "-1") + " " + pair("again.obj", "-1"));
  EXPECT_TRUE(contains(twice.out, "collision at t = 0 of step 1")) << twice.out;
  EXPECT_EQ(report()["at_rest"], false);
}

TEST_F(AtRest, ACaseFileMayHaveOneFrame) {
  auto c = json::parse(read_text(curated("C5_start_intersecting")));
  for (const char* of_the_motion : {"view", "ghosts", "script", "counted"}) c.erase(of_the_motion);
  c["frames"] = json::array({c["frames"][0]});
  c["expected"] = json::parse(R"({"answer": "collision", "steps": []})");
  c["pending"] = json::object();
  const auto file = scratch.write("rest.json", c.dump());
  expect_ended(check(file), 0, {"the mesh meets itself: "});
  EXPECT_EQ(run_assay("replay " + file).exit_code, 0);
}

TEST_F(AtRest, APlugInIsJudgedToo) {
  const auto file = pair("crossing.obj", "-1");
  expect_ended(check(file + " --detector " + plugin("wrapped_builtin")), 0,
               {"the mesh meets itself: 1 pair; ", "  crossing: 1, touching: 0\n"});
  expect_ended(
      check(file + " --detector " + plugin("wrong_wrapper") + " --keep " + (scratch / "kept")), 1,
      {"the mesh meets itself: 1 pair; DEFECT"});
}

TEST_F(AtRest, BodiesAreNamed) {
  const auto crossing =
      expect_ended(check("--body " + box("a.obj", {0, 0, 0}, 2) + " --body " +
                         box("b.obj", {1, 1, 1}, 2) + " --body " + box("far.obj", {9, 9, 9}, 1)),
                   0);
  EXPECT_TRUE(std::regex_search(
      crossing.out, std::regex("\nbody 0 meets body 1: [0-9]+ pairs; detector and oracle agree")))
      << crossing.out;
  expect_says(crossing.out, {" (triangle 2 of body 0 and triangle ", ", crossing\n"});
  const auto contact = report()["steps"][0]["contacts"][0];
  EXPECT_EQ(contact["bodies"][1]["body"], 1);
  EXPECT_EQ(contact["bodies"][1]["triangle"], contact["triangles"][1].get<int>() - 12);
  EXPECT_TRUE(report()["inside"].empty());

  const auto apart =
      check("--body " + box("a.obj", {0, 0, 0}, 2) + " --body " + box("far.obj", {9, 9, 9}, 1));
  expect_says(apart.out, {"no body meets another or itself; detector and oracle agree"});
}

TEST_F(AtRest, ABodyInsideOfAnotherIsTold) {
  const auto bodies = "--body " + box("small.obj", {1, 1, 1}, 1) + " --body " +
                      box("big.obj", {0, 0, 0}, 4) + " --body " + box("far.obj", {5, 0, 0}, 1);
  const auto nested = check(bodies);
  expect_says(nested.out, {"body 0 lies inside body 1; their surfaces do not meet\n"});
  EXPECT_EQ(report()["inside"], json::parse(R"([{"body": 0, "of": 1}])"));
  EXPECT_FALSE(contains(nested.out, "body 2 lies")) << nested.out;
  // Of one file the components are told, too.
  const auto of_one = [](const std::string& file, const std::string& other) {
    return read_text(file) + read_text(other);
  };
  const auto both = scratch.write(
      "both.obj", of_one(box("big.obj", {0, 0, 0}, 4), box("small.obj", {1, 1, 1}, 1)));
  expect_says(check(both).out, {"  the component of triangle 12 lies inside the component of "
                                "triangle 0; their surfaces do not meet\n"});
  EXPECT_EQ(report()["inside"], json::parse(R"([{"component": 1, "of": 0}])"));
  // Of three, one in another, each is told with the one next around it.
  const auto three =
      scratch.write("three.obj", of_one(both, box("least.obj", {1.2, 1.2, 1.2}, 0.2)));
  check(three);
  EXPECT_EQ(report()["inside"],
            json::parse(R"([{"component": 1, "of": 0}, {"component": 2, "of": 1}])"));
  // An inside that is touched from within is met.
  const auto touched =
      check("--body " + box("small.obj", {0, 1, 1}, 1) + " --body " + box("big.obj", {0, 0, 0}, 4));
  EXPECT_FALSE(contains(touched.out, "lies inside")) << touched.out;
  expect_says(touched.out, {", touching\n", "  crossing: 0, touching: "});
  // A box without a lid holds nothing.
  auto open = read_text(scratch / "big.obj");
  open.resize(open.rfind("f "));
  const auto held = check("--body " + box("small.obj", {1, 1, 1}, 1) + " --body " +
                          scratch.write("open.obj", open));
  EXPECT_FALSE(contains(held.out, "lies inside")) << held.out;
  // One that moves about inside.
  const auto moving = check("--body " + box("big.obj", {0, 0, 0}, 4) + " --body " +
                            box("m0.obj", {1, 1, 1}, 1) + " " + box("m1.obj", {2, 2, 1}, 1));
  expect_says(moving.out, {"body 1 lies inside body 0 during this step; their"});
}

TEST_F(AtRest, WithinADistance) {
  const auto bodies =
      "--body " + box("a.obj", {0, 0, 0}, 2) + " --body " + box("b.obj", {2.5, 0, 0}, 1);
  const auto near =
      expect_ended(check(bodies + " --separation 0.5"), 0,
                   {"at rest: near, ", "  first: triangles ", " of body 0 and triangle "});
  EXPECT_TRUE(
      std::regex_search(near.out, std::regex("\nwithin 0.5: [0-9]+ pairs; least distance 0.5\n")))
      << near.out;
  EXPECT_FALSE(contains(near.out, "t = ")) << near.out;
  EXPECT_EQ(report()["at_rest"], true);
  EXPECT_EQ(report()["steps"][0]["least_at"]["bodies"][1]["body"], 1);
  EXPECT_TRUE(contains(check(bodies + " --separation 0.25").out,
                       "apart: nothing within 0.25; least distance 0.5\n"));
}

TEST_F(AtRest, ContactsOfAMotionAreNamedWithTheirPlaces) {
  const auto sinks = check(pair("0.obj", "1") + " " + pair("1.obj", "-1"));
  expect_says(sinks.out, {"  contact: triangles 0 and 1 at t = 0.5, vertex-face at (1, 2, 0), "
                          "touching; crossing at the end\n"});
  const auto contact = report()["steps"][0]["contacts"][0];
  EXPECT_EQ(contact["meeting"], "touching");
  EXPECT_EQ(contact["crosses_at_end"], true);
  EXPECT_EQ(contact["point"], json({1.0, 2.0, 0.0}));
  EXPECT_EQ(contact["barycentric"], json::parse("[[0.25, 0.25, 0.5], [1.0, 0.0, 0.0]]"));
  EXPECT_EQ(contact["normal"], json({0.0, 0.0, 1.0}));
  EXPECT_LE(contact["error"], 5 * 0x1p-48);
  EXPECT_LE(contact["normal_error"], 0x1p-44);
  EXPECT_TRUE(contains(check(pair("0.obj", "1") + " " + pair("1.obj", "0")).out,
                       "at t = 1, vertex-face at (1, 2, 0), touching; not crossing at the end\n"));
  EXPECT_TRUE(contains(check(pair("0.obj", "-1") + " " + pair("1.obj", "-1")).out,
                       " at t = 0, piercing at (1, 2, 0), crossing\n"));
}

// Ten are named, the earliest first; the others are counted. Those that meet first are asked for
// alone.
TEST_F(AtRest, TenContactsAreNamed) {
  const auto bodies = "--body " + box("a.obj", {0, 0, 0}, 2) + " --body " +
                      box("b.obj", {0, 0, 3}, 2) + " " + box("c.obj", {0, 0, -1}, 2);
  for (const auto* pairs : {" --pairs all", " --pairs first"}) {
    const auto outcome = check(bodies + pairs);
    const auto count = report()["steps"][0]["pairs"].size();
    EXPECT_EQ(report()["steps"][0]["contacts"].size(), count);
    EXPECT_EQ(count_of(outcome.out, "  contact: "), 10u) << outcome.out;
    expect_says(outcome.out, {fmt::format("  ... {} more pairs in contact", count - 10)});
  }
}

TEST_F(AtRest, TheMeshIsWrittenWithItsContactsInRed) {
  const auto file = scratch / "marked.ply";
  ASSERT_EQ(check(pair("0.obj", "1") + " " + pair("1.obj", "-1") + " --ply " + file).exit_code, 0);
  EXPECT_EQ(value_of(corpus::read_mesh(file)).positions(3, 2), 0) << "at the first contact";
  const auto bytes = read_text(file);
  EXPECT_TRUE(contains(bytes, "property uchar red\nproperty uchar green\nproperty uchar blue\n"));
  EXPECT_EQ(bytes.substr(bytes.size() - 3), "\xdc\x28\x28");
  ASSERT_EQ(check(pair("free.obj", "1") + " --ply " + file).exit_code, 0);
  EXPECT_EQ(read_text(file).substr(bytes.size() - 3), "\xc8\xc8\xc8");
  // At rest what only touches is amber, and a triangle that also crosses another is red.
  const auto touching = pair("touching.obj", "0");
  ASSERT_EQ(check(touching + " --ply " + file).exit_code, 0);
  EXPECT_EQ(read_text(file).substr(bytes.size() - 3), "\xf0\xb4\x28");
  auto three = read_text(touching) + "v 1 1 -1\nv 1 1 1\nv 2 1 1\nf 7 8 9\n";
  const auto both = check(scratch.write("both.obj", three) + " --ply " + file);
  const auto crossing = both.out.find(", crossing\n"), touched = both.out.find(", touching\n");
  ASSERT_NE(touched, std::string::npos) << both.out;
  EXPECT_LT(crossing, touched) << both.out << "those that cross come first";
  const auto colours = read_text(file);
  constexpr std::size_t face = 16;  // a byte, three numbers, three colours
  EXPECT_EQ(colours.substr(colours.size() - 2 * face - 3, 3), "\xdc\x28\x28");
  EXPECT_EQ(colours.substr(colours.size() - face - 3, 3), "\xf0\xb4\x28");
  EXPECT_EQ(colours.substr(colours.size() - 3), "\xdc\x28\x28");
  EXPECT_EQ(run_assay("check " + touching + " --ply " + (scratch / "marked.vtu")).exit_code, 2);
  const auto own = pair("own.obj", "1");
  EXPECT_EQ(run_assay("check " + own + " --ply " + own).exit_code, 2) << "the input stays";
}

}  // namespace
}  // namespace assay::tests
