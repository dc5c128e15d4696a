// Several meshes as bodies of one: frames in step, vertices and triangles behind each other.
#include "corpus/formats/bodies_reader.h"

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
