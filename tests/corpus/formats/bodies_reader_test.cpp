// Several meshes as bodies of one: frames in step, vertices and triangles behind each other.
#include "corpus/formats/sequence_reader.h"
#include "corpus/formats/step_source.h"
#include "tests/corpus/scratch.h"

namespace assay::corpus {
namespace {

using Bodies = std::vector<std::vector<std::filesystem::path>>;

class BodiesOfFiles : public Scratch {
 protected:
  // A triangle at this height.
  std::filesystem::path triangle(const std::string& name, int z) const {
    const auto height = " " + std::to_string(z) + "\n";
    return write(name, "v 0 0" + height + "v 1 0" + height + "v 0 1" + height + "f 1 2 3\n");
  }
};

TEST_F(BodiesOfFiles, FollowEachOther) {
  const BodyFiles bodies = {{{triangle("a0.obj", 0), triangle("a1.obj", 1)},
                             {triangle("b0.obj", 5), triangle("b1.obj", 6)}},
                            {{1, 1}}};
  const auto steps = steps_of_bodies(bodies);
  ASSERT_TRUE(steps) << steps.error().message;
  auto& source = *steps.value();
  EXPECT_EQ(source.count(), 1u);
  detector::Triangles expected(2, 3);
  expected << 0, 1, 2, 3, 4, 5;
  EXPECT_EQ(source.triangles(), expected);
  ASSERT_TRUE(source.counted());
  EXPECT_EQ(source.counted()->body, (std::vector<std::int32_t>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(source.counted()->apart, bodies.apart);
  const auto step = source.step(0);
  ASSERT_TRUE(step);
  EXPECT_EQ(step.value().x_t0(3, 2), 5);
  EXPECT_EQ(step.value().x_t1(0, 2), 1);
  EXPECT_EQ(step.value().x_t1(5, 2), 6);
}

TEST_F(BodiesOfFiles, OneFrameStandsStill) {
  const BodyFiles bodies = {{{triangle("still.obj", 3)},
                             {triangle("0.obj", 0), triangle("1.obj", 1), triangle("2.obj", 2)}},
                            {}};
  auto steps = steps_of_bodies(bodies);
  ASSERT_TRUE(steps) << steps.error().message;
  auto whole = steps.value()->read_whole();
  ASSERT_TRUE(whole);
  const auto c = whole.value()->whole();
  ASSERT_EQ(c->frames.size(), 3u);
  ASSERT_TRUE(c->counted);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(c->frames[f](0, 2), 3);
    EXPECT_EQ(c->frames[f](3, 2), static_cast<double>(f));
  }
}

// One frame of each body, and one mesh alone, are at rest: a step that ends where it starts.
TEST_F(BodiesOfFiles, OneFrameOfAllIsAtRest) {
  for (const BodyFiles& bodies : {BodyFiles{{{triangle("a.obj", 3)}, {triangle("b.obj", 4)}}, {}},
                                  BodyFiles{{{triangle("a.obj", 3)}}, {}}}) {
    auto steps = steps_of_bodies(bodies);
    ASSERT_TRUE(steps) << steps.error().message;
    EXPECT_TRUE(steps.value()->is_at_rest());
    ASSERT_EQ(steps.value()->count(), 1u);
    const auto step = steps.value()->step(0);
    ASSERT_TRUE(step);
    EXPECT_EQ(step.value().x_t0, step.value().x_t1);
    EXPECT_EQ(step.value().x_t1(0, 2), 3);
    const auto whole = steps.value()->read_whole();
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole.value()->whole()->frames.size(), 1u);
    EXPECT_EQ(whole.value()->count(), 1u);
  }
}

TEST_F(BodiesOfFiles, OneMeshAloneHasNoRelation) {
  const auto steps = steps_of_files({triangle("0.obj", 0), triangle("1.obj", 1)});
  ASSERT_TRUE(steps);
  EXPECT_EQ(steps.value()->counted(), nullptr);
}

TEST_F(BodiesOfFiles, AreToldInWords) {
  const auto one = triangle("f1.obj", 1), two = triangle("f2.obj", 2), ten = triangle("f10.obj", 9);
  const auto text_of = [](const Bodies& frames) {
    const auto steps = steps_of_bodies({frames, {}});
    EXPECT_TRUE(steps) << steps.error().message;
    return steps ? steps.value()->text() : InputText();
  };
  EXPECT_EQ(text_of({{one, two}}).title, "one mesh moving from f1.obj to f2.obj");
  EXPECT_EQ(text_of({{one, one}}).title, "one mesh at rest");
  const auto in_order = text_of({{one, ten, two}});
  EXPECT_EQ(in_order.title, "one mesh moving through 3 frames from f1.obj to f10.obj");
  EXPECT_EQ(in_order.files, (std::vector{one.string(), two.string(), ten.string()}));
  const auto two_bodies = text_of({{one, ten, two}, {two, one, one}});
  EXPECT_EQ(two_bodies.title, "2 bodies");
  EXPECT_EQ(two_bodies.files.size(), 6u);
  ASSERT_EQ(two_bodies.remarks.size(), 3u);
  EXPECT_NE(two_bodies.remarks[2].find("as given"), std::string::npos) << two_bodies.remarks[2];
  // The words outlive the reader of the files.
  auto steps = steps_of_files({one, ten, two});
  const auto whole = steps.value()->read_whole();
  EXPECT_EQ(whole.value()->text().remarks, in_order.remarks);
  EXPECT_EQ(whole.value()->whole()->frames[1](0, 2), 2);
}

// Two triangles that share an edge, and no vertex. At t = 1 the fourth vertex is `gap` beside the
// second one.
class DoubledCornersOfFiles : public BodiesOfFiles {
 protected:
  std::filesystem::path seam(const std::string& name, const std::string& gap) const {
    return write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 " + gap +
                           "\nv -0 1 -0\nv 1 1 0\nv 0 0 0\nf 1 2 3\nf 4 6 5\n");
  }
  std::string last_remark(const BodyFiles& files) const {
    const auto steps = steps_of_bodies(files);
    if (!steps) return steps.error().message;
    const auto text = steps.value()->text();
    return text.remarks.empty() ? "" : text.remarks.back();
  }
};

TEST_F(DoubledCornersOfFiles, AreToldAndWelded) {
  const auto a = seam("a.obj", "0"), b = seam("b.obj", "0"), apart = seam("c.obj", "1e-300");
  EXPECT_NE(last_remark({{{a, b}}}).find("4 vertices stand at 2 places: neighbours do not share"),
            std::string::npos);
  EXPECT_NE(last_remark({{{a, apart}}}).find("2 vertices stand at 1 place: "), std::string::npos);
  BodyFiles welded{{{a, b}}};
  welded.weld = true;
  EXPECT_NE(last_remark(welded).find("welded: 4 vertices stand at 2 places and count as 2"),
            std::string::npos);
  detector::Triangles shared(2, 3), one_apart(2, 3);
  shared << 0, 1, 2, 1, 5, 2;
  one_apart << 0, 1, 2, 3, 5, 2;
  EXPECT_EQ(steps_of_bodies(welded).value()->triangles(), shared);
  // A frame far behind counts, too; and the mesh as a whole is the same.
  welded.frames = {{a, b, b, apart}};
  EXPECT_EQ(steps_of_bodies(welded).value()->triangles(), one_apart);
  EXPECT_EQ(steps_of_bodies(welded).value()->read_whole().value()->triangles(), one_apart);
  // Bodies are not welded to each other.
  welded.frames = {{a, b}, {a, b}};
  EXPECT_EQ(steps_of_bodies(welded).value()->triangles().bottomRows(2),
            (shared.array() + 7).matrix());
  // What has no corner in common is not told.
  EXPECT_EQ(last_remark({{{triangle("0.obj", 0), triangle("1.obj", 1)}}}), "");
}

TEST_F(DoubledCornersOfFiles, ThatCollapseATriangleAreRefused) {
  const auto thin = write("thin.obj", "v 0 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n");
  BodyFiles files{{{thin, thin}}};
  files.weld = true;
  EXPECT_NE(last_remark(files).find("--weld: triangle 0 "), std::string::npos)
      << last_remark(files);
}

TEST_F(DoubledCornersOfFiles, RingsAndDistanceAtRestAreARelation) {
  const auto a = seam("a.obj", "0"), b = seam("b.obj", "0.5");
  const auto steps = steps_of_bodies({{{a, b}}, {}, 2, 0.25});
  ASSERT_TRUE(steps) << steps.error().message;
  const auto* counted = steps.value()->counted();
  ASSERT_TRUE(counted);
  EXPECT_EQ(counted->rings, 2);
  EXPECT_EQ(counted->rest_distance, 0.25);
  EXPECT_EQ(counted->rest[5], (detector::Point{1, 1, 0}));
  EXPECT_TRUE(counted->body.empty());
}

TEST_F(BodiesOfFiles, ThatDoNotFitAreRefused) {
  const auto three = std::vector{triangle("0.obj", 0), triangle("1.obj", 1), triangle("2.obj", 2)};
  const auto two = std::vector{triangle("3.obj", 0), triangle("4.obj", 1)};
  EXPECT_TRUE(says(steps_of_bodies({{three, two}, {}}).error(),
                   "3.obj: 2 frames of body 1, but another body has 3"));
  EXPECT_TRUE(
      says(steps_of_bodies({{two, two}, {{0, 2}}}).error(), "a pair of bodies names 2 of 2"));
}

}  // namespace
}  // namespace assay::corpus
